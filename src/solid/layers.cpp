#include "solid/layers.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "fusee/base/units.h"
#include "solid/nearest_segment.h"
#include "solid/plane_distance.h"

namespace fusee {
namespace {

constexpr double k_layer = 0.2;
// PrusaSlicer 2.5 takes "below 45°" as "below 46°" (measured on cones and wedges); a little more, so that no rounding
// decides.
constexpr double k_threshold = radians(1.3);
// Outlines are looked at in steps of this.
constexpr double k_stride = 0.02;

bool is_inside_of(const std::vector<Polygon>& loops, const Vec2& point) {
  return std::count_if(loops.begin(), loops.end(), [&point](const Polygon& loop) { return is_inside(loop, point); }) %
             2 ==
         1;
}

// A layer, widened by `reach`: what the next one may lie on.
class WidenedLayer {
 public:
  WidenedLayer(std::vector<Polygon> loops, double reach, Corners corners)
      : loops_(std::move(loops)), nearest_(loops_), reach_(reach), corners_(corners) {}

  bool holds(const Vec2& point) const {
    return nearest_.distance(point) <= reach_ || is_inside_of(loops_, point) ||
           (corners_ == Corners::squared && at_squared_corner(point));
  }
  double distance(const Vec2& point) const { return nearest_.distance(point); }

 private:
  // The solid lies on the left of its outlines.
  bool at_squared_corner(const Vec2& point) const {
    for (const Polygon& loop : loops_) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec2 away = point - loop[i];
        if (away.squaredNorm() > 2.0 * reach_ * reach_) continue;
        const Vec2 before = (loop[i] - loop[(i + loop.size() - 1) % loop.size()]).normalized();
        const Vec2 after = (loop[(i + 1) % loop.size()] - loop[i]).normalized();
        if (cross(before, after) <= 0) continue;
        const Vec2 bisector = (before - after).normalized();
        const double furthest =
            std::max({-away.dot(turned_left(before)), -away.dot(turned_left(after)), away.dot(bisector)});
        if (furthest <= reach_ && away.dot(before) >= 0 && away.dot(after) <= 0) return true;
      }
    }
    return false;
  }

  std::vector<Polygon> loops_;
  NearestSegment nearest_;
  double reach_;
  Corners corners_;
};

std::optional<Vec2> furthest_out(const Polygon& loop, const WidenedLayer& below) {
  std::optional<Vec2> furthest;
  double most = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec2 &from = loop[i], &to = loop[(i + 1) % loop.size()];
    const int steps = static_cast<int>(std::ceil((to - from).norm() / k_stride));
    for (int k = 0; k < steps; ++k) {
      const Vec2 point = from + (to - from) * k / steps;
      if (below.holds(point) || below.distance(point) <= most) continue;
      most = below.distance(point);
      furthest = point;
    }
  }
  return furthest;
}

}  // namespace

std::vector<Vec3> ledges_in_layers(const TriangleMesh& lying, double overhang, Corners corners) {
  const double reach = k_layer / std::tan(overhang + k_threshold);
  const Bounds box = bounds(lying);
  std::vector<Vec3> ledges;
  // What stands out over the first layer comes down onto the bed: PrusaSlicer puts no support that low.
  std::vector<Polygon> below = section(lying, box.low.z() + 1.5 * k_layer);
  for (double z = box.low.z() + 2.5 * k_layer; z < box.high.z(); z += k_layer) {
    std::vector<Polygon> here = section(lying, z);
    const WidenedLayer widened(std::move(below), reach, corners);
    for (const Polygon& loop : here) {
      if (const auto out = furthest_out(loop, widened)) ledges.emplace_back(out->x(), out->y(), z);
    }
    below = std::move(here);
  }
  return ledges;
}

}  // namespace fusee
