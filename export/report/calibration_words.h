/// \file
/// Internal: small pieces of text.
#pragma once

#include <string>
#include <vector>

#include "fusee/calibration.h"

namespace fusee::formats {

std::string open_words(const std::string& name);  ///< "tendon_stretch" → "tendon stretch"
std::string first_upper(std::string words);
/// "compliance" and " % per decade", as it is set behind a number, of "compliance_percent_per_decade".
struct NameAndUnit {
  std::string name, unit;
};
NameAndUnit name_and_unit(const std::string& parameter, const std::string& load_unit);
std::string joined(const std::vector<std::string>& words, const std::string& between);

/// "In 200 simulated joints without backlash, these runs would have reported it in 1."; "" where none were simulated.
std::string audit_words(const calibration::FoundEffect& effect);
/// "Or an unmodelled cause: a wave of 1.9 times a turn of the motor is 4.6 nats behind."; "" where the group holds
/// names alone.
std::string unmodelled_words(const calibration::FoundEffect& effect);
/// "Perhaps joint sensor gain (gain = 1.26 % …) beside it: with both … runs that were left out are predicted best."; ""
/// where no member of its group is handed over beside it.
std::string beside_words(const calibration::FoundEffect& effect, const std::string& load_unit);
/// "0.021° rms, place: the same at a place whichever way …"
std::string discrepancy_words(const calibration::DiscrepancyComponent& part);

}  // namespace fusee::formats
