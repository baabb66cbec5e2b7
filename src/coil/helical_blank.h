/// \file
/// The body before anything is cut out of it: one structured grid, closed by flat faces, bore and hub.
#pragma once

#include "coil/winding.h"
#include "fusee/base/plane.h"
#include "fusee/solid/layout.h"
#include "fusee/solid/mesh.h"
#include "fusee/transmission/tendon_path.h"

namespace fusee {

/// Heights of the rings between which the grooves lie, and by how much the lowest is chamfered.
struct RingHeights {
  double lower = 0;  ///< of the middle flange
  double upper = 0;  ///< of the middle flange: a cone in between where P2 stands out over P1
  double top = 0;
  double hub_top = 0;
};

/// The lower face's outline, P1's, or the upper one's.
Polygon rim_of(const Fan& fan, Side side, double lip);

/// How far the middle flange's upper ring stands out over its lower one, mm; the cone between them carries it.
double middle_step(const Fan& fan, double lip);

/// Not scaled; in double.
TriangleMesh helical_blank(const Fan& fan, const HelicalSection& section, const BodyLayout& layout,
                           const RingHeights& heights);

}  // namespace fusee
