/// \file
/// Internal: slots for the ends of the tendons beyond their knots.
#pragma once

#include <vector>

#include "solid/plan.h"

namespace fusee::solid {

/// Gives each load-carrying tie-off a slot for its tail, with the requested clamp screw, where there is space. A note
/// reports an omitted slot. The plan must be complete except for marks. Returns failed conditions for screws without a
/// place. A `rejected` slot is omitted.
std::vector<profile::Condition> place_tails(BodyPlan& plan, const Mechanism& mechanism,
                                            const std::vector<Rejection>& rejected);

}  // namespace fusee::solid
