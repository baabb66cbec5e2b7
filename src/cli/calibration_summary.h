/// \file
/// What `fusee calibrate` says on a terminal.
#pragma once

#include <string>

#include "fusee/export/calibration.h"

namespace fusee::cli {

/// Verdict, figures, effects, correction, and what to measure next. `verbose`: what would have been seen and what was
/// tried, too.
std::string calibration_summary(const CalibrationProduct& product, bool verbose);

}  // namespace fusee::cli
