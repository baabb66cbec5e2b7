/// \file
/// Internal: the number format of all tables.
#pragma once

#include <cmath>
#include <string>

#include "base/text.h"

namespace fusee::formats {

/// Six decimals; empty for a number that is not finite.
inline std::string csv_cell(double value) { return std::isfinite(value) ? fixed(value, 6) : std::string(); }

}  // namespace fusee::formats
