/// \file
/// Internal: one half of a groove's cross-section, from floor to groove edge. mm, rad.
#pragma once

#include <vector>

#include "fusee/solid.h"

namespace fusee::solid {

/// Points from the groove's plane outward. The first is {0, 0} and the second has offset 0 too: the floor is a short
/// flat band, so that a section at the groove's plane cuts faces and never a vertex. The tendon's centre line lies d/2
/// above that band in every kind of groove. `lean`: angle of the wall from the outward to the axial direction, rad.
std::vector<GroovePoint> groove_half(const Body& body, double lean, double tendon_diameter, double depth);

/// Sideways play in a groove half: distance from the middle at which a tendon that has risen by the groove's depth
/// touches the wall. The wall is extended beyond the groove edge with its last slope. mm
double room_at_groove_edge(const std::vector<GroovePoint>& half, double tendon_diameter);

}  // namespace fusee::solid
