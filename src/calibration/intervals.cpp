#include "calibration/intervals.h"

#include <cmath>

namespace fusee {

std::vector<ConfidenceInterval> intervals(const Evidence&, const Fit& fit) {
  std::vector<ConfidenceInterval> found(static_cast<std::size_t>(fit.x.size()));
  for (std::size_t k = 0; k < found.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    found[k].deviation = std::sqrt(std::max(0.0, fit.explained.covariance(i, i)));
    found[k].low = fit.x[i] - 1.96 * found[k].deviation;
    found[k].high = fit.x[i] + 1.96 * found[k].deviation;
  }
  return found;
}

}  // namespace fusee
