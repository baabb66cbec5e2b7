/// \file
/// Selection of the effects that a joint can have: its parts must exist and touch a tendon.
#pragma once

#include <vector>

#include "mechanism/effect.h"

namespace fusee::joint {

/// True when the joint has the part that the effect requires. An attachment whose tendon lies on the drum over the
/// whole range does not count: moving it changes the tendon length by a constant, which is adjusted at assembly.
bool has_part(const Mechanism& mechanism, const Needs& needs);

/// The applicable effects of effects(), in their order.
std::vector<const Effect*> effects_of(const Mechanism& mechanism);

}  // namespace fusee::joint
