/// \file
/// Internal: texts of the calibration's pages about names, effects and discrepancies.
#pragma once

#include <string>
#include <vector>

#include "fusee/calibration.h"

namespace fusee::formats {

std::string open_words(const std::string& name);  ///< "tendon_stretch" → "tendon stretch"
std::string first_upper(std::string words);
/// A parameter's name, and its unit as it follows a number: "compliance", " % per decade".
struct NameAndUnit {
  std::string name, unit;
};
NameAndUnit name_and_unit(const std::string& parameter, const std::string& load_unit);
std::string joined(const std::vector<std::string>& words, const std::string& between);
std::string share_words(double share);  ///< "85 %", "all", "< 1 %"

/// "In 200 simulated joints without backlash, these runs would have reported it in 1."; "" if none were simulated.
std::string audit_words(const calibration::FoundEffect& effect);
/// "Or an unmodelled cause with the same effect: a wave of 1.9 times a turn of the motor. Odds for the reported cause:
/// 99 : 1."; "" if the group has no unmodelled member.
std::string unmodelled_words(const calibration::FoundEffect& effect);
/// "Perhaps joint sensor gain (gain = 1.26 % …) acts too: with both … held-out runs are predicted best."; "" if no
/// member of its group is reported beside it.
std::string beside_words(const calibration::FoundEffect& effect, const std::string& load_unit);
/// "0.021° rms, place: equal at each angle for all directions, loads and speeds …"
std::string discrepancy_words(const calibration::DiscrepancyComponent& part);

}  // namespace fusee::formats
