/// \file
/// Sums of squares and products about a fit: what a linear step, a held-out error and an interval need.
#pragma once

#include <Eigen/Dense>

#include "calibration/evidence.h"
#include "calibration/parameters.h"

namespace fusee {

struct Fit;

/// Of rows with slopes J and residuals r.
struct NormalEquations {
  Eigen::MatrixXd JJ;  ///< Σ J Jᵀ
  Eigen::VectorXd Jr;  ///< Σ J r
  double rr = 0;       ///< Σ r², rad², with the price of play
  double rows = 0;

  static NormalEquations none(Eigen::Index parameters);
  bool empty() const { return JJ.rows() == 0; }
  /// Σ r² after a step of the parameters.
  double squares_after(const Eigen::VectorXd& step) const { return rr - 2.0 * step.dot(Jr) + step.dot(JJ * step); }
  NormalEquations& operator+=(const NormalEquations& other);  ///< JJ and Jr
  NormalEquations& operator-=(const NormalEquations& other);
};

/// The step to least squares and `ridge` times the square of where it ends: what the rows cannot tell ends at nothing.
Eigen::VectorXd least_squares_step(const NormalEquations& normal, const Eigen::VectorXd& x, double ridge);

/// A wide prior about no effect: a thousand steps are worth a row of the floor's noise.
inline double wide_prior(double floor) { return 1e-6 * floor * floor; }

/// Of one block, about the fit.
NormalEquations sums_of(const Block& block, const Fit& fit, double floor);
/// A caliper's reading is worth a row of the floor's noise that shows the number alone.
NormalEquations sums_of_readings(const Evidence& evidence, const Fit& fit);
/// Sum of squares of what was measured by hand, each by its uncertainty.
double against_readings(const Evidence& evidence, const Imperfections& at);
/// Of all rows in use, and JJ and Jr of what was measured by hand: what one linear step needs.
NormalEquations sums_of_all(const Evidence& evidence, const Fit& fit);

/// Whether residual and slopes are numbers in every row in use.
bool is_finite(const Evidence& evidence, const Fit& fit);

}  // namespace fusee
