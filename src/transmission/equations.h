/// \file
/// Internal: the paper's equations [1]-[11] over pins of any radius, each written once. They serve numbers
/// (tendon_path.cpp, transmission.cpp, tension.cpp) and intervals with derivatives (optimize module), so that the
/// proven formulas are the evaluated ones.
///
/// S is double or Jet (interval.h). The order of operations is part of the interface, as output bytes are pinned. A
/// number outside a formula's domain gives NaN and is recorded in `domain`.
#pragma once

#include "transmission/scalar.h"

namespace fusee::transmission {

template <typename S>
struct RotationAngle {
  S angle, sine, cosine;

  /// This angle in the image of the other tendon.
  RotationAngle mirrored() const { return {-angle, -sine, cosine}; }
};

template <typename S>
RotationAngle<S> rotation_angle(const S& angle) {
  return {angle, sin(angle), cos(angle)};
}

/// Vector from the pin to C in the right-hand image, mm.
template <typename S>
struct PinOffset {
  S x, y;
};

template <typename S>
PinOffset<S> offset_from_pin(const S& R, const S& e, const S& oe, const RotationAngle<S>& theta) {
  return {R * theta.sine - e, R * theta.cosine + oe};
}

/// Vector from the pin to C in the frame of the link, where OC points along y. There x does not depend on R, so that
/// intervals over the lengths keep the sign of the moment arm.
template <typename S>
PinOffset<S> offset_from_pin_in_link(const S& R, const S& e, const S& oe, const RotationAngle<S>& theta) {
  return {-(e * theta.cosine + oe * theta.sine), R + oe * theta.cosine - e * theta.sine};
}

/// The tendon's line above its pin.
template <typename S>
struct UpperLine {
  S normal;  ///< direction of the outward normal, rad; in the link's frame γ, the angle between OC and the tendon
  S free;    ///< C to the tangent point [2],[3], mm
};

/// The line {x : x·n = m} through C touches the circle of radius ρ about the pin P on its outer side: (C − P)·n = ρ.
/// With β the direction and D the length of C − P, n has the direction β − acos(ρ/D).
template <typename S>
UpperLine<S> upper_line(const PinOffset<S>& to_C, const S& rho, Domain& domain) {
  const S distance = sqrt(squared(to_C.x) + squared(to_C.y));
  return {direction(to_C.x, to_C.y, domain) - acos(unit_part(rho / distance, domain)), cathetus(distance, rho, domain)};
}

/// The tendon's line below its pin, in its right-hand image.
template <typename S>
struct LowerLine {
  S normal;  ///< direction of the outward normal, rad
  S reach;   ///< from the foot of the pulley axis' perpendicular to the pin's tangent point, mm
};

/// The line at distance `p` from the pulley axis. The pin is at distance `c` from that axis, in direction `phi`.
template <typename S>
LowerLine<S> lower_line(const S& p, const S& rho, const S& c, const S& phi, Domain& domain) {
  const S beyond_pin = p - rho;
  return {phi - acos(unit_part(beyond_pin / c, domain)), cathetus(c, beyond_pin, domain)};
}

/// [4] dθ/dα that winds tendon 1 on a round pulley.
template <typename S>
S slope_over_round_pulley(const S& r1, const S& arm1) {
  return r1 / arm1;
}
/// Radius at which a pulley must take a tendon for a given dθ/dα: virtual work.
template <typename S>
S pulley_radius(const S& arm, const S& slope) {
  return arm * slope;
}

/// [6] Tension that holds a torque about O.
template <typename S>
S tension_above_pin(const S& torque, const S& arm) {
  return torque / arm;
}

/// [7] Tension below the pin (capstan equation). [8] The wrap φ is the angle between both lines.
template <typename S>
S tension_below_pin(const S& above, const S& mu, const S& wrap) {
  return above * exp(mu * wrap);
}

/// [9] Each span stretches under its own tension, the length on the pin under the mean of both.
template <typename S>
S elongation_of_tendon(const S& above, const S& below, const S& free, const S& on_pin, const S& reach,
                       const S& stiffness) {
  return (above * free + 0.5 * (above + below) * on_pin + below * reach) / stiffness;
}

/// [10],[11] Joint rotation due to the elongation, to first order, over pins of any size.
template <typename S>
S angle_of_elongation(const S& elongation, const S& arm) {
  return elongation / arm;
}

}  // namespace fusee::transmission
