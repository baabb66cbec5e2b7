/// \file
/// Terminal output of `fusee calibrate`.
#pragma once

#include <string>

#include "fusee/export.h"

namespace fusee::cli {

/// Verdict, figures, effects, corrections and next measurements. `verbose` adds detectable sizes and rejected effects.
std::string calibration_summary(const formats::CalibrationProduct& product, bool verbose);

}  // namespace fusee::cli
