/// \file
/// The upper half of a tendon: from its attachment over the joint's drum, if any, and over its guide pin. Moment arm,
/// lengths and their derivatives in closed form.
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

/// +1 for the right, −1 for the left: factor between the mechanism's θ, α, x and those of the right-hand image.
constexpr double mirror_sign(Side side) { return side == Side::right ? 1.0 : -1.0; }

/// Last guide before the pulley, in the right-hand image: the pin, or the exit of the sheath. Coordinates relative to
/// the pulley axis. mm.
struct LowerGuide {
  double across = 0;
  double above = 0;
  double rho = 0;  ///< radius to the tendon's centre line; 0 for a point such as a sheath exit

  /// Polar coordinates c and φ of the guide.
  double c() const { return std::hypot(across, above); }
  double phi() const { return std::atan2(above, across); }
};

/// Geometry of one tendon in its right-hand image. mm.
struct PinPlace {
  double e;          ///< EB or ED: the pin is at (e, −OE)
  double oe;         ///< OE
  double ef;         ///< EF: the pulley axis is at (0, −OE − EF)
  double rho;        ///< ρp: pin radius to the tendon's centre line (0: a point)
  double R;          ///< distance from O to the tendon's end: OC
  double twist = 0;  ///< angle of that end at home, clockwise from OC, rad
  double drum = 0;   ///< ρ0: drum radius to the tendon's centre line, at most R; 0 without drum
  bool at_C = true;  ///< the tendon ends at C
  /// Exit of the sheath between pin and pulley. The tendon then leaves the pin straight down.
  std::optional<LowerGuide> sheath_exit = std::nullopt;
  double in_sheath = 0;    ///< length of tendon between pin and sheath exit
  double drum_offset = 0;  ///< distance from O to the drum's centre, which is fixed to the link
  double drum_twist = 0;   ///< angle of that centre at home, clockwise from OC, rad

  Vec2 pin() const { return {e, -oe}; }
  Vec2 pulley_axis() const { return {0.0, -oe - ef}; }
  LowerGuide lower() const { return sheath_exit ? *sheath_exit : LowerGuide{e, ef, rho}; }
  /// Outward normal where the tendon leaves the pin, rad: that of its line to the pulley, or into the sheath.
  double off_pin(double lower_normal) const { return sheath_exit ? 0.0 : lower_normal; }
};

/// An end between the drum's surface and its pitch circle is moved onto the pitch circle, where the tendon leaves the
/// drum.
PinPlace pin_place(const Mechanism& mechanism, Side side, double rho);

/// Centre of the drum at joint angle `theta` of the image.
Vec2 drum_centre(const PinPlace& place, double theta);

/// Joint angle of the image above which the tendon is clear of the drum. Null without a drum, and where the pin lies
/// inside the drum.
std::optional<double> lift_off(const PinPlace& place);

/// The span from the tendon's end to its tangent point on the pin, at joint angle `theta` of the right-hand image.
struct UpperSpan {
  double m = 0;       ///< moment arm about O: −dL/dθ, mm [4]
  double dm = 0;      ///< dm/dθ
  double d2m = 0;     ///< d²m/dθ²
  double free = 0;    ///< from the tendon's end to the tangent point, over the drum, mm [2],[3]
  double normal = 0;  ///< direction of the line's outward normal at the pin, rad
  /// Free + ρp · normal: length of the tendon above a fixed point of the pin's rim, up to a constant. mm
  double length = 0;
  double dnormal = 0;      ///< d normal/dθ
  double d2normal = 0;     ///< d² normal/dθ²
  double end_normal = 0;   ///< normal of the line at the tendon's end, rad: differs from `normal` by on_drum
  double on_drum = 0;      ///< wrap angle on the drum, rad
  double behind_drum = 0;  ///< straight part of `free` between drum and tendon end
};

/// All values are NaN where the tendon's end lies inside the pin's circle, or the pin inside the drum.
UpperSpan upper_span(const PinPlace& place, double theta);

}  // namespace fusee
