/// \file
/// Internal: intervals of a number in which a predicate holds.
#pragma once

#include <functional>
#include <vector>

#include "paper/reproduction.h"

namespace fusee::paper {

/// Evaluates `holds` at `steps` + 1 evenly spaced values from `low` to `high`, and bisects between two neighbours if it
/// is true at only one of them. Intervals narrower than a step are missed.
std::vector<Window> windows_where(const std::function<bool(double)>& holds, double low, double high, int steps);

/// The searched range: "2 to 42 mm".
std::string searched_text(const ParameterWindows& parameter);

/// "0.132 to 0.249", "up to 0.21", "none from 2 to 42 mm".
std::string windows_text(const ParameterWindows& parameter);

}  // namespace fusee::paper
