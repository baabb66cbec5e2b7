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
// Far above the rounding of distances, far below all that matters.
constexpr double k_grain = 1e-9;
// A line is looked for beside this many of the layer below, from the last one found on.
constexpr std::size_t k_followed = 3;

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

  struct Hold {
    bool holds;
    double round;         ///< all is held that is nearer to the point than this
    double distance;      ///< to the layer's outlines
    std::size_t segment;  ///< the nearest of them
  };
  Hold hold_of(const Vec2& point) const {
    const auto [distance, segment] = nearest_.nearest(point);
    if (distance <= reach_) return {true, reach_ - distance, distance, segment};
    if (is_inside_of(loops_, point)) return {true, reach_ + distance, distance, segment};
    return {corners_ == Corners::squared && at_squared_corner(point), 0.0, distance, segment};
  }

  // Nearness to a segment is convex: where both ends of a line are near to the same one, all of it is.
  bool is_beside(std::size_t segment, const Vec2& from, const Vec2& to) const {
    if (segment >= nearest_.segments().size()) return false;
    const auto& [a, b] = nearest_.segments()[segment];
    return distance_to_segment(from, a, b) < reach_ - k_grain && distance_to_segment(to, a, b) < reach_ - k_grain;
  }

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

// Walks a loop in steps of k_stride over the layer below. What is surely held is passed over: a line beside one of that
// layer's (in a wall the lines of two layers follow each other), and what is near to a point that is held all round.
class LayerWalk {
 public:
  explicit LayerWalk(const WidenedLayer& below) : below_(below) {}

  std::optional<Vec2> furthest_out(const Polygon& loop) {
    for (std::size_t i = 0; i < loop.size(); ++i) step_along(loop[i], loop[(i + 1) % loop.size()]);
    return furthest_;
  }

 private:
  void step_along(const Vec2& from, const Vec2& to) {
    const double length = (to - from).norm();
    if (length < held_ || follows(from, to)) {
      held_ = std::max(0.0, held_ - length);
      return;
    }
    const int steps = static_cast<int>(std::ceil(length / k_stride));
    double at = 0;
    for (int k = 0; k < steps; ++k) {
      const double next = length * k / steps;
      if (next - at < held_) continue;
      at = next;
      held_ = look(from + (to - from) * k / steps);
    }
    held_ = std::max(0.0, held_ - (length - at));
  }

  // How far on all is held.
  double look(const Vec2& point) {
    const WidenedLayer::Hold hold = below_.hold_of(point);
    beside_ = hold.segment;
    if (!hold.holds && hold.distance > most_) {
      most_ = hold.distance;
      furthest_ = point;
    }
    return hold.holds ? std::max(0.0, hold.round - k_grain) : 0.0;
  }

  bool follows(const Vec2& from, const Vec2& to) {
    for (std::size_t s = beside_; s < beside_ + k_followed; ++s) {
      if (!below_.is_beside(s, from, to)) continue;
      beside_ = s;
      return true;
    }
    return false;
  }

  const WidenedLayer& below_;
  std::size_t beside_ = 0;  ///< the last line of the layer below that was found near
  double held_ = 0;         ///< how far on from here all is held
  std::optional<Vec2> furthest_;
  double most_ = 0;
};

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
      if (const auto out = LayerWalk(widened).furthest_out(loop)) ledges.emplace_back(out->x(), out->y(), z);
    }
    below = std::move(here);
  }
  return ledges;
}

}  // namespace fusee
