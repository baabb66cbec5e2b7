/// \file
/// Rectangles, circles and boxes, as polygons to draw. mm.
#pragma once

#include "fusee/base/plane.h"

namespace fusee {

/// The axis-parallel square or rectangle from `low` to `high`, counter-clockwise.
Polygon rectangle(const Vec2& low, const Vec2& high);
/// A circle as a regular polygon, counter-clockwise, its corners *on* the circle; sagitta at most 0.002 mm, 24 corners
/// at least.
Polygon circle_polygon(const Vec2& centre, double radius);

struct Box2d {
  Vec2 low = Vec2::Zero();
  Vec2 high = Vec2::Zero();
  Vec2 size() const { return high - low; }
};
/// Smallest box around all points; both corners at the origin when there are none.
Box2d bounding_box(const Polygon& points);

}  // namespace fusee
