/// \file
/// Internal: sections of a solid by half-planes that end in the axis. mm, rad.
#pragma once

#include <cstddef>
#include <vector>

#include "fusee/solid.h"

namespace fusee::helical_solid {

/// A straight piece of an outline in a half-plane: distance from the axis over height.
struct OutlinePiece {
  double z0 = 0, r0 = 0, z1 = 0, r1 = 0;  ///< z0 < z1
};

/// The angle of half-plane `k` of `count`, evenly spaced. None lies at a multiple of the spacing, where parts often
/// have corners.
double half_plane_angle(std::size_t k, std::size_t count);
/// The outline pieces of the mesh in each half-plane, unordered. Level pieces are omitted.
std::vector<std::vector<OutlinePiece>> half_plane_cuts(const solid::TriangleMesh& mesh, std::size_t count);
/// The outermost pieces at every height, from below, without gaps within the part.
std::vector<OutlinePiece> outermost(std::vector<OutlinePiece> pieces);

/// A local minimum of radius between two crests of an outline: the section of a groove's floor.
struct FloorPlace {
  double z = 0, r = 0;                       ///< the middle of the floor
  double low_crest = 0, high_crest = 0;      ///< distances from the axis of the crests below and above
  double low_crest_z = 0, high_crest_z = 0;  ///< heights at which these crests end towards the floor
};
/// The floors in an outline, from below. Minima less than `least_rise` below a crest are no floors.
std::vector<FloorPlace> floors_of(const std::vector<OutlinePiece>& outline, double least_rise);

/// A floor followed from half-plane to half-plane, counter-clockwise: place k lies in half-plane (first + k) mod count.
struct FloorTrace {
  std::size_t first = 0;
  std::vector<FloorPlace> places;
};

/// The floors that go round for at least half a turn, from below. The last few degrees at both ends are omitted,
/// because a half-plane does not cut a complete groove section there. `floors`: those of each half-plane.
std::vector<FloorTrace> floor_traces(const std::vector<std::vector<FloorPlace>>& floors);

}  // namespace fusee::helical_solid
