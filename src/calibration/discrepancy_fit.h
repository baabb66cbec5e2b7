/// \file
/// Description of the discrepancy beside a set of effects: its components, their sizes and possible places.
#pragma once

#include <vector>

#include "calibration/fit.h"
#include "fusee/calibration.h"

namespace fusee::calibration {

struct DiscrepancyFit {
  double evidence = 0;  ///< log Bayes factor of the discrepancy to noise and the model's own error alone
  double rms = 0;       ///< rms of the discrepancy, rad
  std::vector<DiscrepancyComponent> parts;  ///< components, largest first
  Posterior posterior;                      ///< posterior with the described factors, each with its amplitude
};

/// True for factors of motor angle and direction alone.
bool is_of_place(Factor factor);

/// True for every factor.
bool is_any(Factor factor);

/// Describes the discrepancy beside `fit` by the considered factors. Components that the data hardly require are
/// omitted.
DiscrepancyFit describe_discrepancy(const Evidence& evidence, const Fit& fit, bool (*is_considered)(Factor) = is_any);

/// True if the residual exceeds noise and the model's own error.
bool is_unexplained(const DiscrepancyFit& unmodelled, double floor);

}  // namespace fusee::calibration
