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
/// How deep a point lies inside a convex polygon; negative outside.
double depth_inside(const Polygon& convex, const Vec2& point);

}  // namespace fusee
