/// \file
/// The joint under its load, and its motor, as lines of a summary.
#pragma once

#include <string>

#include "fusee/analysis.h"

namespace fusee::cli {

/// "alpha = 12.3 deg" of an angle in rad.
std::string alpha_text(double alpha);
/// The ranges of α in which a tendon is slack; "over the whole range".
std::string slack_text(const analysis::UnderLoad& load, const std::vector<analysis::AlphaRange>& ranges);
/// "tendon.pretension_N >= 14.2 keeps it taut"; "" if there is no such pretension.
std::string pretension_text(const analysis::UnderLoad& load);
/// "24.7 against breaking (tendon.strength_N)"; "" if the strength is unknown.
std::string safety_text(const analysis::UnderLoad& load);

/// Error, slack and safety factor, the first line under `title`. `load_words`: "under 5 N".
std::string under_load_lines(const analysis::UnderLoad& load, const std::string& load_words, std::size_t column = 12);
/// Travel, torque and speed of the motor, and the models that would suffice; "" without a motor.
std::string motor_lines(const analysis::UnderLoad& load, std::size_t column = 12);

}  // namespace fusee::cli
