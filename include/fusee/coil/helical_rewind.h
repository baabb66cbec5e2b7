/// \file
/// Winds two inextensible strings in space on the helical grooves that are in a mesh, and finds the joint angle they
/// give. Shares no equation with the synthesis and knows no spiral: floors are found where half-planes through the axis
/// cut the mesh, lengths are added up piece by piece, the joint angle is found by bisection. mm, rad.
#pragma once

#include <vector>

#include "fusee/base/plane.h"
#include "fusee/coil/helical_pulley.h"
#include "fusee/mechanism/mechanism.h"
#include "fusee/profile/rewind.h"
#include "fusee/solid/mesh.h"
#include "fusee/transmission/transmission.h"

namespace fusee {

/// A groove's floor as it is in a mesh: the middle of its band, counter-clockwise seen from +z.
using FloorLine = std::vector<Vec3>;

/// All grooves in a mesh that go round the axis for at least half a turn, from below. `scale`: of the mesh over the
/// finished part. Facets without place for it are passed over: the mesh should be a solid.
std::vector<FloorLine> helical_floors(const TriangleMesh& mesh, double scale = 1.0, int half_planes = 720);

/// How the tendons lie on the part. Heights are above its lower face.
struct TendonsLaid {
  double z1 = 0, z2 = 0;          ///< of the ends of the sloping free paths: the attachments, or the pins' collars
  bool collar = false;            ///< the pins hold the tendons at these heights: only the span below them slopes
  double spare1 = 0, spare2 = 0;  ///< how far the grooves go on past the working arcs to the knots, rad
};
/// `attachment1`, `attachment2`: in the spirals' frames.
TendonsLaid tendons_laid(const HelicalPulley& pulley, const Spiral& p1, const Spiral& p2, double attachment1,
                         double attachment2, bool collar);

struct HelicalRewind {
  RewindResult result;      ///< as of one-turn pulleys
  double max_fleet = 0;     ///< largest angle between a span and its groove at the take-off
  double max_fleet_at = 0;  ///< α
  Side max_fleet_side = Side::left;
};

/// `stroke`: α in growing order through home, and the declared θ there. Throws InputError when the mesh has other than
/// two grooves, or one ends within the range.
HelicalRewind rewind_helical(const TriangleMesh& mesh, const Mechanism& mechanism,
                             const std::vector<TransmissionPoint>& stroke, const TendonsLaid& laid, double scale = 1.0);
/// The same on floors that were found before.
HelicalRewind rewind_floors(const FloorLine& floor1, const FloorLine& floor2, const Mechanism& mechanism,
                            const std::vector<TransmissionPoint>& stroke, const TendonsLaid& laid);

}  // namespace fusee
