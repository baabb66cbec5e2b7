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

/// Fills verdict, unexplained_rms and unexplained_where, and says where a cause may be unmodelled. `unnamed`: beside
/// selection.best.
void conclude(const Evidence& evidence, const Selection& selection, const Unnamed& unnamed, Calibration& calibration);

/// Fills the summary, of what is concluded and asked for.
void summarize(const Evidence& evidence, const Selection& selection, Calibration& calibration);

}  // namespace fusee
