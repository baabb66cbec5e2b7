/// \file
/// A sampled, closed, convex pitch curve: the tendon's centre line on the pulley, in the pulley's frame at home with
/// the axis at the origin.
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
  double curvature_radius = 0;  ///< radius of curvature of the pitch curve, mm
};

/// Counter-clockwise, strictly convex, with the axis inside. P1 and P2 of a pulley are sampled at the *same* psi
/// values: points with equal index have equal normals, also on parallel curves.
///
/// Tendons leave the active arc within the range. It runs counter-clockwise from points[active_first] to
/// points[active_last], possibly past the end of the vector. Both are exact ends, except that ends of P1 and P2 less
/// than 0.1° apart share a point. The remaining closing arc carries no tendon in range, except the short lap at the
/// wound end that leads to the anchor.
struct Outline {
  Side side = Side::left;
  std::vector<OutlinePoint> points;
  std::size_t active_first = 0;
  std::size_t active_last = 0;

  /// The end of the active arc where the tendon stays wound over the whole stroke and continues to its anchor:
  /// active_last for P1 (left), active_first for P2 (right).
  std::size_t anchor_end() const { return side == Side::left ? active_last : active_first; }
  bool is_active(std::size_t i) const;
};

/// The parallel curve at `distance` (outward positive): point i moves along its normal. The groove floor is parallel(o,
/// −d/2).
Polygon parallel(const Outline& outline, double distance);

/// Bound on the distance of a convex curve from the chord of two of its points, mm. It is that of an arc (chord · turn
/// / 8), but at most the height of the intersection of both end tangents, which is small when the whole turn is at one
/// end, as beside a bridge over a hollow. `from` and `to` are points on the curve with normals `psi_from` and `psi_to`,
/// rad.
double sagitta(const Vec2& from, double psi_from, const Vec2& to, double psi_to);

}  // namespace fusee
