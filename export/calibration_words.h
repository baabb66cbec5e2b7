/// \file
/// A calibration in words, for the page and for the terminal alike.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "fusee/calibration/correction.h"

namespace fusee {

std::string open_words(const std::string& name);   ///< "tendon_stretch" → "tendon stretch"
std::string first_upper(std::string words);
std::string joined(const std::vector<std::string>& words, const std::string& between);

/// "EA = 4515 N (95 %: 4479 … 4551)": the unit is taken from the end of the name.
std::string parameter_words(const FittedParameter& parameter);
/// The group without the effect itself.
std::vector<std::string> rivals_of(const FoundEffect& effect);
/// Whether P1 stays round, and by how much it would miss its law.
std::string round_words(const Correction& correction);
/// Effects that were not found by the smallest size that would have shown, rad; equal to two digits is equal. Smallest first.
std::vector<std::pair<double, std::vector<std::string>>> detectable_groups(const Calibration& calibration);
/// Of notes that say the same of many files, two and how many more.
std::vector<std::string> shortened_notes(const std::vector<std::string>& notes);

}  // namespace fusee
