/// \file
/// Likely input errors of file and data, and the joint and data after their correction.
#pragma once

#include <vector>

#include "fusee/calibration.h"

namespace fusee::calibration {

/// Corrected input error, before it is compared with data.
struct InputErrorHypothesis {
  LikelyInputError error;   ///< the error, without its rms
  DeclaredMechanism joint;  ///< corrected joint
  DeclaredMechanism drawn;  ///< joint for which its pulley was made
  double alpha = 1;         ///< factor on the logged angles
  double theta = 1;
};

/// Likely input errors of `declared` and its data, one at a time.
std::vector<InputErrorHypothesis> input_error_hypotheses(const DeclaredMechanism& declared);

}  // namespace fusee::calibration
