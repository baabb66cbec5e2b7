/// \file
/// How well the data know the numbers of a fit.
#pragma once

#include <vector>

#include "calibration/fit.h"

namespace fusee {

/// Of one fitted x, in its own steps.
struct ConfidenceInterval {
  double low = 0;  ///< 95 %
  double high = 0;
  double deviation = 0;  ///< standard
};

/// Of every fitted x, in their order: by resampling strokes, or by the scatter between runs where that is wider. Of
/// what the data know, no prior in it.
std::vector<ConfidenceInterval> intervals(const Evidence& evidence, const Fit& fit);

/// Whether the interval of some number of `effect` holds no zero.
bool excludes_zero(const Evidence& evidence, const Fit& fit, const Effect& effect);

}  // namespace fusee
