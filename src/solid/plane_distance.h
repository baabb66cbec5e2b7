/// \file
/// How near bars and walls come to each other in the plane. mm.
#pragma once

#include "fusee/base/plane.h"

namespace fusee {

/// A bar with round ends (a disc when a == b): what a hole must keep clear of.
struct Bar {
  Vec2 a;
  Vec2 b;
  double radius = 0;
};

/// Between the outsides; negative when they overlap.
double gap(const Bar& p, const Bar& q);
/// By the even-odd rule; what lies on the edge may be either.
bool is_inside(const Polygon& loop, const Vec2& point);
/// How deep a point lies inside a convex polygon, negative outside, and that polygon's outward normal where it is
/// nearest.
struct Depth {
  double value = 0;
  Vec2 normal = Vec2::Zero();
};
Depth depth_and_normal(const Polygon& convex, const Vec2& point);
/// The depth alone.
double depth_inside(const Polygon& convex, const Vec2& point);

/// A convex polygon made ready to be asked for many depths.
class ConvexSides {
 public:
  explicit ConvexSides(const Polygon& convex);
  /// depth_inside() of the polygon.
  double depth_of(const Vec2& point) const;

 private:
  Eigen::ArrayXd from_x_, from_y_, along_x_, along_y_, length_;
};

}  // namespace fusee
