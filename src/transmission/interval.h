/// \file
/// Internal: interval arithmetic that encloses the true value under any rounding, with first derivatives.
///
/// Boost.Interval's four operations round outward while a RoundingUp exists, and are wrong without one. Elementary
/// functions have errors below 2 units in the last place in any rounding mode (tests/base/elementary_test.cpp). Four
/// are assumed here.
#pragma once

#include <algorithm>
#include <array>
#include <boost/numeric/interval.hpp>
#include <limits>

#include "transmission/scalar.h"

namespace fusee::transmission {

using RoundedInterval = boost::numeric::interval<
    double, boost::numeric::interval_lib::policies<
                boost::numeric::interval_lib::save_state<boost::numeric::interval_lib::rounded_arith_opp<double>>,
                boost::numeric::interval_lib::checking_base<double>>>;
using Interval = boost::numeric::interval_lib::unprotect<RoundedInterval>::type;
/// Sets upward rounding for its lifetime. Keep it in one function and the arithmetic in another: the compiler may move
/// arithmetic across its ends.
using RoundingUp = RoundedInterval::traits_type::rounding;

inline double rounding_margin(double value) {
  return 4.0 * std::numeric_limits<double>::epsilon() * std::abs(value) + std::numeric_limits<double>::min();
}
/// Bounds of a rounded value. With upward rounding, the negated difference in below() is rounded downwards.
inline double below(double value) { return -(rounding_margin(value) - value); }
inline double above(double value) { return value + rounding_margin(value); }

/// Interval image of an increasing function.
template <typename Function>
Interval increasing_image(const Interval& x, Function function) {
  return {below(function(x.lower())), above(function(x.upper()))};
}

inline Interval exp(const Interval& x) {
  return increasing_image(x, [](double v) { return elementary::exp(v); });
}
inline Interval atan(const Interval& x) {
  return increasing_image(x, [](double v) { return elementary::atan(v); });
}
inline Interval acos(const Interval& x) {
  return {below(elementary::acos(x.upper())), above(elementary::acos(x.lower()))};
}
inline Interval sqrt(const Interval& x) {
  return increasing_image(x, [](double v) { return std::sqrt(std::max(v, 0.0)); });
}
inline Interval pi_interval() { return {below(k_pi), above(k_pi)}; }

/// Sine for angles within ±2.5 π. Joint angles lie within ±π, line directions within 1.5 π, and sums of both occur.
inline Interval sin(const Interval& x) {
  const Interval low = {below(elementary::sin(x.lower())), above(elementary::sin(x.lower()))};
  const Interval high = {below(elementary::sin(x.upper())), above(elementary::sin(x.upper()))};
  Interval hull = boost::numeric::hull(low, high);
  const double slack = 1e-9;  // rad, covers the rounding of the extrema's places
  for (const double top : {-1.5 * k_pi, 0.5 * k_pi, 2.5 * k_pi}) {
    if (x.lower() <= top + slack && x.upper() >= top - slack) hull = boost::numeric::hull(hull, Interval(1.0));
  }
  for (const double bottom : {-2.5 * k_pi, -0.5 * k_pi, 1.5 * k_pi}) {
    if (x.lower() <= bottom + slack && x.upper() >= bottom - slack) hull = boost::numeric::hull(hull, Interval(-1.0));
  }
  return hull;
}
inline Interval cos(const Interval& x) { return sin(x + pi_interval() * 0.5); }
inline Interval squared(const Interval& x) { return boost::numeric::square(x); }
inline Interval larger(const Interval& a, const Interval& b) {
  return {std::max(a.lower(), b.lower()), std::max(a.upper(), b.upper())};
}

/// The part of x above 0. Its lower end stays above 0, so that it may be a divisor.
inline Interval positive_part(const Interval& x, Domain& domain) {
  if (!(x.upper() > 0)) domain.possible = false;
  if (x.lower() > 0) return x;
  domain.whole = false;
  constexpr double least = 1e-200;
  return {least, std::max(x.upper(), least)};
}

/// The part of x within ±1.
inline Interval unit_part(const Interval& x, Domain& domain) {
  if (!(x.lower() <= 1 && x.upper() >= -1)) domain.possible = false;
  if (x.lower() > -1 && x.upper() < 1) return x;
  domain.whole = false;
  return {std::clamp(x.lower(), -1.0, 1.0), std::clamp(x.upper(), -1.0, 1.0)};
}

inline void demand_not_negative(const Interval& x, Domain& domain) {
  if (x.upper() < 0) domain.possible = false;
}

// First derivatives ---------------------------------------------------------------------------------------------------

/// A value over a box and its derivatives by the box's variables, all as intervals.
struct Jet {
  static constexpr int k_most = 8;  ///< most variables of a box
  Interval value = 0.0;
  std::array<Interval, k_most> slope{};
  int count = 0;  ///< slopes in use; 0: a constant

  Jet() = default;
  Jet(double constant) : value(constant) {}           // NOLINT: constants occur in formulas
  Jet(const Interval& constant) : value(constant) {}  // NOLINT
  static Jet variable(const Interval& value, int index, int count) {
    Jet jet(value);
    jet.count = count;
    for (int i = 0; i < count; ++i) jet.slope[static_cast<std::size_t>(i)] = i == index ? 1.0 : 0.0;
    return jet;
  }
};

/// f(a), given its value and df/da.
inline Jet chained(const Jet& a, const Interval& value, const Interval& derivative) {
  Jet jet(value);
  jet.count = a.count;
  for (std::size_t i = 0; i < static_cast<std::size_t>(a.count); ++i) jet.slope[i] = derivative * a.slope[i];
  return jet;
}
/// f(a, b), given its value and both partial derivatives.
inline Jet chained(const Jet& a, const Jet& b, const Interval& value, const Interval& da, const Interval& db) {
  if (b.count == 0) return chained(a, value, da);
  if (a.count == 0) return chained(b, value, db);
  Jet jet(value);
  jet.count = a.count;
  for (std::size_t i = 0; i < static_cast<std::size_t>(a.count); ++i) jet.slope[i] = da * a.slope[i] + db * b.slope[i];
  return jet;
}

inline Jet operator+(const Jet& a, const Jet& b) { return chained(a, b, a.value + b.value, 1.0, 1.0); }
inline Jet operator-(const Jet& a, const Jet& b) { return chained(a, b, a.value - b.value, 1.0, -1.0); }
inline Jet operator-(const Jet& a) { return chained(a, -a.value, -1.0); }
inline Jet operator*(const Jet& a, const Jet& b) { return chained(a, b, a.value * b.value, b.value, a.value); }
inline Jet operator/(const Jet& a, const Jet& b) {
  const Interval inverse = 1.0 / b.value, quotient = a.value / b.value;
  return chained(a, b, quotient, inverse, -quotient * inverse);
}
inline Jet squared(const Jet& a) { return chained(a, squared(a.value), 2.0 * a.value); }
inline Jet sqrt(const Jet& a) {
  const Interval root = sqrt(a.value);
  return chained(a, root, 0.5 / root);
}
inline Jet exp(const Jet& a) {
  const Interval power = exp(a.value);
  return chained(a, power, power);
}
inline Jet sin(const Jet& a) { return chained(a, sin(a.value), cos(a.value)); }
inline Jet cos(const Jet& a) { return chained(a, cos(a.value), -sin(a.value)); }
inline Jet atan(const Jet& a) { return chained(a, atan(a.value), 1.0 / (1.0 + squared(a.value))); }
inline Jet acos(const Jet& a) { return chained(a, acos(a.value), -1.0 / sqrt(1.0 - squared(a.value))); }
inline Jet larger(const Jet& a, const Jet& b) {
  if (a.value.lower() >= b.value.upper()) return a;
  if (b.value.lower() >= a.value.upper()) return b;
  // Either may be larger within the box, so the slope lies between both.
  return chained(a, b, larger(a.value, b.value), Interval(0.0, 1.0), Interval(0.0, 1.0));
}
inline Jet positive_part(const Jet& a, Domain& domain) {
  Jet jet = a;
  jet.value = positive_part(a.value, domain);
  return jet;
}
inline Jet unit_part(const Jet& a, Domain& domain) {
  Jet jet = a;
  jet.value = unit_part(a.value, domain);
  return jet;
}
inline void demand_not_negative(const Jet& a, Domain& domain) { demand_not_negative(a.value, domain); }

inline Jet hypot(const Jet& a, const Jet& b) { return sqrt(squared(a) + squared(b)); }
/// Squares before subtracting: an interval is tighter when each variable occurs less often.
inline Jet cathetus(const Jet& hypotenuse, const Jet& other, Domain& domain) {
  return sqrt(positive_part(squared(hypotenuse) - squared(other), domain));
}
/// As for numbers (scalar.h), within −90° … 270°. A box that reaches the origin or straight down has all these
/// directions.
inline Jet direction(const Jet& x, const Jet& y, Domain& domain) {
  const Interval pi = pi_interval();
  if (y.value.lower() > 0) return Jet(0.5 * pi) - atan(x / y);
  if (x.value.lower() > 0) return atan(y / x);
  if (x.value.upper() < 0) return Jet(pi) + atan(y / x);
  domain.whole = false;
  return boost::numeric::hull(-0.5 * pi, 1.5 * pi);
}

}  // namespace fusee::transmission
