/// \file
/// Options for reading logs, common to all commands that read one: --column, --unit, --ticks-per-turn, --zero-ticks,
/// --home-reading.
#pragma once

#include <vector>

#include "cli/arguments.h"
#include "fusee/measurement.h"

namespace fusee::cli {

/// `options` with the reading options appended.
std::vector<Option> with_reading_options(std::vector<Option> options);
/// Throws UsageError for an invalid role, unit or number of counts.
measurement::MeasurementOptions columns_from(const Arguments& arguments);

}  // namespace fusee::cli
