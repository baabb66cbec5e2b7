/// \file
/// Where a fault sits and what it looks like there: for every list of faults. rad.
#pragma once

#include <cmath>

#include "rig/faults.h"

namespace fusee::rig {

/// 1 at 0, falling to either side with standard deviation 1.
inline double bump(double x) { return std::exp(-0.5 * x * x); }

/// A place within the middle 60 % of the declared stroke, drawn.
inline double alpha_within(const Character& character, const MadeJoint& joint) {
  return joint.alpha_min + (0.2 + 0.6 * character.share) * (joint.alpha_max - joint.alpha_min);
}
inline double theta_within(const Character& character, const MadeJoint& joint) {
  const Joint& declared = joint.declared.joint;
  return declared.theta_min + (0.2 + 0.6 * character.share) * (declared.theta_max - declared.theta_min);
}

}  // namespace fusee::rig
