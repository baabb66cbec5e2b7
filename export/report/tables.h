/// \file
/// Checks and conditions as tables that a person can read.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fusee/base/check.h"
#include "fusee/profile/synthesis.h"

namespace fusee {

/// "free_span_1" → "Free span of tendon 1": a table of known names; any other name with its underscores opened.
std::string plain_name(std::string_view name);
/// "mm", "°" for "deg", "" for "1".
std::string shown_unit(std::string_view unit);
/// Value and unit, "0.004°", "0.003 mm", "12".
std::string with_unit(double value, std::string_view unit, int digits = 3);

/// Grouped by the file that they are about; what failed in a group of its own, first.
std::string checks_tables(const std::vector<Check>& checks);
/// `over_stroke`: with a column for the α at which each is tightest.
std::string conditions_table(const std::vector<Condition>& conditions, bool over_stroke);

}  // namespace fusee
