/// \file
/// Errors of data that were not fitted to.
#pragma once

#include <vector>

#include "calibration/evidence.h"

namespace fusee {

struct Amplitudes;
struct Fit;

struct HeldOut {
  /// Mean square error of each block, fitted without its fold, rad²; NaN where no fold holds it.
  std::vector<double> by_block;
  double mean_square = 0;  ///< over rows
};

/// One step of the fit from all of the data to those without a fold. A fold whose rest cannot tell what all data know
/// is left out block by block.
HeldOut hold_out(const Evidence& evidence, const Fit& fit, const std::vector<Fold>& folds);

/// All numbers of `fit` as the rows outside each of the folds have them, by the same step. `beside`: amplitudes of the
/// discrepancy beside them, or null.
std::vector<Eigen::VectorXd> numbers_without(const Evidence& evidence, const Fit& fit, const Amplitudes* beside,
                                             const std::vector<Fold>& folds);

/// The same of a fit with the discrepancy beside it, which is learnt from the others too. `amplitudes`: of that fit.
struct HeldOutBeside {
  HeldOut effects;     ///< what the effects alone leave
  HeldOut with_place;  ///< what they leave with the discrepancy's part of place and direction alone
  HeldOut with_all;    ///< what they leave with all of the discrepancy; of a run that was left out its own part is none
};
HeldOutBeside hold_out_beside(const Evidence& evidence, const Fit& fit, const Amplitudes& amplitudes,
                              const std::vector<Fold>& folds);

}  // namespace fusee
