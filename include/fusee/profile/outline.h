/// \file
/// A closed convex pitch curve, sampled: what the tendon's centre line lies on, in the pulley's frame at home, axis at
/// the origin.
#pragma once

#include <cstddef>
#include <vector>

#include "fusee/base/plane.h"
#include "fusee/transmission/tendon_path.h"

namespace fusee {

struct OutlinePoint {
  double psi = 0;               ///< direction of the outward normal, rad, increasing along the curve
  Vec2 position;                ///< mm
  Vec2 normal;                  ///< unit(psi)
  double curvature_radius = 0;  ///< of the pitch curve, mm
};

/// Counter-clockwise, strictly convex, the axis inside. P1 and P2 of a pulley are sampled at the *same* psi values, so
/// that point i of one and point i of the other (and of any parallel curve) have the same normal.
///
/// The active arc is what tendons leave from within the range: from points[active_first] counter-clockwise (wrapping
/// past the end of the vector) to points[active_last]: its exact ends, but for ends of P1 and P2 less than 0.1° apart,
/// which share a point. The rest is the closing arc: no tendon in range touches it but for the short lap at the wound
/// end that leads to the anchor.
struct Outline {
  Side side = Side::left;
  std::vector<OutlinePoint> points;
  std::size_t active_first = 0;
  std::size_t active_last = 0;

  /// The end of the active arc at which the tendon stays wound over the whole stroke and goes to its anchor:
  /// active_last for P1 (left), active_first for P2 (right).
  std::size_t anchor_end() const { return side == Side::left ? active_last : active_first; }
  bool is_active(std::size_t i) const;
};

/// The parallel curve at `distance` (outward positive): point i moves along its normal. The groove floor is parallel(o,
/// −d/2).
Polygon parallel(const Outline& outline, double distance);

/// How far a convex curve through two points lies off their chord at most, mm: as an arc does (chord · turn / 8), but
/// no further than the tangents at both ends meet. Where all the turn is at one end, as on the bridge over a hollow,
/// that is next to nothing. `from` and `to` are points on the curve, their normals at `psi_from` and `psi_to`, rad.
double sagitta(const Vec2& from, double psi_from, const Vec2& to, double psi_to);

}  // namespace fusee
