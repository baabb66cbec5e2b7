/// \file
/// The faces of a part that look down too flatly to stand on the layer below, in connected patches, with what holds
/// each edge. mm, rad.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fusee/base/plane.h"
#include "fusee/solid/mesh.h"

namespace fusee {

/// What lies beyond a side of a hanging facet.
enum class Beyond : std::uint8_t {
  patch,  ///< the next facet of the patch
  held,   ///< a wall, or a face steep enough, that goes down from here, or the bed
  free    ///< air below
};

struct HangingFacet {
  std::array<Vec3, 3> corners;  ///< side k runs from corner k to k + 1; clockwise seen from above
  std::array<Beyond, 3> beyond{};
  std::array<std::uint32_t, 3> neighbour{};  ///< index within the patch where `beyond` says so
};

struct HangingPatch {
  std::vector<HangingFacet> facets;
  double flattest = 0;  ///< slope above the horizontal
  Vec3 flattest_at = Vec3::Zero();
  double area = 0;  ///< in plan, mm²
};

struct Overhangs {
  std::vector<HangingPatch> patches;
  double flattest_other =
      0;  ///< slope of the flattest face that looks down, lies above the first layer and is steep enough; π/2: none
  Vec3 flattest_other_at = Vec3::Zero();
};

/// Faces that look down at less than `steep_enough` and are not all within `first_layer` above the mesh's lowest point.
Overhangs find_overhangs(const TriangleMesh& mesh, double steep_enough, double first_layer);

/// Where the surface has a local minimum with the solid above it, higher than `first_layer` above the lowest point.
std::vector<Vec3> find_islands(const TriangleMesh& mesh, double first_layer);

}  // namespace fusee
