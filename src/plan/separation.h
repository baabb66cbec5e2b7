/// \file
/// Separability of causes: margins from normal equations.
///
/// Model: y = A x + noise. Each element of x is in units of its usual size, y in units of the noise. AᵀA is a
/// sufficient statistic. To resolve cause a from cause b, b and the model error are fitted to the response of a. The
/// residual must exceed both the noise and the model's accuracy, which is a share of a's response. The model error has
/// a prior (Kennedy and O'Hagan 2001). For a cause with several numbers the margin is the expectation over normally
/// distributed numbers.
#pragma once

#include "plan/signatures.h"

namespace fusee::plan {

/// Normal equations, summed over runs and hand measurements.
struct Information {
  Eigen::MatrixXd runs;      ///< AᵀA of the run rows
  Eigen::MatrixXd readings;  ///< AᵀA of the hand measurements
  double rows = 0;           ///< number of run rows

  static Information none(Eigen::Index columns);
  Information with(const Signatures::RunEquations& run) const;
  Information with(const Eigen::MatrixXd& reading) const;
};

/// Separation of a cause at its usual size from `rival`, or from no cause if null, in units of the least separation
/// that resolves them.
double margin(const Signatures& signatures, const Information& known, const Cause& cause, const Cause* rival);

/// Rms response of the joint to the cause at its usual size, over the rows, in units of the noise.
double usual_rms(const Information& known, const Cause& cause);

}  // namespace fusee::plan
