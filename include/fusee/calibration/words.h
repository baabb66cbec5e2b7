/// \file
/// The words of a calibration, once: terminal, page, JSON and corrected.toml say the same.
///
/// Names and places of effects stand in the effects' own files, reasons beside the decisions (Candidate::why).
#pragma once

#include <string>
#include <string_view>

#include "fusee/calibration/calibration.h"

namespace fusee {

/// As in calibration.json: "not_testable".
std::string_view word(CalibrationVerdict verdict);

/// "100 : 1" of a log of odds: to one digit, and of more than a million to one no more.
std::string odds(double log_odds);

/// What can be done about an effect, a sentence.
std::string_view remedy_words(const FoundEffect& effect);

}  // namespace fusee
