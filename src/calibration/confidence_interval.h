/// \file
/// Interval of a fitted number.
#pragma once

namespace fusee::calibration {

/// Interval of a fitted x, in its steps.
struct ConfidenceInterval {
  double low = 0;  ///< 95 %
  double high = 0;
  double deviation = 0;  ///< standard deviation
};

}  // namespace fusee::calibration
