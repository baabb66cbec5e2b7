/// \file
/// Internal: registration of convex outlines by their support functions.
#pragma once

#include <vector>

#include "fusee/base.h"

namespace fusee::solid {

/// A turn about the origin followed by a shift.
struct PlaneMotion {
  double turn = 0;  ///< rad, counter-clockwise
  Vec2 shift = Vec2::Zero();

  Vec2 operator()(const Vec2& point) const { return turned(point, turn) + shift; }
};

/// A found and an expected outline. Only their convex hulls are used.
struct OutlinePair {
  Polygon found;
  Polygon expected;
};

/// rms distance between the outlines' tangents, mm, without the worst quarter of directions. Channels, marks and clamps
/// cut into an outline disturb these.
double deviation(const std::vector<OutlinePair>& pairs, const PlaneMotion& motion);

struct OutlineFit {
  PlaneMotion motion;
  bool tells_turn = true;  ///< false for round outlines, whose turn is left at 0
};
/// The motion that best maps all `found` outlines onto their `expected` ones.
OutlineFit fit_outlines(const std::vector<OutlinePair>& pairs);

}  // namespace fusee::solid
