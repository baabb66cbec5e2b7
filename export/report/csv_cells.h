/// \file
/// Internal: numbers as all tables have them.
#pragma once

#include <cmath>
#include <string>

#include "fusee/base/text.h"

namespace fusee {

/// Six decimals; empty where there is no such number.
inline std::string csv_cell(double value) { return std::isfinite(value) ? fixed(value, 6) : std::string(); }

}  // namespace fusee
