#include "solid/plane_distance.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace fusee::solid {
namespace {

bool segments_cross(const Bar& p, const Bar& q) {
  const auto side = [](const Bar& bar, const Vec2& point) { return cross(bar.b - bar.a, point - bar.a); };
  return side(p, q.a) * side(p, q.b) < 0 && side(q, p.a) * side(q, p.b) < 0;
}

}  // namespace

double gap(const Bar& p, const Bar& q) {
  double distance = 0;
  if (!segments_cross(p, q)) {
    distance = std::min({distance_to_segment(p.a, q.a, q.b), distance_to_segment(p.b, q.a, q.b),
                         distance_to_segment(q.a, p.a, p.b), distance_to_segment(q.b, p.a, p.b)});
  }
  return distance - p.radius - q.radius;
}

bool is_inside(const Polygon& loop, const Vec2& point) {
  bool inside = false;
  for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++) {
    const Vec2 &a = loop[i], &b = loop[j];
    if ((a.y() > point.y()) != (b.y() > point.y()) &&
        point.x() < a.x() + (b.x() - a.x()) * (point.y() - a.y()) / (b.y() - a.y()))
      inside = !inside;
  }
  return inside;
}

Depth depth_and_normal(const Polygon& convex, const Vec2& point) {
  double least = std::numeric_limits<double>::infinity();
  Vec2 nearest = Vec2::UnitX();
  for (std::size_t i = 0; i < convex.size(); ++i) {
    const Vec2& a = convex[i];
    const Vec2 along = convex[i + 1 == convex.size() ? 0 : i + 1] - a;
    const double depth = cross(along, point - a) / along.norm();
    if (!(depth < least)) continue;
    least = depth;
    nearest = along;
  }
  return {least, -turned_left(nearest).normalized()};
}

double depth_inside(const Polygon& convex, const Vec2& point) { return depth_and_normal(convex, point).value; }

ConvexSides::ConvexSides(const Polygon& convex) {
  const auto sides = static_cast<Eigen::Index>(convex.size());
  for (Eigen::ArrayXd* array : {&from_x_, &from_y_, &along_x_, &along_y_, &length_}) array->resize(sides);
  for (Eigen::Index i = 0; i < sides; ++i) {
    const Vec2& a = convex[static_cast<std::size_t>(i)];
    const Vec2 along = convex[static_cast<std::size_t>(i + 1 == sides ? 0 : i + 1)] - a;
    from_x_[i] = a.x();
    from_y_[i] = a.y();
    along_x_[i] = along.x();
    along_y_[i] = along.y();
    length_[i] = along.norm();
  }
}

double ConvexSides::depth_of(const Vec2& point) const {
  return ((along_x_ * (point.y() - from_y_) - along_y_ * (point.x() - from_x_)) / length_).minCoeff();
}

}  // namespace fusee::solid
