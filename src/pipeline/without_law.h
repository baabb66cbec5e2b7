/// \file
/// Internal: joints whose law does not exist over their range.
#pragma once

#include <optional>

#include "fusee/profile.h"

namespace fusee::pipeline {

/// The failed conditions, with advice; empty if the law exists or the joint is declared by a ratio.
std::optional<profile::SynthesisResult> without_law(const Mechanism& mechanism);

}  // namespace fusee::pipeline
