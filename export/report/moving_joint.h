/// \file
/// The joint that a page lets a person move: drawing, slider and numbers, and what moving_joint.js computes them from.
#pragma once

#include <string>
#include <vector>

#include "fusee/analysis/stroke.h"
#include "fusee/profile/synthesis.h"

namespace fusee {

/// HTML of a section's inside. `loaded`: the declared load's cycle at each place of the synthesis' stroke. "" where
/// there is nothing to move. Needs moving_joint.js, and page.css.
std::string moving_joint(const Mechanism& mechanism, const SynthesisResult& synthesis,
                         const std::vector<StrokePoint>& loaded);

}  // namespace fusee
