/// \file
/// Which effects a joint can have: those of parts that it has, and that its tendons touch.
#pragma once

#include <vector>

#include "fusee/mechanism/effect.h"

namespace fusee {

/// Whether a joint has the part that an effect is of. An attachment whose tendon lies on the drum over the whole range
/// is none: where it is tied there changes the tendon's length by a constant, and that is cut to fit.
bool has_part(const Mechanism& mechanism, const Needs& needs);

/// Of effects() of its kind, in their order.
std::vector<const Effect*> effects_of(const Mechanism& mechanism);

}  // namespace fusee
