#include <algorithm>
#include <limits>

#include "fusee/base.h"

namespace fusee {

Vec2 turned(const Vec2& v, double angle) {
  const double c = elementary::cos(angle), s = elementary::sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

double signed_area(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) twice += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return 0.5 * twice;
}

double perimeter(const Polygon& polygon) {
  double length = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) length += (polygon[(i + 1) % polygon.size()] - polygon[i]).norm();
  return length;
}

double circumradius(const Polygon& polygon) {
  double radius = 0;
  for (const Vec2& point : polygon) radius = std::max(radius, point.norm());
  return radius;
}

double distance_to_segment(const Vec2& point, const Vec2& a, const Vec2& b) {
  const Vec2 along = b - a;
  const double length2 = along.squaredNorm();
  const double share = length2 > 0 ? std::clamp((point - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (point - a - share * along).norm();
}

double distance_to_edges(const Polygon& polygon, const Vec2& point) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    least = std::min(least, distance_to_segment(point, polygon[j], polygon[i]));
  }
  return least;
}

Polygon convex_hull(Polygon points) {
  // Andrew's monotone chain.
  const auto by_xy = [](const Vec2& a, const Vec2& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); };
  std::sort(points.begin(), points.end(), by_xy);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  Polygon hull;
  const auto extend = [&hull](const Vec2& point, std::size_t least_size) {
    while (hull.size() > least_size && cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0)
      hull.pop_back();
    hull.push_back(point);
  };
  for (const Vec2& point : points) extend(point, 1);
  const std::size_t lower = hull.size();
  for (auto it = points.rbegin() + 1; it != points.rend(); ++it) extend(*it, lower);
  hull.pop_back();
  return hull;
}

}  // namespace fusee
