// ChebyshevSeries, in which SlopedPaths stores changes of length.
#include <cmath>

#include "fusee/base.h"
#include "fusee/transmission.h"

namespace fusee::transmission {
namespace {

/// Clenshaw's recurrence for Σ c_k T_k(t).
double chebyshev_sum(const std::vector<double>& coefficients, double t) {
  double next = 0, after = 0;
  for (std::size_t k = coefficients.size(); k-- > 1;) {
    const double here = coefficients[k] + 2.0 * t * next - after;
    after = next;
    next = here;
  }
  return coefficients.empty() ? 0.0 : coefficients[0] + t * next - after;
}

/// Coefficients of the derivative by x: d_{k−1} = d_{k+1} + 2k c_k, times `scale` = dt/dx.
std::vector<double> derivative_of(const std::vector<double>& c, double scale) {
  const std::size_t n = c.size();
  std::vector<double> d(n < 2 ? 1 : n - 1, 0.0);
  for (std::size_t k = n; k-- > 1;)
    d[k - 1] = (k + 1 < d.size() ? d[k + 1] : 0.0) + 2.0 * static_cast<double>(k) * c[k];
  d[0] *= 0.5;
  for (double& value : d) value *= scale;
  return d;
}

double node_angle(int i, int count) { return k_pi * (i + 0.5) / count; }

}  // namespace

std::vector<double> ChebyshevSeries::nodes(double low, double high, int count) {
  std::vector<double> places;
  for (int i = 0; i < count; ++i)
    places.push_back(0.5 * (low + high) + 0.5 * (high - low) * elementary::cos(node_angle(i, count)));
  return places;
}

ChebyshevSeries::ChebyshevSeries(double low, double high, const std::vector<double>& values, double least)
    : low_(low), high_(high) {
  const int count = static_cast<int>(values.size());
  // Discrete cosine transform of the values at the nodes.
  std::vector<double>& c = coefficients_[0];
  for (int k = 0; k < count; ++k) {
    double sum = 0;
    for (int i = 0; i < count; ++i)
      sum += values[static_cast<std::size_t>(i)] * elementary::cos(k * node_angle(i, count));
    c.push_back((k == 0 ? 1.0 : 2.0) * sum / count);
  }
  while (c.size() > 1 && std::abs(c.back()) < least) c.pop_back();
  for (std::size_t order = 1; order < coefficients_.size(); ++order)
    coefficients_[order] = derivative_of(coefficients_[order - 1], 2.0 / (high_ - low_));
}

ChebyshevSeries::Value ChebyshevSeries::at(double x) const {
  const double t = (2.0 * x - low_ - high_) / (high_ - low_);
  return {chebyshev_sum(coefficients_[0], t), chebyshev_sum(coefficients_[1], t), chebyshev_sum(coefficients_[2], t),
          chebyshev_sum(coefficients_[3], t)};
}

}  // namespace fusee::transmission
