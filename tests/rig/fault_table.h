/// \file
/// Short type names and functions for the rows of the table of faults. rad, mm, N.
///
/// In a row, n[i] are the numbers that `.parameters` returns; `memory` is empty at the first call. Ranges in
/// brackets are those met in practice.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "rig/faults.h"
#include "rig/random.h"

namespace fusee::rig::fault_table {

using H = HiddenFaults;
using C = Character;
using D = Draw;
using J = MadeJoint;
using M = Moment;
using N = std::vector<double>;

std::vector<Fault> motor_faults();
std::vector<Fault> tendon_faults();
std::vector<Fault> joint_faults();
std::vector<Fault> sensor_faults();

// ---- reported numbers -----------------------------------------------------------------------------------------------

inline double percent(double share) { return 100.0 * share; }
/// amplitude · sin(angle + phase) as the sum of a sine and a cosine, degrees.
inline Numbers wave(double amplitude, double phase) {
  return {{"sin_deg", degrees(amplitude * std::cos(phase))}, {"cos_deg", degrees(amplitude * std::sin(phase))}};
}
inline Numbers wave(double amplitude, double phase, int order) {
  Numbers all = wave(amplitude, phase);
  all.emplace_back("harmonic", order);
  return all;
}
inline int order_of(const C& c) { return c.share < 0.7 ? 2 : 3; }

// ---- shapes of actions ----------------------------------------------------------------------------------------------

/// Seed of a fault's own random numbers.
inline double chance(const D& d) { return std::floor(1e6 * d.angle); }
inline double fraction(double x) { return x - std::floor(x); }
/// exp(−x²/2).
inline double bump(double x) { return std::exp(-0.5 * x * x); }
inline double sign_of(double x) { return (x > 0 ? 1.0 : 0.0) - (x < 0 ? 1.0 : 0.0); }

/// Play of ±`width`: output of a backlash whose input is `x`. `output` is its memory.
inline double behind(double x, double width, double& output) {
  return output = std::clamp(output, x - width, x + width);
}
/// First-order lag towards `to` with time constant `constant`, s. `output` is its memory.
inline double followed(double to, double seconds, double constant, double& output) {
  return output = to + (output - to) * std::exp(-seconds / constant);
}
/// Path of the motor since the last call, rad. `last` is the memory.
inline double motor_path(const Moment& now, double& last) {
  const double path = std::abs(now.alpha - last);
  last = now.alpha;
  return path;
}

inline double mean_tension(const Moment& now) {
  return 0.5 * (std::max(0.0, now.tension[0]) + std::max(0.0, now.tension[1]));
}
/// Resultant of tendons and load on the joint's axis, N.
inline Vec2 force_on_axis(const Moment& now) {
  const Vec2 load = now.load * Vec2(-std::cos(now.theta), std::sin(now.theta));
  return now.tension[0] * now.pull[0] + now.tension[1] * now.pull[1] + load;
}
/// Elongation of a tendon's path if the link's end moves by `moved`, mm.
inline double longer_by(const Moment& now, const Vec2& moved) { return -moved.dot(now.pull[now.side]); }
/// +1 for tendon 2, −1 for tendon 1: factor of an action that lengthens one and shortens the other.
inline double apart(const Moment& now) { return now.side == 1 ? 1.0 : -1.0; }

}  // namespace fusee::rig::fault_table
