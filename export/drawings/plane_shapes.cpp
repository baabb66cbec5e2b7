#include "export/drawings/plane_shapes.h"

#include <algorithm>
#include <cmath>

#include "fusee/base.h"

namespace fusee::formats {

Polygon shifted(Polygon points, const Vec2& shift) {
  for (Vec2& point : points) point += shift;
  return points;
}

Polygon rectangle(const Vec2& low, const Vec2& high) { return {low, {high.x(), low.y()}, high, {low.x(), high.y()}}; }

Polygon circle_polygon(const Vec2& centre, double radius) {
  constexpr double k_corner_sagitta = 0.002;
  const double step = 2 * elementary::acos(std::max(0.0, 1 - k_corner_sagitta / std::max(radius, k_corner_sagitta)));
  const int corners = std::max(24, static_cast<int>(std::ceil(k_two_pi / step)));
  Polygon polygon;
  for (int i = 0; i < corners; ++i) polygon.push_back(centre + radius * unit(k_two_pi * i / corners));
  return polygon;
}

double turn_between(const Vec2& from, const Vec2& to) {
  const double turn = elementary::atan2(cross(from, to), from.dot(to));
  return turn > 0 ? turn : turn + k_two_pi;
}

Contour circle_contour(const solid::RoundHole& hole) {
  return {circle_polygon(hole.centre, 0.5 * hole.diameter), hole, 0};
}

std::vector<BulgeVertex> vertices_of(const Contour& contour) {
  std::vector<BulgeVertex> vertices;
  std::size_t next = 0;
  if (contour.arc_points > 0) {
    const Vec2& from = contour.points.front();
    const Vec2& to = contour.points[contour.arc_points - 1];
    vertices = {{from, elementary::tan(0.25 * turn_between(from, to))}, {to, 0}};
    next = contour.arc_points;
  }
  for (; next < contour.points.size(); ++next) vertices.push_back({contour.points[next], 0});
  return vertices;
}

Box2d bounding_box(const Polygon& points) {
  if (points.empty()) return {};
  Box2d box{points.front(), points.front()};
  for (const Vec2& p : points) {
    box.low = box.low.cwiseMin(p);
    box.high = box.high.cwiseMax(p);
  }
  return box;
}

}  // namespace fusee::formats
