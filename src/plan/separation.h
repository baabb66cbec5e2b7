/// \file
/// Whether measurements tell causes apart: sums of squares in, margins out.
///
/// y = A x + noise, every number of x at its usual size 1: all that measurements say is in AᵀA. A cause a, at its usual
/// size, is told from another, b, when what is left of it after b and the model's own error were fitted is beyond the
/// noise, and no part of a that small is a's model to be trusted with. Kennedy and O'Hagan 2001 (the model's error as
/// a prior); for the sum over a cause's numbers, the expectation over their directions.
#pragma once

#include "plan/signatures.h"

namespace fusee {

/// Of runs and readings that were added up.
struct Information {
  Eigen::MatrixXd runs;      ///< AᵀA of rows
  Eigen::MatrixXd readings;  ///< of what was read by hand
  double rows = 0;

  static Information none(Eigen::Index columns);
  Information with(const Signatures::Seen& seen) const;
  Information with(const Eigen::MatrixXd& reading) const;
};

/// By how much a cause of its usual size is told from another, or with null from nothing: 1 is just told.
double margin(const Signatures& signatures, const Information& known, const Cause& cause, const Cause* rival);

/// What the cause moves the joint by at its usual size, rms over the rows, in units of the noise.
double usual_rms(const Information& known, const Cause& cause);

}  // namespace fusee
