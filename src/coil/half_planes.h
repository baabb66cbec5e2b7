/// \file
/// A solid about the axis, as half-planes that end in the axis cut it. mm, rad.
#pragma once

#include <cstddef>
#include <vector>

#include "fusee/solid/mesh.h"

namespace fusee {

/// A straight piece of an outline in a half-plane: distance from the axis over height.
struct OutlinePiece {
  double z0 = 0, r0 = 0, z1 = 0, r1 = 0;  ///< z0 < z1
};

/// At `count` angles evenly about the axis, none of them one that drawings favour.
double half_plane_angle(std::size_t k, std::size_t count);
/// All that the mesh's facets leave in each half-plane, in no order; level pieces are left out.
std::vector<std::vector<OutlinePiece>> half_plane_cuts(const TriangleMesh& mesh, std::size_t count);
/// The outermost of them at every height, from below, without gaps but where the part ends.
std::vector<OutlinePiece> outermost(std::vector<OutlinePiece> pieces);

/// The lowest ground between two rises of an outline.
struct FloorPlace {
  double z = 0, r = 0;                   ///< the middle of the ground
  double low_lip = 0, high_lip = 0;      ///< distances from the axis of the crests on both sides
  double low_lip_z = 0, high_lip_z = 0;  ///< where the ground leaves them
};
/// Rises lower than `least_rise` are none.
std::vector<FloorPlace> floors_of(const std::vector<OutlinePiece>& outline, double least_rise);

/// A floor from half-plane to half-plane, counter-clockwise: place k lies in half-plane (first + k) mod their count.
struct FloorTrace {
  std::size_t first = 0;
  std::vector<FloorPlace> places;
};

/// Those that go round for at least half a turn, without the last few degrees at both ends, where a half-plane does not
/// cut a groove's section whole. From below. `floors`: of each half-plane.
std::vector<FloorTrace> floor_traces(const std::vector<std::vector<FloorPlace>>& floors);

}  // namespace fusee
