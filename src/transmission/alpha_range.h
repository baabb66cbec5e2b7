/// \file
/// Internal: places along a declared law.
#pragma once

#include <vector>

#include "fusee/transmission/transmission.h"

namespace fusee {

/// steps + 1 pulley angles, evenly over the range, both ends among them.
inline std::vector<double> alphas_over_range(const Transmission& law, int steps) {
  std::vector<double> alphas;
  for (int i = 0; i <= steps; ++i) alphas.push_back(law.alpha_min() + (law.alpha_max() - law.alpha_min()) * i / steps);
  return alphas;
}

}  // namespace fusee
