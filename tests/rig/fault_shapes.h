/// \file
/// Where a fault sits and what it looks like there: for every list of faults. rad, mm, N.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

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
inline double behind(double x, double width, double& where) { return where = std::clamp(where, x - width, x + width); }
/// What follows `to` with a time constant, s; `where` is its memory.
inline double followed(double to, double seconds, double constant, double& where) {
  return where = to + (where - to) * std::exp(-seconds / constant);
}
/// How often the motor has turned round so far; `memory` holds its last way, and that.
inline double reversals(const Moment& now, std::vector<double>& memory) {
  if (memory.empty()) memory = {now.direction, 0.0};
  if (now.direction * memory[0] < 0) memory[1] += 1.0;
  memory[0] = now.direction;
  return memory[1];
}

/// N: of both tendons and the load, on the joint's axis.
inline Vec2 force_on_axis(const Moment& now) {
  const Vec2 load = now.load * Vec2(-std::cos(now.theta), std::sin(now.theta));
  return now.tension[0] * now.pull[0] + now.tension[1] * now.pull[1] + load;
}
/// The link's end lies off by `moved`, and the way to a pin is so much shorter.
template <std::size_t side>
double nearer(const Moment& now, const Vec2& moved) {
  return -moved.dot(now.pull[side]);
}

}  // namespace fusee::rig
