/// \file
/// Where a fault sits and what it looks like there: for every list of faults. rad, mm, N.
#pragma once

#include <algorithm>
#include <array>
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

/// The end of the range to either side of home.
inline double end_of_range(const Character& character, const MadeJoint& joint) {
  const Joint& declared = joint.declared.joint;
  return character.sign > 0 ? declared.theta_max : declared.theta_min;
}

/// rad: the ways from the pulley up to tendon 1's pin and to tendon 2's, each from upright to its own side.
inline std::array<double, 2> ways_to_pins(const MadeJoint& joint) {
  const Guides& guides = joint.declared.guides;
  const double EF = joint.declared.pulley.EF;
  return {std::atan2(guides.EB, EF), std::atan2(guides.ED, EF)};
}
/// Unit, along those.
inline std::array<Vec2, 2> up_to_pins(double first, double second) {
  return {Vec2(-std::sin(first), std::cos(first)), Vec2(std::sin(second), std::cos(second))};
}

inline double pretension(const MadeJoint& joint) { return joint.declared.tendon.pretension; }
/// mm by which a tendon is longer for a newton, roughly: over the link and down to the pulley.
inline double give(const MadeJoint& joint) {
  const Tendon& tendon = joint.declared.tendon;
  return (joint.declared.joint.R + joint.declared.pulley.EF) /
         (tendon.modulus * 0.25 * k_pi * tendon.diameter * tendon.diameter);
}

/// What lags behind `x` by up to `width` to either side (play); `where` is its memory.
inline double behind(double x, double width, double& where) {
  return where = std::clamp(where, x - width, x + width);
}

}  // namespace fusee::rig
