/// \file
/// Internal: the list of effects that list_effects.cmake generates from effects/.
#pragma once

#include <vector>

#include "mechanism/effect.h"

namespace fusee {

/// The effects of all files in effects/, sorted by file name.
std::vector<Effect> effect_list(JointKind kind);

}  // namespace fusee
