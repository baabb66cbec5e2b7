/// \file
/// The part of a wound string above the pulley: from the guide up to the joint. Uses only geometry of discs and points.
#pragma once

#include <cmath>

#include "fusee/base.h"
#include "fusee/mechanism.h"

namespace fusee::profile {

/// `angle` shifted by full turns to within half a turn of `near`.
inline double turned_near(double angle, double near) {
  return angle - k_two_pi * std::round((angle - near) / k_two_pi);
}
inline double direction(const Vec2& v) { return elementary::atan2(v.y(), v.x()); }

/// The string from its sheath, if any, over its pin and its drum, if any, to its end in the link. `hand` is +1 for
/// tendon 2 on the right, −1 for tendon 1 on the left.
class StringAbove {
 public:
  StringAbove(const Mechanism& mechanism, double hand);

  /// Length on and above the pin, up to a constant. `lower_normal`: world direction of the lower span's outward normal.
  double length(double theta, double lower_normal) const;
  /// The last guide before the pulley (pin or sheath exit), in the pulley's frame relative to its axis.
  Vec2 guide_seen_from_pulley(double alpha) const;
  /// Outward normal of the line that touches the guide and the string's half-thickness disc about a groove floor corner
  /// on their outer sides. Both positions are in one frame.
  double lower_normal(const Vec2& guide, const Vec2& corner) const;
  /// Length of the line of lower_normal(); 0 or NaN where the corner reaches into the guide.
  double lower_span(const Vec2& guide, const Vec2& corner) const;
  /// Radius of the guide to the string's centre line; 0 for a sheath exit.
  double lower_rho() const { return sheathed_ ? 0.0 : rho_; }
  bool is_sheathed() const { return sheathed_; }

 private:
  /// A straight span between two points of tangency.
  struct Span {
    double normal = 0;  ///< outward, rad
    double length = 0;
  };
  Span from_pin_to(const Vec2& centre, double radius) const;
  double wound_on_drum(double theta) const;

  double hand_;
  double half_;  ///< half the string's thickness, mm
  double rho_;   ///< radius of the pin to the string's centre line, mm
  bool sheathed_;
  Vec2 end_;          ///< in the link at home
  double drum_;       ///< radius to the string's centre line; 0: none
  Vec2 drum_centre_;  ///< in the link at home
  Vec2 pin_;          ///< in the world
  Vec2 from_axis_;    ///< the guide relative to the pulley's axis, at home
};

}  // namespace fusee::profile
