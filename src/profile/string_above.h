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

/// Over its pin, and its drum where there is one, to its end in the link. `hand` is +1 for tendon 2 on the right, −1 for
/// tendon 1 on the left.
class StringAbove {
 public:
  StringAbove(const Mechanism& mechanism, double hand);

  /// On the pin and above it, but for a constant; `lower_normal`: world direction of the lower span's outward normal.
  double length(double theta, double lower_normal) const;
  /// The pin in the pulley's frame, from its axis.
  Vec2 pin_seen_from_pulley(double alpha) const;
  /// Radius of the pin to the string's centre line.
  double rho() const { return rho_; }

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
  Vec2 end_;            ///< in the link at home
  double drum_;         ///< to the string's centre line; 0: none
  Vec2 pin_;            ///< in the world
  Vec2 pin_from_axis_;  ///< from the pulley's axis, at home
};

}  // namespace fusee
