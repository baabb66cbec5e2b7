/// \file
/// Internal: what list_effects.cmake makes of the files in effects/.
#pragma once

#include <vector>

#include "fusee/mechanism/effect.h"

namespace fusee {

/// What every file of effects/ gives, in the order of their names.
std::vector<Effect> effect_list(JointKind kind);

}  // namespace fusee
