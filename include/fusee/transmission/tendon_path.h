/// \file
/// The upper half of a tendon: from its attachment, over the joint's drum where it lies on one, and over its guide pin.
/// Moment arm, lengths, and their derivatives, in closed form.
///
/// One derivation serves both tendons: tendon 1 is the mirror image of tendon 2 (x → −x, θ → −θ, α → −α).
#pragma once

#include <cmath>
#include <optional>
#include <string_view>

#include "fusee/base/plane.h"
#include "fusee/mechanism/mechanism.h"

namespace fusee {

/// left: tendon 1, pin B, pulley P1. right: tendon 2, pin D, pulley P2.
enum class Side { left, right };

constexpr std::string_view pulley_name(Side side) { return side == Side::left ? "P1" : "P2"; }

/// +1 for the right, −1 for the left: the factor between the mechanism's θ, α, x and those of the right-hand image.
constexpr double mirror_sign(Side side) { return side == Side::right ? 1.0 : -1.0; }

/// What a tendon comes from where it goes onto its pulley, in its right-hand image: its pin, or the mouth of its
/// sheath. As seen from the pulley's axis. mm.
struct LowerGuide {
  double across = 0;
  double above = 0;
  double rho = 0;  ///< to the tendon's centre line; 0: a point, as a mouth is

  /// c and φ.
  double c() const { return std::hypot(across, above); }
  double phi() const { return std::atan2(above, across); }
};

/// Pin and pulley axis of one tendon in its right-hand image. mm.
struct PinPlace {
  double e;          ///< EB or ED: the pin stands at (e, −OE)
  double oe;         ///< OE
  double ef;         ///< EF: the pulley's axis stands at (0, −OE − EF)
  double rho;        ///< ρp: pin radius to the tendon's centre line (0: a point)
  double R;          ///< from O to the tendon's end: OC
  double twist = 0;  ///< that end's angle at home, clockwise from OC, rad
  double drum = 0;   ///< ρ0: drum radius to the tendon's centre line, R or less; 0: there is none
  bool at_C = true;  ///< the end is C, and moves with it
  /// Of the sheath between pin and pulley: there the tendon leaves the pin straight down.
  std::optional<LowerGuide> mouth = std::nullopt;
  double in_sheath = 0;   ///< length of tendon between pin and mouth
  double drum_off = 0;    ///< from O to the drum's centre, which turns with the link
  double drum_twist = 0;  ///< that centre's angle at home, clockwise from OC, rad

  Vec2 pin() const { return {e, -oe}; }
  Vec2 pulley_axis() const { return {0.0, -oe - ef}; }
  LowerGuide lower() const { return mouth ? *mouth : LowerGuide{e, ef, rho}; }
  /// Outward normal where the tendon leaves the pin, rad: that of its line to the pulley, or of its way into the
  /// sheath.
  double off_pin(double lower_normal) const { return mouth ? 0.0 : lower_normal; }
};

/// An end between the drum's surface and its pitch circle is taken onto that circle: there the tendon comes out of the
/// drum.
PinPlace pin_place(const Mechanism& mechanism, Side side, double rho);

/// Of the drum at joint angle `theta` of the image.
Vec2 drum_centre(const PinPlace& place, double theta);

/// Of the right-hand image: where it is larger the tendon is free of the drum, elsewhere on it. Null without a drum,
/// and where the pin stands in it.
std::optional<double> lift_off(const PinPlace& place);

/// The span from the tendon's end to its tangent point on the pin, in the right-hand image, at joint angle `theta` of
/// that image.
struct UpperSpan {
  double m = 0;       ///< moment arm about O: −dL/dθ, mm [4]
  double dm = 0;      ///< dm/dθ
  double d2m = 0;     ///< d²m/dθ²
  double free = 0;    ///< C to the tangent point, over the drum, mm [2],[3]
  double normal = 0;  ///< direction of the line's outward normal at the pin, rad
  /// free + ρp · normal: the tendon's length above any fixed point of the pin's rim, but for a constant. mm
  double length = 0;
  double dnormal = 0;      ///< d normal/dθ
  double d2normal = 0;     ///< d² normal/dθ²
  double end_normal = 0;   ///< of the line at the tendon's end, rad: `normal` but for what lies on the drum
  double on_drum = 0;      ///< angle over which the tendon lies on the drum, rad
  double behind_drum = 0;  ///< of `free`: straight, from there to the tendon's end
};

/// NaN throughout where the tendon's end lies within the pin's circle, or the pin in the drum.
UpperSpan upper_span(const PinPlace& place, double theta);

}  // namespace fusee
