/// \file
/// Where the ends of the tendons lie beyond their knots.
#pragma once

#include <vector>

#include "solid/plan.h"

namespace fusee {

/// Gives each tie-off that carries load a slot for its tail, with the clamp screw that is asked for, as long as there
/// is room; a slot that is left out leaves a note. The plan has all else but marks. A screw without a place is a
/// condition that fails. None where one is `rejected`.
std::vector<Condition> place_tails(BodyPlan& plan, const Mechanism& mechanism, const std::vector<Rejection>& rejected);

}  // namespace fusee
