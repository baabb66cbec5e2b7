/// \file
/// Internal: joints whose law does not exist over their range.
#pragma once

#include <optional>

#include "fusee/profile/synthesis.h"

namespace fusee {

/// The conditions that fail, with advice; null where the law exists, and of a joint declared by a ratio.
std::optional<SynthesisResult> without_law(const Mechanism& mechanism);

}  // namespace fusee
