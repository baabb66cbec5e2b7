/// \file
/// How a log is read, of all commands that read one: --column, --unit, --ticks-per-turn, --zero-ticks.
#pragma once

#include <vector>

#include "cli/arguments.h"
#include "fusee/measurement/measurement.h"

namespace fusee::cli {

/// `options` and those.
std::vector<Option> with_reading_options(std::vector<Option> options);
/// Throws UsageError for what is no role, no unit of it or no number of counts.
MeasurementOptions columns_from(const Arguments& arguments);

}  // namespace fusee::cli
