/// \file
/// --column ROLE=NAME, of all commands that read a log.
#pragma once

#include "cli/arguments.h"
#include "fusee/measurement/measurement.h"

namespace fusee::cli {

Option column_option();
/// Throws UsageError for what is no role.
MeasurementOptions columns_from(const Arguments& arguments);

}  // namespace fusee::cli
