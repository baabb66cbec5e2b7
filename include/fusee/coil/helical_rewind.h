/// \file
/// Winds two inextensible strings in space on the helical grooves of a mesh and computes the joint angle they give.
/// Shares no equation with the synthesis and uses no spiral. Floors are found where half-planes through the axis cut
/// the mesh, lengths are summed piece by piece, and the joint angle is found by bisection. mm, rad.
#pragma once

#include <vector>

#include "fusee/base/plane.h"
#include "fusee/coil/helical_pulley.h"
#include "fusee/mechanism/mechanism.h"
#include "fusee/profile/rewind.h"
#include "fusee/solid/mesh.h"
#include "fusee/transmission/transmission.h"

namespace fusee {

/// A groove's floor in a mesh: the middle of its band, counter-clockwise seen from +z.
using FloorLine = std::vector<Vec3>;

/// All grooves of a mesh that go round the axis for at least half a turn, from below. `scale`: size of the mesh
/// relative to the finished part. Degenerate facets are skipped. The mesh should be a solid.
std::vector<FloorLine> helical_floors(const TriangleMesh& mesh, double scale = 1.0, int half_planes = 720);

/// Axial positions of the tendons on the part. Heights are above its lower face.
struct TendonsLaid {
  double z1 = 0,
         z2 = 0;  ///< heights of the fixed ends of the sloping free paths: the attachments, or the collars of the pins
  bool collar = false;  ///< the pins hold the tendons at these heights, so that only the span below them slopes
  double spare1 = 0, spare2 = 0;  ///< angle by which the grooves continue past the working arcs to the knots, rad
};
/// `attachment1`, `attachment2`: heights in the frames of the spirals.
TendonsLaid tendons_laid(const HelicalPulley& pulley, const Spiral& p1, const Spiral& p2, double attachment1,
                         double attachment2, bool collar);

struct HelicalRewind {
  RewindResult result;      ///< as for one-turn pulleys
  double max_fleet = 0;     ///< largest angle between a span and its groove at the take-off
  double max_fleet_at = 0;  ///< α
  Side max_fleet_side = Side::left;
};

/// `stroke`: α in growing order through home, with the declared θ. Throws InputError when the mesh does not have
/// exactly two grooves, or when one ends within the range.
HelicalRewind rewind_helical(const TriangleMesh& mesh, const Mechanism& mechanism,
                             const std::vector<TransmissionPoint>& stroke, const TendonsLaid& laid, double scale = 1.0);
/// Winds on floors that were found before.
HelicalRewind rewind_floors(const FloorLine& floor1, const FloorLine& floor2, const Mechanism& mechanism,
                            const std::vector<TransmissionPoint>& stroke, const TendonsLaid& laid);

}  // namespace fusee
