/// \file
/// Spirals with a closed form. mm, rad.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "fusee/base.h"
#include "fusee/helical_solid.h"
#include "fusee/helix.h"

namespace fusee::testing {

/// A curve from its support function p(ψ) with two derivatives: X = p n + p' t, ρ = p + p''.
struct SupportCurve {
  std::function<double(double)> p, dp, d2p;
};

/// The spiral over a curve from the turn `begin` on, with rows at most `step` apart.
inline helix::Spiral spiral_of(const SupportCurve& curve, double begin, double turns, double slope,
                               double step = 0.02) {
  helix::Spiral spiral;
  spiral.slope = slope;
  const int count = static_cast<int>(std::ceil(turns * k_two_pi / step));
  double s = 0, before = begin;
  for (int k = 0; k <= count; ++k) {
    const double turn = begin + turns * k_two_pi * k / count;
    const auto rho = [&curve](double at) { return curve.p(at) + curve.d2p(at); };
    // Simpson's rule.
    s += (turn - before) * (rho(before) + 4.0 * rho(0.5 * (before + turn)) + rho(turn)) / 6.0;
    before = turn;
    const Vec2 at = curve.p(turn) * unit(turn) + curve.dp(turn) * turned_left(unit(turn));
    spiral.rows.push_back({at.x(), at.y(), turn, rho(turn), s, slope * s});
  }
  // One spare turn at both ends.
  const auto spare = static_cast<std::size_t>(std::lround(count / turns));
  spiral.first_used = std::min(spare, spiral.rows.size() - 1);
  spiral.last_used = spiral.rows.size() - 1 - spiral.first_used;
  if (spiral.last_used < spiral.first_used) spiral.first_used = spiral.last_used = spiral.rows.size() / 2;
  return spiral;
}

inline SupportCurve round_curve(double radius) {
  return {[radius](double) { return radius; }, [](double) { return 0.0; }, [](double) { return 0.0; }};
}
/// p = a + b ψ: an involute of a circle of radius b.
inline SupportCurve growing(double radius, double per_turn, double begin) {
  const double rate = per_turn / k_two_pi;
  return {[=](double t) { return radius + rate * (t - begin); }, [=](double) { return rate; },
          [](double) { return 0.0; }};
}
/// An oval that grows by `per_turn`. `wave`: amplitude of its support function.
inline SupportCurve oval(double radius, double per_turn, double wave, double begin) {
  const double rate = per_turn / k_two_pi;
  return {[=](double t) { return radius + rate * (t - begin) + wave * std::cos(2.0 * t); },
          [=](double t) { return rate - 2.0 * wave * std::sin(2.0 * t); },
          [=](double t) { return -4.0 * wave * std::cos(2.0 * t); }};
}

/// The least slope at which neighbouring turns of `turns` turns of a curve clear each other.
inline double slope_for(const SupportCurve& curve, double begin, double turns,
                        const helical_solid::HelicalSection& section) {
  double slope = 0;
  const auto rho = [&curve](double at) { return curve.p(at) + curve.d2p(at); };
  constexpr int k_steps = 400;
  for (double at = begin; at + k_two_pi <= begin + turns * k_two_pi; at += 0.05) {
    double s = 0;
    for (int k = 0; k < k_steps; ++k) s += rho(at + k_two_pi * (k + 0.5) / k_steps) * k_two_pi / k_steps;
    slope = std::max(slope, helical_solid::least_lead(section, curve.p(at) - curve.p(at + k_two_pi)) / s);
  }
  return slope;
}

}  // namespace fusee::testing
