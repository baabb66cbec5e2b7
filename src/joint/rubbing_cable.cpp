#include "joint/rubbing_cable.h"

#include <algorithm>
#include <cmath>

// Eight contacts leave steps of an eighth of the hysteresis. Four or sixteen change the held-out residual of five
// measured joints by less than 1 %.

namespace fusee::joint {

RubbingCable::RubbingCable(const RatioJointError& joint, double driven) : joint_(joint) { angles_.fill(driven); }

double RubbingCable::to(double driven, double load) {
  if (joint_.friction == CableFriction{}) return driven - deflection(load);
  const double mean_friction = joint_.friction.at(load);
  double sum = 0;
  for (std::size_t i = 0; i < k_contacts; ++i) {
    // Thresholds are evenly spread from 0 to twice the mean.
    const double friction = mean_friction * (2.0 * static_cast<double>(i) + 1.0) / k_contacts;
    const double one = driven - deflection(load + friction), other = driven - deflection(load - friction);
    angles_[i] = std::clamp(angles_[i], std::min(one, other), std::max(one, other));
    sum += angles_[i];
  }
  return sum / k_contacts;
}

}  // namespace fusee::joint
