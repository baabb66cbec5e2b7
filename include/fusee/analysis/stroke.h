/// \file
/// The full model over a cycle of the declared load, after settling.
#pragma once

#include <vector>

#include "fusee/joint/equilibrium.h"

namespace fusee {

struct StrokePoint {
  EquilibriumPoint rising;   ///< α increasing
  EquilibriumPoint falling;  ///< α decreasing
};

/// The third cycle from home at each of `alphas` (increasing, with both ends of the range).
std::vector<StrokePoint> settled_stroke(const Mechanism& mechanism, const std::vector<double>& alphas);

}  // namespace fusee
