/// \file
/// Robust least squares of what a model says, with bounds: by Ceres.
#pragma once

#include "calibration/model.h"

namespace fusee {

/// Where the squares of residuals are least, near `from`; residuals beyond five of `scale` (rad) count linearly. What
/// was measured by hand takes part. Without parameters, `from` itself. None where the joint has no equilibrium there.
struct Minimum {
  bool found = false;
  Imperfections at;
  Eigen::VectorXd x;  ///< the parameters, each by its step
};
Minimum least_misfit(const Model& model, const Parameters& parameters, const Imperfections& from, double scale);

}  // namespace fusee
