/// \file
/// The rest after all accepted effects, looked at without blame, and the one word for the whole.
#pragma once

#include <string>

#include "calibration/selection.h"
#include "calibration/unknown.h"
#include "fusee/calibration/calibration.h"

namespace fusee {

/// Structure of the residual that repeats.
struct Rest {
  double autocorrelation = 0;  ///< lag 1, within strokes
  std::string where;           ///< where it is largest
};
Rest look_at_rest(const Evidence& evidence, const Fit& fit);

/// Fills verdict, summary, next_runs, unexplained_rms and unexplained_where. `unnamed`: beside selection.best.
void conclude(const Evidence& evidence, const Selection& selection, const Unnamed& unnamed, Calibration& calibration);

}  // namespace fusee
