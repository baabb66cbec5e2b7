/// \file
/// Internal: overhangs. Downward faces too flat to rest on the layer below, in connected patches, with the support of
/// each edge. mm, rad.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fusee/base.h"
#include "fusee/solid.h"

namespace fusee::solid {

/// The support beyond a side of an overhanging facet.
enum class EdgeSupport : std::uint8_t {
  patch,  ///< another facet of the patch
  held,   ///< supported: a wall or a steep face that goes down from here, or the bed
  free    ///< air below
};

struct OverhangFacet {
  std::array<Vec3, 3> corners;  ///< side k runs from corner k to k + 1; clockwise seen from above
  std::array<EdgeSupport, 3> beyond{};
  std::array<std::uint32_t, 3> neighbour{};  ///< index within the patch, if `beyond` is `patch`
};

struct OverhangPatch {
  std::vector<OverhangFacet> facets;
  double flattest = 0;  ///< least slope above the horizontal
  Vec3 flattest_at = Vec3::Zero();
  double area = 0;  ///< area in plan, mm²
};

struct Overhangs {
  std::vector<OverhangPatch> patches;
  /// Slope of the flattest of the other faces, which look down above the first layer and are steep enough; π/2: none
  double flattest_other = 0;
  Vec3 flattest_other_at = Vec3::Zero();
};

/// Downward faces flatter than `steep_enough` and not entirely within `first_layer` above the mesh's lowest point.
Overhangs find_overhangs(const TriangleMesh& mesh, double steep_enough, double first_layer);

/// Local minima of the surface with solid above them, higher than `first_layer` above the lowest point.
std::vector<Vec3> find_unsupported_regions(const TriangleMesh& mesh, double first_layer);

}  // namespace fusee::solid
