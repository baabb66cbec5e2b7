/// \file
/// Wording of a calibration's results, shared by terminal, page, JSON and corrected.toml.
///
/// Names and places of effects are in the files of the effects, reasons beside the decisions (Candidate::why).
#pragma once

#include <string>
#include <string_view>

#include "fusee/calibration.h"

namespace fusee::calibration {

/// Key in calibration.json: "not_testable".
std::string_view word(CalibrationVerdict verdict);

/// Odds of their logarithm, "100 : 1", to one digit, at most a million.
std::string odds(double log_odds);

/// Sentence on how the effect can be corrected.
std::string_view remedy_words(const FoundEffect& effect);

}  // namespace fusee::calibration
