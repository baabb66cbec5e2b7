/// \file
/// Internal: the joint under its load, and its motor, as JSON and as words of pages.
#pragma once

#include <string>

#include "base/json.h"
#include "fusee/analysis.h"

namespace fusee::formats {

class KeyNumbers;

/// "under 15 N", "under [load] and [spring]", "without load".
std::string load_words(const Mechanism& mechanism);

/// Largest error of θ, slack, pretension against it and safety factor, in degrees and N.
Json under_load_json(const analysis::UnderLoad& load);
/// Each limit of the motor beside what is required, in degrees and N·mm, with advice.
Json motor_json(const analysis::MotorCheck& motor);

/// " Under 15 N, θ is off by up to 1.35° (at α = 119.3°). Tendon 1 is slack over the whole range: …", with a blank in
/// front. "" if it was not computed.
std::string under_load_sentences(const analysis::UnderLoad& load, const Mechanism& mechanism);
/// Ranges of α in which a tendon is slack; "nowhere".
std::string slack_words(const analysis::UnderLoad& load, const std::vector<analysis::AlphaRange>& ranges);
/// The pretension that keeps a slack tendon taut; "" for a taut tendon, or if there is none.
std::string pretension_words(const analysis::UnderLoad& load, const std::vector<analysis::AlphaRange>& ranges);
/// Travel, torque and speed of the motor; nothing without a motor.
void add_motor(KeyNumbers& numbers, const analysis::UnderLoad& load);

}  // namespace fusee::formats
