/// \file
/// Internal: sampling of a target motion.
#pragma once

#include <algorithm>
#include <vector>

#include "fusee/transmission.h"

namespace fusee::transmission {

/// steps + 1 pulley angles, evenly spaced over the range, both ends included.
inline std::vector<double> alphas_over_range(const Transmission& law, int steps) {
  std::vector<double> alphas;
  for (int i = 0; i <= steps; ++i) alphas.push_back(law.alpha_min() + (law.alpha_max() - law.alpha_min()) * i / steps);
  return alphas;
}

/// Points of the law evenly spaced in α, home included.
inline std::vector<TransmissionPoint> stroke_over_range(const Transmission& transmission, int steps) {
  std::vector<double> alphas = alphas_over_range(transmission, steps);
  // Home is a row of its own, unless a row equals it up to rounding.
  constexpr double k_rounding = 1e-9;  // rad
  const auto after = std::lower_bound(alphas.begin(), alphas.end(), -k_rounding);
  if (after != alphas.end() && *after < k_rounding) {
    *after = 0.0;
  } else {
    alphas.insert(after, 0.0);
  }
  std::vector<TransmissionPoint> points;
  for (const double alpha : alphas) points.push_back(transmission.at_alpha(alpha));
  return points;
}

}  // namespace fusee::transmission
