/// \file
/// Internal: the words in which equations.h is written, for plain numbers. interval.h has the same words for intervals
/// with derivatives.
#pragma once

#include <algorithm>
#include <cmath>

#include "fusee/base/units.h"

namespace fusee {

/// What a formula's domain does to its argument: a part of an interval may have to be cut off, or all of it.
struct Domain {
  bool possible = true;  ///< false: the formula has no value, for a number or anywhere in the box
  bool whole = true;     ///< false: a part was cut off; derivatives are worth nothing
};

using std::acos, std::atan, std::cos, std::exp, std::hypot, std::sin, std::sqrt;
inline double squared(double x) { return x * x; }
inline double larger(double a, double b) { return std::max(a, b); }
inline double positive_part(double x, Domain& domain) {
  if (!(x > 0)) domain.possible = false;
  return x;
}
/// What of x lies within ±1.
inline double unit_part(double x, Domain& domain) {
  if (!(x >= -1 && x <= 1)) domain.possible = false;
  return x;
}
inline void demand_not_negative(double x, Domain& domain) {
  if (!(x >= 0)) domain.possible = false;
}

/// The other short side of a right triangle.
inline double cathetus(double hypotenuse, double other, Domain& domain) {
  return std::sqrt(positive_part((hypotenuse - other) * (hypotenuse + other), domain));
}

/// Of (x, y), within −90° … 270°. C seen from its pin lies anywhere but straight below it: there the angle is cut, so
/// that wraps of more than 90° stay continuous.
inline double direction(double x, double y, Domain&) {
  const double angle = std::atan2(y, x);
  return angle < -0.5 * k_pi ? angle + k_two_pi : angle;
}

}  // namespace fusee
