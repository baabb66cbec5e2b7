/// \file
/// Can this body be made? Each condition says what is wrong and names the numbers that it is about.
#pragma once

#include "solid/plan.h"

namespace fusee {

/// The thinnest wall between a convex floor and a hole inside it.
struct Wall {
  double thickness = 0;
  double angle = 0;  ///< where, about the axis, rad
};
Wall wall_between(const Polygon& floor, const Polygon& hole);

/// All conditions of a planned body. Those of the tie-offs are added from `rooms`.
std::vector<Condition> conditions_of(const Mechanism& mechanism, const SynthesisResult& synthesis,
                                     const BodyLayout& layout, const FlangeRims& rims,
                                     const std::vector<AnchorRoom>& rooms);

}  // namespace fusee
