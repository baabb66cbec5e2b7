/// \file
/// Normal equations about a fit, and the prediction errors of held-out data by them.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "calibration/evidence.h"
#include "calibration/parameters.h"

namespace fusee::calibration {

struct Fit;

/// Sums over rows with slopes J and residuals r.
struct NormalEquations {
  Eigen::MatrixXd JJ;  ///< Σ J Jᵀ
  Eigen::VectorXd Jr;  ///< Σ J r
  double rr = 0;       ///< Σ r², rad², with the play correction
  double rows = 0;

  static NormalEquations none(Eigen::Index parameters);
  bool empty() const { return JJ.rows() == 0; }
  /// Σ r² after a step of the parameters.
  double squares_after(const Eigen::VectorXd& step) const { return rr - 2.0 * step.dot(Jr) + step.dot(JJ * step); }
  NormalEquations& operator+=(const NormalEquations& other);  ///< JJ and Jr
  NormalEquations& operator-=(const NormalEquations& other);
};

/// Step that minimises the squares plus `ridge` |x|²: undetermined directions end at zero.
Eigen::VectorXd least_squares_step(const NormalEquations& normal, const Eigen::VectorXd& x, double ridge);

/// Wide prior about zero: a thousand steps cost as much as one row of the floor's noise.
inline double wide_prior(double floor) { return 1e-6 * floor * floor; }

/// Sums over one block, about the fit.
NormalEquations sums_of(const Block& block, const Fit& fit, double floor);
/// Sums over caliper readings: each is a row with noise of the floor.
NormalEquations sums_of_readings(const Evidence& evidence, const Fit& fit);
/// χ² of the caliper readings.
double caliper_chi2(const Evidence& evidence, const Imperfections& at);
/// Sums over all rows in use, with JJ and Jr of caliper readings.
NormalEquations sums_of_all(const Evidence& evidence, const Fit& fit);

/// True if residual and slopes are finite in every row in use.
bool is_finite(const Evidence& evidence, const Fit& fit);

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
