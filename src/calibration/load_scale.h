/// \file
/// Wrong loads as an alternative to an effect: all loads scaled by one factor, because of a cell out of calibration or
/// a lever of another length. They act through the joint's compliance; no effect describes them, since they are an
/// error of the log.
#pragma once

#include <vector>

#include "calibration/fitter_pool.h"
#include "calibration/selection.h"

namespace fusee::calibration {

/// Best set without an effect, on runs with all loads scaled.
struct LoadScaleFit {
  double times = 1;
  double score = 0;  ///< with the penalty of one searched number; −infinity: no solution, or the effect is equivalent
};

/// Result for every accepted effect, in their order.
std::vector<LoadScaleFit> fit_load_scales(const Evidence& evidence, FitterPool& pool, const Selection& selection);

}  // namespace fusee::calibration
