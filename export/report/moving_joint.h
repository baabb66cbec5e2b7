/// \file
/// The joint that a page lets a person move: drawing, slider and numbers, and what moving_joint.js computes them from.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fusee/analysis/stroke.h"
#include "fusee/correction/rehearsal.h"
#include "fusee/profile/synthesis.h"

namespace fusee {

/// HTML, what a page says over it.
inline constexpr std::string_view k_moving_words =
    "<p class=\"lead\">Both tendons as taut strings over the pins and on the true profile; the thicker the line, the "
    "larger the tension, dotted where it is slack. Tensions, torque and θ under the load are the full model’s, with "
    "stretch and friction, in the direction in which you move.</p>";

/// HTML of a section's inside. `loaded`: the declared load's cycle at each place of the synthesis' stroke. "" where
/// there is nothing to move. Needs joint_script() of this mechanism, and page.css.
std::string moving_joint(const Mechanism& mechanism, const SynthesisResult& synthesis,
                         const std::vector<StrokePoint>& loaded);
/// The same with what was found in a joint: a slider for each effect, and for the load.
std::string moving_joint(const Rehearsal& rehearsal);
/// moving_joint.js for this joint: of a plain one, all but the lines for drums and attachments.
std::string_view joint_script(const Mechanism& mechanism);

}  // namespace fusee
