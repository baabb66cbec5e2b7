#include "export/drawings/plane_shapes.h"

#include <algorithm>
#include <cmath>

#include "fusee/base/units.h"

namespace fusee {

Polygon rectangle(const Vec2& low, const Vec2& high) { return {low, {high.x(), low.y()}, high, {low.x(), high.y()}}; }

Polygon circle_polygon(const Vec2& centre, double radius) {
  constexpr double k_sagitta = 0.002;
  const double step = 2 * std::acos(std::max(0.0, 1 - k_sagitta / std::max(radius, k_sagitta)));
  const int corners = std::max(24, static_cast<int>(std::ceil(k_two_pi / step)));
  Polygon polygon;
  for (int i = 0; i < corners; ++i) polygon.push_back(centre + radius * unit(k_two_pi * i / corners));
  return polygon;
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

}  // namespace fusee
