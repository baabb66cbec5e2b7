/// \file
/// Structure of the residual after all effects, and the verdict.
#pragma once

#include <string>

#include "calibration/validation.h"
#include "fusee/calibration.h"

namespace fusee::calibration {

/// Repeatable structure of the residual.
struct ResidualStructure {
  double autocorrelation = 0;  ///< lag-1 autocorrelation within strokes
  std::string where;           ///< place and direction at which it is largest
};
ResidualStructure describe_residual(const Evidence& evidence, const Fit& fit);

/// Fills verdict, unexplained_rms and unexplained_where, and adds k_unmodelled to groups.
void conclude(const Evidence& evidence, const Selection& selection, const ValidatedAnswer& answer,
              Calibration& calibration);

/// Fills the summary from verdict, effects and next measurements.
void summarize(const Evidence& evidence, const Selection& selection, Calibration& calibration);

}  // namespace fusee::calibration
