/// \file
/// Closed meshes of what is cut out of the body (or added to it). mm, not yet scaled.
#pragma once

#include <vector>

#include "fusee/solid/layout.h"
#include "fusee/solid/mesh.h"

namespace fusee {

/// A tool stands out of the body by this, so that no two of their faces coincide.
inline constexpr double k_overshoot = 1.0;

/// loops[0] without the others, from `low` to `high`.
TriangleMesh prism(const std::vector<Polygon>& loops, double low, double high);

/// An outline at one height: a section for strip().
std::vector<Vec3> at_height(const Polygon& outline, double z);
/// The body between convex outlines of equally many corners, one over the other.
TriangleMesh strip(const std::vector<std::vector<Vec3>>& sections);
void turn_inside_out(TriangleMesh& mesh);

/// The set screw's hole from the axis through the hub, with the slot its nut is slid into. Another `variant` has other
/// facets.
TriangleMesh set_screw_tool(const SetScrewLayout& screw, double hub_radius, double hub_top, int variant);

}  // namespace fusee
