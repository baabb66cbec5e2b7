/// \file
/// Shapes that actions of several lists of faults share. rad, mm, N.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "rig/faults.h"

namespace fusee::rig {

/// 1 at 0, falling to either side with standard deviation 1.
inline double bump(double x) { return std::exp(-0.5 * x * x); }
/// +1, −1, or 0.
inline double sign_of(double x) { return (x > 0 ? 1.0 : 0.0) - (x < 0 ? 1.0 : 0.0); }

/// Play: follows `x` once it is `width` away to either side. `where` is its memory.
inline double behind(double x, double width, double& where) { return where = std::clamp(where, x - width, x + width); }
/// A first-order lag towards `to` with a time constant, s. `where` is its memory.
inline double followed(double to, double seconds, double constant, double& where) {
  return where = to + (where - to) * std::exp(-seconds / constant);
}
/// The motor's path since the last call, rad. `last` is its memory.
inline double motor_path(const Moment& now, double& last) {
  const double path = std::abs(now.alpha - last);
  last = now.alpha;
  return path;
}

/// Resultant of both tendons and the load on the joint's axis, N.
inline Vec2 force_on_axis(const Moment& now) {
  const Vec2 load = now.load * Vec2(-std::cos(now.theta), std::sin(now.theta));
  return now.tension[0] * now.pull[0] + now.tension[1] * now.pull[1] + load;
}
/// By how much a tendon's way is longer when the link's end is displaced by `moved`, mm.
inline double longer_by(const Moment& now, const Vec2& moved) { return -moved.dot(now.pull[now.side]); }
/// +1 for tendon 2, −1 for tendon 1: an action that lengthens one and shortens the other.
inline double apart(const Moment& now) { return now.side == 1 ? 1.0 : -1.0; }

}  // namespace fusee::rig
