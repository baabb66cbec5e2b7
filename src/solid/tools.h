/// \file
/// Internal: closed meshes of volumes that are cut out of the body or added to it. mm, not yet scaled.
#pragma once

#include <vector>

#include "fusee/solid.h"

namespace fusee::solid {

/// Tools project from the body by this, so that no two faces coincide.
inline constexpr double k_overshoot = 1.0;

/// The prism of loops[0] minus the other loops, from `low` to `high`.
TriangleMesh prism(const std::vector<Polygon>& loops, double low, double high);

/// An outline at one height, as a section for strip().
std::vector<Vec3> at_height(const Polygon& outline, double z);
/// The closed mesh between convex sections with equal numbers of corners. Consecutive sections are joined corner by
/// corner, and the first and the last are closed.
TriangleMesh strip(const std::vector<std::vector<Vec3>>& sections);
/// Reverses the orientation of all facets.
void turn_inside_out(TriangleMesh& mesh);

/// The set screw's hole from the axis through the hub, with the slot for its nut. Each `variant` has different facets.
TriangleMesh set_screw_tool(const SetScrewLayout& screw, double hub_radius, double hub_top, int variant);

}  // namespace fusee::solid
