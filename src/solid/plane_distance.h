/// \file
/// Internal: distances between bars and walls in the plane. mm.
#pragma once

#include "fusee/base.h"

namespace fusee::solid {

/// A bar with round ends (a disc when a == b), as an obstacle.
struct Bar {
  Vec2 a;
  Vec2 b;
  double radius = 0;
};

/// Distance between the outsides, negative when they overlap.
double gap(const Bar& p, const Bar& q);
/// True if the point lies inside the loop, by the even-odd rule. Points on the edge may count as either.
bool is_inside(const Polygon& loop, const Vec2& point);
/// Depth of a point inside a convex polygon, negative outside, and the polygon's outward normal at the nearest place.
struct Depth {
  double value = 0;
  Vec2 normal = Vec2::Zero();
};
Depth depth_and_normal(const Polygon& convex, const Vec2& point);
/// The depth without the normal.
double depth_inside(const Polygon& convex, const Vec2& point);

/// A convex polygon prepared for many depth queries.
class ConvexSides {
 public:
  explicit ConvexSides(const Polygon& convex);
  /// depth_inside() of the polygon.
  double depth_of(const Vec2& point) const;

 private:
  Eigen::ArrayXd from_x_, from_y_, along_x_, along_y_, length_;
};

}  // namespace fusee::solid
