/// \file
/// Flat faces: a polygon with holes as triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fusee/base/plane.h"

namespace fusee {

/// Constrained Delaunay triangles, counter-clockwise, of the region inside loops[0] and outside the others (which lie
/// in it and are disjoint; the sense in which a loop runs does not matter). Indices count through all loops' points in
/// order. No point is added.
std::vector<std::array<std::uint32_t, 3>> triangulate(const std::vector<Polygon>& loops,
                                                      const std::vector<Vec2>& inner = {});

}  // namespace fusee
