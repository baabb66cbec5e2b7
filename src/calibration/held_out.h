/// \file
/// Prediction errors of held-out data.
#pragma once

#include <vector>

#include "calibration/evidence.h"

namespace fusee::calibration {

struct Amplitudes;
struct Fit;

struct HeldOut {
  /// Mean square error of each block, fitted without its fold, rad²; NaN if no fold contains it.
  std::vector<double> by_block;
  double mean_square = 0;  ///< mean square over rows
};

/// Held-out error by one linear step from the fit of all data to the fit without each fold. If a number is not
/// determined without a fold, the blocks of that fold are left out one by one.
HeldOut hold_out(const Evidence& evidence, const Fit& fit, const std::vector<Fold>& folds);

/// Parameters of `fit` refitted without each of the folds, by the same step. `beside`: amplitudes of the discrepancy,
/// or null.
std::vector<Eigen::VectorXd> numbers_without(const Evidence& evidence, const Fit& fit, const Amplitudes* beside,
                                             const std::vector<Fold>& folds);

/// Held-out errors of a fit with its discrepancy. Both are estimated from the other folds. `amplitudes`: of that fit.
struct HeldOutWithDiscrepancy {
  HeldOut effects;     ///< error of the effects alone
  HeldOut with_place;  ///< error of effects and the discrepancy of place and direction
  HeldOut with_all;    ///< error of effects and the whole discrepancy, except for the component of the held-out run
};
HeldOutWithDiscrepancy hold_out_with_discrepancy(const Evidence& evidence, const Fit& fit, const Amplitudes& amplitudes,
                                                 const std::vector<Fold>& folds);

}  // namespace fusee::calibration
