/// \file
/// Internal: the joint that a page lets a person move: drawing, slider and numbers, and the data for moving_joint.js.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fusee/analysis.h"
#include "fusee/correction.h"
#include "fusee/profile.h"

namespace fusee::formats {

/// HTML above the drawing.
inline constexpr std::string_view k_moving_words =
    "<p class=\"lead\">Both tendons as taut strings over the pins and on the true profile; the thicker the line, the "
    "larger the tension, dotted where it is slack. Tensions, torque and θ under the load are the full model’s, with "
    "stretch and friction, in the direction in which you move.</p>";

/// The HTML inside a section. `loaded`: the joint under the declared load, rising and falling, at each point of
/// synthesis.stroke. "" if nothing can move. Requires joint_script() of this mechanism, and page.css.
std::string moving_joint(const Mechanism& mechanism, const profile::SynthesisResult& synthesis,
                         const std::vector<analysis::StrokePoint>& loaded);
/// The moving joint of a rehearsal, with a slider for each effect and for the load.
std::string moving_joint(const correction::Rehearsal& rehearsal);
/// moving_joint.js for this joint. For the paper's layout, the lines for drums and attachments are omitted.
std::string_view joint_script(const Mechanism& mechanism);

}  // namespace fusee::formats
