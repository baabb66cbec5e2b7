/// \file
/// Winds two inextensible strings in space on the helical grooves that are in a mesh, and finds the joint angle they
/// give. Shares no equation with the synthesis and knows no spiral: floors are found where half-planes through the axis
/// cut the mesh, lengths are added up piece by piece, the joint angle is found by bisection.
#pragma once

#include <vector>

#include "fusee/base/plane.h"
#include "fusee/mechanism/mechanism.h"
#include "fusee/profile/rewind.h"
#include "fusee/solid/mesh.h"

namespace fusee {

/// A groove's floor as it is in a mesh: middle of its band, counter-clockwise seen from +z.
using FloorLine = std::vector<Vec3>;

/// All grooves in a mesh that go round the axis for at least half a turn, from below.
/// `scale`: of the mesh over the finished part.
std::vector<FloorLine> helical_floors(const TriangleMesh& mesh, double scale = 1.0, int half_planes = 720);

/// Heights of the ends of the free paths in the part's frame, above its lower face. mm
struct FreeEnds {
  double z1 = 0, z2 = 0;  ///< of the attachments of tendon 1 and 2, or of the pins' collars
  bool collar = false;    ///< the pins hold the tendons at these heights: only the span below them slopes
};

struct HelicalRewind {
  RewindResult turn;            ///< as of one-turn pulleys
  double max_fleet = 0;         ///< largest angle between span and groove at a take-off, rad
  double max_fleet_at = 0;      ///< α, rad
  Side max_fleet_side = Side::left;
};

/// Throws InputError when the mesh has no two grooves, or one ends within the range.
HelicalRewind rewind_helical(const TriangleMesh& mesh, const Mechanism& mechanism, const FreeEnds& ends,
                             double scale = 1.0, int steps = 180);
/// The same on floors that were found before: P1's, P2's.
HelicalRewind rewind_floors(const Mechanism& mechanism, const FloorLine& floor1, const FloorLine& floor2,
                            const FreeEnds& ends, int steps = 180);

}  // namespace fusee
