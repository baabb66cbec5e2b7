/// \file
/// Internal: convex outlines laid on one another. What counts of an outline is its support function, as for the tendon.
#pragma once

#include <vector>

#include "fusee/base/plane.h"

namespace fusee {

/// Turns about the origin, then moves.
struct PlaneMotion {
  double turn = 0;  ///< rad, counter-clockwise
  Vec2 shift = Vec2::Zero();

  Vec2 operator()(const Vec2& point) const { return turned(point, turn) + shift; }
};

/// An outline as it was found and what it should be; of both only the convex hull is looked at.
struct OutlinePair {
  Polygon found;
  Polygon expected;
};

/// rms of the distance between their tangents, mm, leaving out the quarter of directions where it is largest: channels,
/// marks and clamps cut into an outline.
double deviation(const std::vector<OutlinePair>& pairs, const PlaneMotion& motion);

struct OutlineFit {
  PlaneMotion motion;
  bool tells_turn = true;  ///< false: round, and the turn is left at 0
};
/// The one motion that lays all of `found` on their `expected`.
OutlineFit lay_on(const std::vector<OutlinePair>& pairs);

}  // namespace fusee
