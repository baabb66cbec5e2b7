/// \file
/// Internal: flat faces as triangles of a polygon with holes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fusee/base.h"

namespace fusee::solid {

/// Constrained Delaunay triangulation, counter-clockwise, of the region inside loops[0] and outside the other loops.
/// These lie in loops[0] and are disjoint; their orientation does not matter. Indices count through all loops' points
/// in order, then through `inner`. These are points of the region that become corners too. No other point is added.
std::vector<std::array<std::uint32_t, 3>> triangulate(const std::vector<Polygon>& loops,
                                                      const std::vector<Vec2>& inner = {});

}  // namespace fusee::solid
