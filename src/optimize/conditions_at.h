/// \file
/// Internal: what has to hold for a design to be possible, and (feasible = true) for its pulleys to be drawn, as
/// functions that must not be negative: for numbers, to see where they are tightest, and for intervals with
/// derivatives, to prove that a box holds no such design.
///
/// The conditions of profile/feasibility.cpp, by the same equations. Not among them is the arc that closes a pulley: it
/// is found by a search and has no interval form. (That a free span is left follows from the take-off's advance.)
#pragma once

#include "optimize/objective_at.h"
#include "profile/pitch_curve.h"

namespace fusee {

/// At one place of the stroke. The first four are those of every design that has a value.
enum class Needed {
  clear_of_B,
  clear_of_D,
  wrap_B,
  wrap_D,
  radius_1,
  radius_2,
  advance_1,
  advance_2,
  floor_1,
  floor_2
};
constexpr std::size_t k_needed_always = 4;
constexpr std::size_t k_needed_of_drawing = 6;  ///< method = "paper": radii too
constexpr std::size_t k_needed_most = 10;       ///< method = "exact"

/// How many of them a design is asked for.
inline std::size_t needed_count(bool feasible, Method method) {
  if (!feasible) return k_needed_always;
  return method == Method::exact ? k_needed_most : k_needed_of_drawing;
}

template <typename S>
struct NeededValue {
  S value = 0.0;
  Domain domain;
};
template <typename S>
using NeededValues = std::array<NeededValue<S>, k_needed_most>;

/// How the radius p answers to the image's joint angle: p'/p and its derivative, and what of the law's slope stands in
/// it.
template <typename S>
struct RadiusSlope {
  S q, dq, of_law;
};

/// m'/m and its derivative, from the derivation above upper_span() in transmission/tendon_path.cpp.
template <typename S>
RadiusSlope<S> arm_slope(const DesignNumbers<S>& d, const UpperNumbers<S>& upper) {
  const S cosine = cos(upper.gamma), cotangent = cosine / upper.sine, m = d.R * upper.sine;
  const S turn = -(d.R * cosine / upper.free);  // ψ'
  const S omega = 1.0 + turn;
  const S bend = (m * omega + turn * (m + d.rho * turn)) / upper.free;  // ψ''
  const S q = cotangent * omega;
  return {q, cotangent * bend - squared(omega) - squared(q), S(0.0)};
}

/// With dp/dα = p g q and d²p/dα² = p g² (q² + q of_law + q'), and the take-off's ψ' = 1 + p'/w of
/// profile/take_off.cpp: the radius of curvature times ψ'³ is p ψ'³ + p'' − (p − ρ)(p'/w)³. No quotient by ψ', which
/// other conditions keep positive.
template <typename S>
void add_curve(const DesignNumbers<S>& d, const S& p, const S& to_pin, const S& g, const RadiusSlope<S>& slope,
               const Domain& before, NeededValue<S>& advance, NeededValue<S>& floor) {
  Domain domain = before;
  const S w = cathetus(to_pin, S(p - d.rho), domain);
  const S by_turn = p * g * slope.q / w;
  const S dpsi = 1.0 + by_turn;
  const S d2p = p * squared(g) * (slope.q * (slope.q + slope.of_law) + slope.dq);
  advance = {dpsi, domain};
  floor = {
      (p - d.half - k_least_floor_radius) * (dpsi * squared(dpsi)) + d2p - (p - d.rho) * (by_turn * squared(by_turn)),
      domain};
}

/// `count` of them. False where a tendon has no moment arm: nothing else can be asked then.
template <typename S>
bool needed_at(const DesignNumbers<S>& d, const S& place, std::size_t count, NeededValues<S>& values) {
  Domain arms;
  const StrokeNumbers<S> n = upper_stroke(d, place, arms);
  if (!arms.possible) return false;
  const auto set = [&values](Needed which, const S& value, const Domain& domain) {
    values[static_cast<std::size_t>(which)] = {value, domain};
  };
  set(Needed::clear_of_B, clear_of_guide(d, n.r1, true), arms);
  set(Needed::clear_of_D, clear_of_guide(d, n.r2, false), arms);
  Domain of_B = arms, of_D = arms;
  const S wrap_B = wrap_over_B(d, n, of_B);
  set(Needed::wrap_B, wrap_B, of_B);
  const S wrap_D = n.upper2.gamma - n.theta.angle - off_pin(d, lower_line_of(d, n.r2, false, of_D).normal);
  set(Needed::wrap_D, wrap_D, of_D);
  if (count <= k_needed_always) return true;
  set(Needed::radius_1, n.r1 - d.half, arms);
  set(Needed::radius_2, n.r2 - d.half, arms);
  if (count <= k_needed_of_drawing) return true;
  const RadiusSlope<S> of_1 = arm_slope(d, n.upper1), of_2 = arm_slope(d, n.upper2);
  const auto at = [&values](Needed which) -> NeededValue<S>& { return values[static_cast<std::size_t>(which)]; };
  if (d.linear) {
    const S g = 1.0 / d.ratio;
    add_curve(d, n.r1, d.to_B, g, of_1, arms, at(Needed::advance_1), at(Needed::floor_1));
    add_curve(d, n.r2, d.to_D, g, of_2, arms, at(Needed::advance_2), at(Needed::floor_2));
    return true;
  }
  // p2 = r1 m2/m1, and tendon 1 is seen in the other image: m1'/m1 changes its sign, its derivative does not.
  set(Needed::advance_1, S(1.0), arms);
  set(Needed::floor_1, n.r1 - d.half - k_least_floor_radius, arms);
  add_curve(d, n.r2, d.to_D, S(d.r1 / (d.R * n.upper1.sine)), {of_2.q + of_1.q, of_2.dq - of_1.dq, of_1.q}, arms,
            at(Needed::advance_2), at(Needed::floor_2));
  return true;
}

}  // namespace fusee
