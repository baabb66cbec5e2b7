/// \file
/// Closed meshes of what is cut out of the body (or added to it). mm, not yet scaled.
#pragma once

#include <vector>

#include "fusee/solid/layout.h"
#include "fusee/solid/mesh.h"

namespace fusee {

/// loops[0] without the others, from `low` to `high`.
TriangleMesh prism(const std::vector<Polygon>& loops, double low, double high);

/// The body between convex outlines of equally many corners, one over the other.
TriangleMesh strip(const std::vector<std::vector<Vec3>>& sections);
void turn_inside_out(TriangleMesh& mesh);

/// The set screw's hole from the axis through the hub, with the slot its nut is slid into. Another `variant` has other
/// facets.
TriangleMesh set_screw_tool(const SetScrewLayout& screw, double hub_radius, double hub_top, int variant);

}  // namespace fusee
