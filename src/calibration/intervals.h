/// \file
/// Confidence intervals of fitted parameters.
#pragma once

#include <vector>

#include "calibration/selection.h"

namespace fusee::calibration {

/// Interval of a fitted x, in its steps.
struct ConfidenceInterval {
  static ConfidenceInterval about(double x, double variance);

  double low = 0;  ///< 95 %
  double high = 0;
  double deviation = 0;  ///< standard deviation
};

/// Interval of every fitted x, in their order, with the discrepancy marginalised, prior sizes and caliper readings.
std::vector<ConfidenceInterval> intervals(const Fit& fit);
/// Intervals of `selection.best` with other effects marginalised, by the weight of their sets.
std::vector<ConfidenceInterval> intervals(const Selection& selection);
/// Intervals if the effects of `selection.best` are the only ones.
std::vector<ConfidenceInterval> intervals_if_only(const Selection& selection);

}  // namespace fusee::calibration
