/// \file
/// Internal: conditions for a body. Each failed one says what is wrong and names the numbers to change.
#pragma once

#include "solid/plan.h"

namespace fusee::solid {

/// The thinnest wall between a convex floor and a hole inside it.
struct Wall {
  double thickness = 0;  ///< negative where the hole breaks through the floor, mm
  double angle = 0;      ///< its direction about the axis, rad
};
Wall wall_between(const Polygon& floor, const Polygon& hole);

/// All conditions of a planned body. `rooms` adds those of the tie-offs.
std::vector<profile::Condition> conditions_of(const Mechanism& mechanism, const profile::SynthesisResult& synthesis,
                                              const BodyLayout& layout, const FlangeRims& rims,
                                              const std::vector<AnchorRoom>& rooms);

/// The part's diameter against body.room_diameter_mm.
profile::Condition room_condition(const Mechanism& mechanism, double diameter);

}  // namespace fusee::solid
