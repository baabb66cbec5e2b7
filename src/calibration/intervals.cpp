#include "calibration/intervals.h"

#include <cmath>

namespace fusee {

namespace {

/// In steps of the number, squared.
double variance_of(const Fit& fit, std::size_t k) {
  const auto i = static_cast<Eigen::Index>(k);
  return std::max(0.0, fit.explained.covariance(i, i));
}

ConfidenceInterval about(double x, double variance) {
  const double deviation = std::sqrt(variance);
  return {x - 1.96 * deviation, x + 1.96 * deviation, deviation};
}

}  // namespace

std::vector<ConfidenceInterval> intervals(const Fit& fit) {
  std::vector<ConfidenceInterval> found;
  for (std::size_t k = 0; k < fit.parameters.size(); ++k)
    found.push_back(about(fit.x[static_cast<Eigen::Index>(k)], variance_of(fit, k)));
  return found;
}

std::vector<ConfidenceInterval> intervals(const Selection& selection) {
  const Fit& best = selection.best;
  std::vector<ConfidenceInterval> found;
  for (std::size_t k = 0; k < best.parameters.size(); ++k) {
    const auto apart = selection.spread.find(best.parameters[k]);
    const double beside = apart == selection.spread.end() ? 0.0 : apart->second;
    found.push_back(about(best.x[static_cast<Eigen::Index>(k)], selection.temperature * variance_of(best, k) + beside));
  }
  return found;
}

}  // namespace fusee
