/// \file
/// The cross-section of a groove: one half of it, from floor to lip. mm, rad.
#pragma once

#include <vector>

#include "fusee/solid/layout.h"

namespace fusee {

/// Points from the groove's plane outward; the first is {0, 0}, the second has offset 0 too: the floor is a short flat
/// band, so that a section at the groove's plane cuts faces and never a vertex. The tendon's centre line lies d/2 above
/// that band in every kind of groove. `lean`: of the wall, from the direction outward to that of the axis, rad.
std::vector<GroovePoint> groove_half(const Body& body, double lean, double tendon_diameter, double depth);

/// Of such a half: how far aside of the groove's middle a tendon that has risen by the groove's depth touches the wall,
/// gone on as it ends at the lip. mm
double room_at_lip(const std::vector<GroovePoint>& half, double tendon_diameter);

}  // namespace fusee
