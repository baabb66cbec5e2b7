/// \file
/// Internal: the paper's equations [1]-[11] over pins of any radius, each written once: for numbers (tendon_path.cpp,
/// transmission.cpp, tension.cpp) and for intervals with derivatives (room optimize). What is evaluated and what is
/// proven are the same.
///
/// S is double or Jet (interval.h). The order of operations is part of what is written: outputs are pinned by their
/// bytes. A number outside of a formula's domain gives NaN and says so in `domain`.
#pragma once

#include "transmission/scalar.h"

namespace fusee {

template <typename S>
struct TurnedBy {
  S angle, sine, cosine;

  /// The same seen in the other tendon's image.
  TurnedBy mirrored() const { return {-angle, -sine, cosine}; }
};

template <typename S>
TurnedBy<S> turned_by(const S& angle) {
  return {angle, sin(angle), cos(angle)};
}

/// From the pin to C in the right-hand image, mm.
template <typename S>
struct FromPin {
  S x, y;
};

template <typename S>
FromPin<S> from_pin(const S& R, const S& e, const S& oe, const TurnedBy<S>& theta) {
  return {R * theta.sine - e, R * theta.cosine + oe};
}

/// The same in the frame of the link, in which OC points along y. Intervals over the lengths keep the sign of the
/// moment arm there: R has no part in x.
template <typename S>
FromPin<S> from_pin_in_link(const S& R, const S& e, const S& oe, const TurnedBy<S>& theta) {
  return {-(e * theta.cosine + oe * theta.sine), R + oe * theta.cosine - e * theta.sine};
}

/// Of a tendon above its pin.
template <typename S>
struct UpperLine {
  S normal;  ///< direction of the outward normal, rad; in the link's frame γ, the angle between OC and the tendon
  S free;    ///< C to the tangent point [2],[3], mm
};

/// The line {x : x·n = m} through C touches the circle of radius ρ about the pin P on its outer side, (C − P)·n = ρ:
/// with β the direction of C − P and D its length, n stands at β − acos(ρ/D).
template <typename S>
UpperLine<S> upper_line(const FromPin<S>& to_C, const S& rho, Domain& domain) {
  const S distance = sqrt(squared(to_C.x) + squared(to_C.y));
  return {direction(to_C.x, to_C.y, domain) - acos(unit_part(rho / distance, domain)), cathetus(distance, rho, domain)};
}

/// Of a tendon below its pin, in its right-hand image.
template <typename S>
struct LowerLine {
  S normal;  ///< direction of the outward normal, rad
  S reach;   ///< from the foot of the pulley axis' perpendicular to the pin's tangent point, mm
};

/// The line at the distance `p` from the pulley's axis, from which the pin is seen at the distance `c` in the direction
/// `phi`.
template <typename S>
LowerLine<S> lower_line(const S& p, const S& rho, const S& c, const S& phi, Domain& domain) {
  const S beyond_pin = p - rho;
  return {phi - acos(unit_part(beyond_pin / c, domain)), cathetus(c, beyond_pin, domain)};
}

/// [4] dθ/dα that winds tendon 1 on a round pulley …
template <typename S>
S slope_over_round_pulley(const S& r1, const S& arm1) {
  return r1 / arm1;
}
/// … and the radius at which a pulley has to take a tendon for it: virtual work.
template <typename S>
S pulley_radius(const S& arm, const S& slope) {
  return arm * slope;
}

/// [6] the tension that holds a torque about O.
template <typename S>
S tension_above_pin(const S& torque, const S& arm) {
  return torque / arm;
}

/// [7] what the pin takes from it; [8] the wrap φ is the angle between both lines.
template <typename S>
S tension_below_pin(const S& above, const S& mu, const S& wrap) {
  return above * exp(mu * wrap);
}

/// [9] each span stretches under its own tension, what lies on the pin under the mean of both.
template <typename S>
S elongation_of_tendon(const S& above, const S& below, const S& free, const S& on_pin, const S& reach,
                       const S& stiffness) {
  return (above * free + 0.5 * (above + below) * on_pin + below * reach) / stiffness;
}

/// [10],[11] the elongation turns the joint: to first order, over pins of any size.
template <typename S>
S angle_of_elongation(const S& elongation, const S& arm) {
  return elongation / arm;
}

}  // namespace fusee
