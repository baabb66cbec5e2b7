/// \file
/// Internal: the elementary functions of equations.h for plain numbers. interval.h has the same functions for intervals
/// with derivatives.
#pragma once

#include <algorithm>
#include <cmath>

#include "fusee/base.h"

namespace fusee::transmission {

/// Domain violations met while evaluating a formula. Of an interval, a part or all may lie outside the domain.
struct Domain {
  bool possible = true;  ///< false: the formula has no value, for a number or anywhere in the box
  bool whole = true;     ///< false: a part was cut off, and derivatives are meaningless
};

using elementary::acos, elementary::atan, elementary::cos, elementary::exp, elementary::hypot, elementary::sin,
    std::sqrt;
inline double squared(double x) { return x * x; }
inline double larger(double a, double b) { return std::max(a, b); }
/// x, unchanged; the formula has no value unless x > 0.
inline double positive_part(double x, Domain& domain) {
  if (!(x > 0)) domain.possible = false;
  return x;
}
/// x, unchanged; the formula has no value unless x lies within ±1.
inline double unit_part(double x, Domain& domain) {
  if (!(x >= -1 && x <= 1)) domain.possible = false;
  return x;
}
inline void demand_not_negative(double x, Domain& domain) {
  if (!(x >= 0)) domain.possible = false;
}

/// The other leg of a right triangle.
inline double cathetus(double hypotenuse, double other, Domain& domain) {
  return std::sqrt(positive_part((hypotenuse - other) * (hypotenuse + other), domain));
}

/// Direction of (x, y), within −90° … 270°. Seen from its pin, C is never straight below, so the cut there keeps wraps
/// above 90° continuous.
inline double direction(double x, double y, Domain&) {
  const double angle = elementary::atan2(y, x);
  return angle < -0.5 * k_pi ? angle + k_two_pi : angle;
}

}  // namespace fusee::transmission
