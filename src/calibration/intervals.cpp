#include "calibration/intervals.h"

#include <cmath>

namespace fusee::calibration {
namespace {

/// Variance of the k-th x, in its steps².
double variance_of(const Fit& fit, std::size_t k) {
  const auto i = static_cast<Eigen::Index>(k);
  return std::max(0.0, fit.posterior.covariance(i, i));
}

std::vector<ConfidenceInterval> intervals(const Selection& selection, double Selection::Variance::*of) {
  const Fit& best = selection.best;
  std::vector<ConfidenceInterval> found;
  for (std::size_t k = 0; k < best.parameters.size(); ++k) {
    const auto known = selection.variance.find(best.parameters[k]);
    const double variance = known == selection.variance.end() ? variance_of(best, k) : known->second.*of;
    found.push_back(ConfidenceInterval::about(best.x[static_cast<Eigen::Index>(k)], variance));
  }
  return found;
}

}  // namespace

ConfidenceInterval ConfidenceInterval::about(double x, double variance) {
  const double deviation = std::sqrt(variance);
  return {x - 1.96 * deviation, x + 1.96 * deviation, deviation};
}

std::vector<ConfidenceInterval> intervals(const Fit& fit) {
  std::vector<ConfidenceInterval> found;
  for (std::size_t k = 0; k < fit.parameters.size(); ++k)
    found.push_back(ConfidenceInterval::about(fit.x[static_cast<Eigen::Index>(k)], variance_of(fit, k)));
  return found;
}

std::vector<ConfidenceInterval> intervals(const Selection& selection) {
  return intervals(selection, &Selection::Variance::overall);
}

std::vector<ConfidenceInterval> intervals_if_only(const Selection& selection) {
  return intervals(selection, &Selection::Variance::if_only);
}

}  // namespace fusee::calibration
