/// \file
/// The full model over the declared load's cycle, once it has bedded in.
#pragma once

#include <vector>

#include "fusee/joint/equilibrium.h"

namespace fusee {

struct StrokePoint {
  EquilibriumPoint rising;   ///< α growing
  EquilibriumPoint falling;  ///< α falling
};

/// At each of `alphas` (increasing, both ends of the range among them), in the third cycle from home.
std::vector<StrokePoint> settled_stroke(const Mechanism& mechanism, const std::vector<double>& alphas);

}  // namespace fusee
