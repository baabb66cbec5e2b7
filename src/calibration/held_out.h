/// \file
/// Errors of data that were not fitted to.
#pragma once

#include <vector>

#include "calibration/evidence.h"

namespace fusee {

struct Fit;

struct HeldOut {
  /// Mean square error of each block, fitted without its fold, rad²; NaN where no fold holds it.
  std::vector<double> by_block;
  double mean_square = 0;  ///< over rows
};

/// One step of the fit from all of the data to those without a fold. A fold whose rest cannot tell what all data know
/// is left out block by block.
HeldOut hold_out(const Evidence& evidence, const Fit& fit, const std::vector<Fold>& folds);

}  // namespace fusee
