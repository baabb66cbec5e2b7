/// \file
/// A wound string from its pulley's side of the guide pin up to the joint: geometry of discs and a point alone.
#pragma once

#include <cmath>

#include "fusee/base/plane.h"
#include "fusee/base/units.h"
#include "fusee/mechanism/mechanism.h"

namespace fusee {

/// `angle` turned by full turns to within half a turn of `near`.
inline double turned_near(double angle, double near) {
  return angle - k_two_pi * std::round((angle - near) / k_two_pi);
}
inline double direction(const Vec2& v) { return std::atan2(v.y(), v.x()); }

/// Out of its sheath where there is one, over its pin, and its drum where there is one, to its end in the link. `hand`
/// is +1 for tendon 2 on the right, −1 for tendon 1 on the left.
class StringAbove {
 public:
  StringAbove(const Mechanism& mechanism, double hand);

  /// On the pin and above it, but for a constant; `lower_normal`: world direction of the lower span's outward normal.
  double length(double theta, double lower_normal) const;
  /// What the string comes to the pulley from, its pin or the mouth of its sheath, in the pulley's frame from its axis.
  Vec2 guide_seen_from_pulley(double alpha) const;
  /// Between it and the disc of the string's own thickness about a corner of the groove floor: outward normal of the
  /// line that touches both on their outer side. Both places in one frame.
  double lower_normal(const Vec2& guide, const Vec2& corner) const;
  /// Length of that line; 0 or NaN where the corner reaches into the guide.
  double lower_span(const Vec2& guide, const Vec2& corner) const;
  /// Its radius to the string's centre line; 0 of a mouth.
  double lower_rho() const { return sheathed_ ? 0.0 : rho_; }
  bool is_sheathed() const { return sheathed_; }

 private:
  struct Piece {
    double normal = 0;  ///< outward, rad
    double length = 0;
  };
  Piece from_pin_to(const Vec2& centre, double radius) const;
  double wound_on_drum(double theta) const;

  double hand_;
  double half_;
  double rho_;
  bool sheathed_;
  Vec2 end_;          ///< in the link at home
  double drum_;       ///< to the string's centre line; 0: none
  Vec2 drum_centre_;  ///< in the link at home
  Vec2 pin_;          ///< in the world
  Vec2 from_axis_;    ///< what it comes to the pulley from, from the pulley's axis at home
};

}  // namespace fusee
