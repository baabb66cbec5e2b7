/// \file
/// Internal: conditions that make a design possible and, if feasible = true, its pulleys drawable, as functions that
/// must be nonnegative. They serve numbers, to find their tightest places, and intervals with derivatives, to prove
/// that a box contains no such design.
///
/// These are the conditions of profile/feasibility.cpp, by the same equations. The closing arc is not among them: it is
/// found by a search and has no interval form. (A remaining free span follows from the advance of the take-off.)
#pragma once

#include "optimize/objective_at.h"
#include "profile/pitch_curve.h"

namespace fusee::optimize {

// Unqualified in the formulas, so that other kinds of numbers can have their own.
using transmission::cathetus;
using transmission::cos;
using transmission::squared;

/// Conditions at one point of the stroke. The first four apply to every design that has a value.
enum class DesignCondition {
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
constexpr std::size_t k_basic_conditions = 4;
constexpr std::size_t k_drawing_conditions = 6;  ///< method = "paper": radii too
constexpr std::size_t k_max_conditions = 10;     ///< method = "exact"

/// Number of conditions that apply to a design.
inline std::size_t condition_count(bool feasible, Method method) {
  if (!feasible) return k_basic_conditions;
  return method == Method::exact ? k_max_conditions : k_drawing_conditions;
}

/// Value of a condition, which must not be negative.
template <typename S>
struct ConditionValue {
  S value = 0.0;
  transmission::Domain domain;
};
template <typename S>
using ConditionValues = std::array<ConditionValue<S>, k_max_conditions>;

/// Relative derivative q = p'/p of a radius p by the image's joint angle.
template <typename S>
struct RadiusSlope {
  S q;
  S dq;      ///< q'
  S of_law;  ///< g'/g, of the law's slope g = dθ/dα
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

/// Sets two conditions of a pitch curve: the take-off advances (ψ' > 0), and the groove floor is convex. With
/// dp/dα = p g q, d²p/dα² = p g² (q² + q of_law + q') and ψ' = 1 + p'/w of profile/take_off.cpp, the radius of
/// curvature times ψ'³ is p ψ'³ + p'' − (p − ρ)(p'/w)³. Division by ψ' is avoided; the first condition keeps it
/// positive.
template <typename S>
void set_curve_conditions(const DesignNumbers<S>& d, const S& p, const S& to_pin, const S& g,
                          const RadiusSlope<S>& slope, const transmission::Domain& before, ConditionValue<S>& advance,
                          ConditionValue<S>& floor) {
  transmission::Domain domain = before;
  const S w = cathetus(to_pin, S(p - d.rho), domain);
  const S by_turn = p * g * slope.q / w;
  const S dpsi = 1.0 + by_turn;
  const S d2p = p * squared(g) * (slope.q * (slope.q + slope.of_law) + slope.dq);
  advance = {dpsi, domain};
  floor = {(p - d.half - profile::k_least_floor_radius) * (dpsi * squared(dpsi)) + d2p -
               (p - d.rho) * (by_turn * squared(by_turn)),
           domain};
}

/// Evaluates the first `count` conditions. False if a tendon has no moment arm, so that the others are undefined.
template <typename S>
bool conditions_at(const DesignNumbers<S>& d, const S& place, std::size_t count, ConditionValues<S>& values) {
  transmission::Domain arms;
  const StrokeNumbers<S> n = upper_stroke(d, place, arms);
  if (!arms.possible) return false;
  const auto set = [&values](DesignCondition condition, const S& value, const transmission::Domain& domain) {
    values[static_cast<std::size_t>(condition)] = {value, domain};
  };
  set(DesignCondition::clear_of_B, clear_of_guide(d, n.r1, transmission::Side::left), arms);
  set(DesignCondition::clear_of_D, clear_of_guide(d, n.r2, transmission::Side::right), arms);
  transmission::Domain of_B = arms, of_D = arms;
  const S wrap_B = wrap_over_B(d, n, of_B);
  set(DesignCondition::wrap_B, wrap_B, of_B);
  const S wrap_D =
      n.upper2.gamma - n.theta.angle - off_pin(d, lower_line_of(d, n.r2, transmission::Side::right, of_D).normal);
  set(DesignCondition::wrap_D, wrap_D, of_D);
  if (count <= k_basic_conditions) return true;
  set(DesignCondition::radius_1, n.r1 - d.half, arms);
  set(DesignCondition::radius_2, n.r2 - d.half, arms);
  if (count <= k_drawing_conditions) return true;
  const RadiusSlope<S> of_1 = arm_slope(d, n.upper1), of_2 = arm_slope(d, n.upper2);
  const auto at = [&values](DesignCondition condition) -> ConditionValue<S>& {
    return values[static_cast<std::size_t>(condition)];
  };
  if (d.linear) {
    const S g = 1.0 / d.ratio;
    set_curve_conditions(d, n.r1, d.to_B, g, of_1, arms, at(DesignCondition::advance_1), at(DesignCondition::floor_1));
    set_curve_conditions(d, n.r2, d.to_D, g, of_2, arms, at(DesignCondition::advance_2), at(DesignCondition::floor_2));
    return true;
  }
  // p2 = r1 m2/m1. Tendon 1 belongs to the other image: m1'/m1 changes its sign, its derivative does not.
  set(DesignCondition::advance_1, S(1.0), arms);
  set(DesignCondition::floor_1, n.r1 - d.half - profile::k_least_floor_radius, arms);
  set_curve_conditions(d, n.r2, d.to_D, S(d.r1 / (d.R * n.upper1.sine)), {of_2.q + of_1.q, of_2.dq - of_1.dq, of_1.q},
                       arms, at(DesignCondition::advance_2), at(DesignCondition::floor_2));
  return true;
}

}  // namespace fusee::optimize
