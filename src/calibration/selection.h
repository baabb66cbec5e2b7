/// \file
/// Which effects the data ask for, which they cannot tell apart, and what they would have shown.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "calibration/selection_fit.h"
#include "fusee/calibration/calibration.h"

namespace fusee {

struct Selection {
  std::vector<Effect> catalogue;
  Fit none;                        ///< the declared model
  Fit best;                        ///< with all accepted effects
  std::vector<FoundEffect> found;  ///< in the order of best.effects
  std::vector<Candidate> tried;
  std::vector<Detectable> detectable;
};

/// Mean square error that counts as noise, rad².
double noise_limit(double floor);

Selection select_effects(const Evidence& evidence, Forward& forward, const std::function<void(const std::string&, double)>& progress);

}  // namespace fusee
