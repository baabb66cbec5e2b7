/// \file
/// Internal: readable tables of checks and conditions.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fusee/base.h"
#include "fusee/profile.h"

namespace fusee::formats {

/// "bore_wall_P1" → "Wall between the bore and P1’s groove floor", from a table of known names. Any other name is shown
/// with spaces for underscores.
std::string plain_name(std::string_view name);
/// "mm", "°" for "deg", "" for "1".
std::string shown_unit(std::string_view unit);
/// Value and unit: "0.004°", "0.003 mm", "12".
std::string with_unit(double value, std::string_view unit, int digits = 3);

/// Grouped by file, with failed checks in a group of their own, first.
std::string checks_tables(const std::vector<Check>& checks);
/// `over_stroke`: with a column for the α at which each is tightest.
std::string conditions_table(const std::vector<profile::Condition>& conditions, bool over_stroke);

}  // namespace fusee::formats
