#include "solid/layers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "base/thread_pool.h"
#include "fusee/base.h"
#include "solid/downward_faces.h"
#include "solid/nearest_segment.h"
#include "solid/plane_distance.h"
#include "solid/section.h"

namespace fusee::solid {
namespace {

// Height of a layer, mm.
constexpr double k_layer = 0.2;
// PrusaSlicer 2.5 treats "below 45°" as "below 46°" (measured on cones and wedges). The margin is slightly larger, so
// that rounding has no effect.
constexpr double k_threshold_margin = radians(1.3);
// Sampling step along outlines, mm.
constexpr double k_stride = 0.02;
// Much larger than the rounding of distances, much smaller than any feature.
constexpr double k_grain = 1e-9;
// Number of segments of the layer below, starting at the last match, that are searched for the one beside a line.
constexpr std::size_t k_searched_segments = 5;

bool is_inside_of(const std::vector<Polygon>& loops, const Vec2& point) {
  return std::count_if(loops.begin(), loops.end(), [&point](const Polygon& loop) { return is_inside(loop, point); }) %
             2 ==
         1;
}

// A layer widened by `reach`: the support of the next layer.
class WidenedLayer {
 public:
  WidenedLayer(std::vector<Polygon> loops, double reach, Corners corners)
      : loops_(std::move(loops)), nearest_(loops_), reach_(reach), corners_(corners) {}

  struct Support {
    bool holds;
    double round;         ///< all points closer to this one than this distance are supported
    bool inside;          ///< inside the layer, further from its outlines than the widening
    double distance;      ///< to the layer's outlines
    std::size_t segment;  ///< the nearest segment
  };
  Support support_of(const Vec2& point) const {
    const auto [distance, segment] = nearest_.nearest(point);
    if (distance <= reach_) return {true, reach_ - distance, false, distance, segment};
    if (is_inside_of(loops_, point)) return {true, reach_ + distance, true, distance, segment};
    return {corners_ == Corners::squared && at_squared_corner(point), 0.0, false, distance, segment};
  }

  bool is_near(const Vec2& point, std::size_t segment) const {
    const auto& [a, b] = nearest_.segments()[segment];
    return distance_to_segment(point, a, b) < reach_ - k_grain;
  }
  const std::vector<std::pair<Vec2, Vec2>>& segments() const { return nearest_.segments(); }
  // True if the line certainly stays within the layer, given that it begins inside.
  bool stays_within(const Vec2& from, const Vec2& to) const { return nearest_.is_clear(from, to); }

 private:
  // True if the point lies within the squared corner of a convex corner of the outline: within `reach_` of both sides'
  // lines and along the bisector. The solid lies on the left of its outlines.
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

// Walks along the lines of a loop, in steps of k_stride, over the layer below. Skips what is certainly supported:
//   - a line without a flat downward feature between the two layers
//   - a line within the layer below
//   - a line beside the outline of the layer below (in a wall the lines of two layers follow each other)
//   - the neighbourhood of a point that is supported all round
class LayerWalk {
 public:
  LayerWalk(const WidenedLayer& below, const PlacesInPlan& downward_faces)
      : below_(below), downward_faces_(downward_faces) {}

  // The unsupported point that is furthest from the layer below. Empty if the whole loop is supported.
  std::optional<Vec2> furthest_out(const Polygon& loop) {
    for (std::size_t i = 0; i < loop.size(); ++i) pass_along(loop[i], loop[(i + 1) % loop.size()]);
    return furthest_;
  }

 private:
  void pass_along(const Vec2& from, const Vec2& to) {
    const double length = (to - from).norm();
    const bool may_stand_out = downward_faces_.may_meet(from, to);
    within_ = within_ && may_stand_out && below_.stays_within(from, to);
    if (!may_stand_out || within_ || length < supported_ahead_ || follows(from, to)) {
      supported_ahead_ = std::max(0.0, supported_ahead_ - length);
    } else {
      step_along(from, to, length);
    }
  }

  void step_along(const Vec2& from, const Vec2& to, double length) {
    const int steps = static_cast<int>(std::ceil(length / k_stride));
    double tested = 0;  // position of the last point that was tested
    for (int k = 0; k < steps; ++k) {
      const double position = length * k / steps;
      if (position - tested < supported_ahead_) continue;
      const Vec2 point = from + (to - from) * k / steps;
      tested = position;
      supported_ahead_ = supported_ahead(point);
      within_ = within_ && below_.stays_within(point, to);
      if (within_) break;
    }
    supported_ahead_ = std::max(0.0, supported_ahead_ - (length - tested));
  }

  // Tests a point. Returns the distance ahead within which everything is supported.
  double supported_ahead(const Vec2& point) {
    const WidenedLayer::Support support = below_.support_of(point);
    beside_ = support.segment;
    within_ = support.inside;
    if (!support.holds && support.distance > furthest_distance_) {
      furthest_distance_ = support.distance;
      furthest_ = point;
    }
    return support.holds ? std::max(0.0, support.round - k_grain) : 0.0;
  }

  // True if the line runs close beside the outline of the layer below. The distance to a segment is convex: if both
  // ends of a piece of the line are close to it, the whole piece is. Beyond the segment's end the next segment is used.
  bool follows(const Vec2& from, const Vec2& to) {
    Vec2 here = from;
    std::size_t s = beside_;
    const auto& segments = below_.segments();
    for (const std::size_t last = s + k_searched_segments; s < std::min(last, segments.size()); ++s) {
      if (!below_.is_near(here, s)) continue;
      if (below_.is_near(to, s)) {
        beside_ = s;
        return true;
      }
      const double share = (segments[s].second - here).dot(to - here) / (to - here).squaredNorm();
      if (!(share > 0 && share < 1)) continue;
      const Vec2 next = here + share * (to - here);
      if (below_.is_near(next, s)) here = next;
    }
    return false;
  }

  const WidenedLayer& below_;
  const PlacesInPlan& downward_faces_;
  std::size_t beside_ = 0;      ///< the last line of the layer below that was found near
  double supported_ahead_ = 0;  ///< distance ahead within which everything is supported
  bool within_ = false;         ///< the current place is certainly inside the layer below
  std::optional<Vec2> furthest_;
  double furthest_distance_ = 0;
};

// Marks layers that may overhang the one below, and those below them.
std::vector<bool> relevant_layers(const std::vector<PlacesInPlan>& downward_faces) {
  std::vector<bool> wanted(downward_faces.size(), false);
  for (std::size_t k = 1; k < downward_faces.size(); ++k) {
    if (!downward_faces[k].none()) wanted[k - 1] = wanted[k] = true;
  }
  return wanted;
}

// For each wanted layer, the triangles that its section may cut, in the mesh's order.
std::vector<Triangles> triangles_by_layer(const TriangleMesh& mesh, const std::vector<double>& heights,
                                          const std::vector<bool>& wanted) {
  std::vector<Triangles> layers(heights.size());
  for (const auto& triangle : mesh.triangles) {
    const auto [low, high] =
        std::minmax({mesh.vertices[triangle[0]].z(), mesh.vertices[triangle[1]].z(), mesh.vertices[triangle[2]].z()});
    const auto first = std::lower_bound(heights.begin(), heights.end(), low) - heights.begin();
    for (auto k = static_cast<std::size_t>(first); k < heights.size() && heights[k] <= high; ++k) {
      if (wanted[k]) layers[k].push_back(triangle);
    }
  }
  return layers;
}

}  // namespace

std::vector<Vec3> ledges_in_layers(const TriangleMesh& lying, double overhang, Corners corners) {
  const double steepness = elementary::tan(overhang + k_threshold_margin), reach = k_layer / steepness;
  const Bounds box = bounds(lying);
  // The middles of the layers from the second on. Overhangs over the first sink onto the bed, and PrusaSlicer puts no
  // support that low.
  std::vector<double> heights{box.low.z() + 1.5 * k_layer};
  for (double z = box.low.z() + 2.5 * k_layer; z < box.high.z(); z += k_layer) heights.push_back(z);
  const TriangleMesh welded = weld(lying);
  const std::vector<PlacesInPlan> downward_faces = flat_downward_faces(welded, heights, steepness);
  const std::vector<Triangles> layers = triangles_by_layer(welded, heights, relevant_layers(downward_faces));
  const auto section_of = [&](std::size_t layer) { return section_of_welded(welded, layers[layer], heights[layer]); };
  // Overhanging places of the layers from `first` to `last`.
  const auto ledges_between = [&](std::size_t first, std::size_t last) {
    std::vector<Vec3> ledges;
    std::vector<Polygon> below = section_of(first);
    for (std::size_t layer = first + 1; layer <= last; ++layer) {
      std::vector<Polygon> here = section_of(layer);
      if (!downward_faces[layer].none()) {
        const WidenedLayer widened(std::move(below), reach, corners);
        for (const Polygon& loop : here) {
          if (const auto out = LayerWalk(widened, downward_faces[layer]).furthest_out(loop))
            ledges.emplace_back(out->x(), out->y(), heights[layer]);
        }
      }
      below = std::move(here);
    }
    return ledges;
  };
  const std::size_t half = heights.size() / 2;
  auto upper = run_async([&] { return ledges_between(half, heights.size() - 1); });
  std::vector<Vec3> ledges = ledges_between(0, half);
  for (const Vec3& ledge : upper.get()) ledges.push_back(ledge);
  return ledges;
}

}  // namespace fusee::solid
