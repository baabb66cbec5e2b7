#include "solid/bridging.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "fusee/base.h"
#include "solid/nearest_segment.h"

// A patch is covered with parallel lines in a bridging direction. Each piece of a line from edge to edge is a chord. A
// chord that is supported at both ends and is level carries a bridge. All other places must be close to a supported
// edge or to a bridge.

namespace fusee::solid {
namespace {

// Limits of the spacing of lines across a patch. The largest is finer than any relevant step. Between the limits (a
// patch of 8 mm to 40 mm) there are k_lines lines.
constexpr double k_widest_spacing = 0.1;
constexpr double k_narrowest_spacing = 0.02;
constexpr double k_lines = 400;
// Spacing of points on a free rim. A rim bends little within it, and every corner is sampled in addition.
constexpr double k_rim_spacing = 0.25;
// Height within which a ceiling is printed in one layer and is therefore one bridge: the usual layer of a 0.4 mm
// nozzle. A higher vault consists of steps, layer by layer.
constexpr double k_usual_layer = 0.2;
// Directions tried: evenly spaced ones, and along and across the longest edges. Edges of almost the same direction
// count together.
constexpr int k_even_directions = 12;
constexpr std::size_t k_edge_directions = 6;
constexpr double k_same_direction = radians(1);
// Largest number of points sampled along a chord to decide whether it needs a bridge.
constexpr int k_points_of_chord = 32;

// The plan view in coordinates along and across a bridging direction.
struct Frame {
  Vec2 along, across;

  explicit Frame(double direction) : along(unit(direction)), across(turned_left(along)) {}
  Vec2 operator()(const Vec3& point) const { return {along.dot(point.head<2>()), across.dot(point.head<2>())}; }
  Vec2 in_plan(double position, double line) const { return position * along + line * across; }
};

// A piece of a line below a patch, from edge to edge.
struct Chord {
  long line = 0;             // number of the line
  double from = 0, to = 0;   // positions along the line
  double low = 0, high = 0;  // heights of the ceiling above it
  bool held = false;         // supported at both ends

  double length() const { return to - from; }
  double height() const { return 0.5 * (low + high); }
};

struct RimPoint {
  Vec3 at;
  double from_edge = 0;  // distance to the nearest supported edge
};

double extent_of(const OverhangPatch& patch) {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const OverhangFacet& facet : patch.facets) {
    for (const Vec3& corner : facet.corners) {
      low = low.cwiseMin(corner.head<2>());
      high = high.cwiseMax(corner.head<2>());
    }
  }
  return (high - low).norm();
}

template <typename Visit>
void for_each_side(const OverhangPatch& patch, EdgeSupport beyond, const Visit& visit) {
  for (const OverhangFacet& facet : patch.facets) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (facet.beyond[k] == beyond) visit(facet.corners[k], facet.corners[(k + 1) % 3]);
    }
  }
}

std::vector<Polygon> held_edges(const OverhangPatch& patch) {
  std::vector<Polygon> edges;
  for_each_side(patch, EdgeSupport::held, [&](const Vec3& a, const Vec3& b) {
    edges.push_back({a.head<2>(), b.head<2>()});
  });
  return edges;
}

std::vector<RimPoint> free_rim(const OverhangPatch& patch, const NearestSegment& held) {
  std::vector<RimPoint> rim;
  for_each_side(patch, EdgeSupport::free, [&](const Vec3& a, const Vec3& b) {
    const int parts = 1 + static_cast<int>((b - a).head<2>().norm() / k_rim_spacing);
    for (int i = 0; i < parts; ++i) {
      const Vec3 at = a + (b - a) * (static_cast<double>(i) / parts);
      rim.push_back({at, held.distance(at.head<2>())});
    }
  });
  return rim;
}

std::vector<double> directions_of(const OverhangPatch& patch) {
  // For each bin of directions: total length of its edges, and sum of their directions weighted by length.
  std::map<int, std::pair<double, double>> bins;
  const auto add = [&bins](const Vec3& a, const Vec3& b) {
    const Vec2 edge = (b - a).head<2>();
    double direction = elementary::atan2(edge.y(), edge.x());
    if (direction < 0) direction += k_pi;
    auto& [length, weighted_sum] = bins[static_cast<int>(direction / k_same_direction)];
    length += edge.norm();
    weighted_sum += edge.norm() * direction;
  };
  for_each_side(patch, EdgeSupport::held, add);
  for_each_side(patch, EdgeSupport::free, add);
  std::vector<std::pair<double, double>> longest;
  for (const auto& [bin, edges] : bins) {
    if (edges.first > 0) longest.emplace_back(edges.first, edges.second / edges.first);
  }
  std::sort(longest.rbegin(), longest.rend());
  longest.resize(std::min(longest.size(), k_edge_directions));
  std::vector<double> directions;
  for (const auto& [length, direction] : longest) {
    directions.push_back(direction + k_pi / 2);
    directions.push_back(direction);
  }
  for (int i = 0; i < k_even_directions; ++i) directions.push_back(k_pi * i / k_even_directions);
  return directions;
}

// Finds all chords. Each line is followed through the patch from facet to facet, because a patch may have holes and may
// lie above itself. A corner on a line counts as beyond it.
class Chords {
 public:
  Chords(const OverhangPatch& patch, const Frame& frame, double spacing) : patch_(patch), spacing_(spacing) {
    plan_.reserve(patch.facets.size());
    for (const OverhangFacet& facet : patch.facets) {
      plan_.push_back({frame(facet.corners[0]), frame(facet.corners[1]), frame(facet.corners[2])});
    }
  }

  std::vector<Chord> all() const {
    std::vector<Chord> chords;
    for (std::uint32_t f = 0; f < plan_.size(); ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (patch_.facets[f].beyond[k] == EdgeSupport::patch) continue;
        // The facet faces down: at a side that rises across the lines, the lines enter the facet.
        const double from = plan_[f][k].y(), to = plan_[f][(k + 1) % 3].y();
        for (long line = static_cast<long>(std::floor(from / spacing_)); line * spacing_ <= to; ++line) {
          if (line * spacing_ > from) chords.push_back(walk(f, k, line));
        }
      }
    }
    std::sort(chords.begin(), chords.end(),
              [](const Chord& a, const Chord& b) { return std::pair(a.line, a.from) < std::pair(b.line, b.from); });
    return chords;
  }

 private:
  bool is_beyond(std::uint32_t f, std::size_t k, long line) const { return plan_[f][k % 3].y() >= line * spacing_; }

  // Position along the line, and height, of the point in which it crosses a side.
  std::pair<double, double> position_and_height(std::uint32_t f, std::size_t k, long line) const {
    const Vec2 &a = plan_[f][k], &b = plan_[f][(k + 1) % 3];
    const double share = (line * spacing_ - a.y()) / (b.y() - a.y());
    const auto& corners = patch_.facets[f].corners;
    return {a.x() + share * (b.x() - a.x()), corners[k].z() + share * (corners[(k + 1) % 3].z() - corners[k].z())};
  }

  Chord walk(std::uint32_t f, std::size_t k, long line) const {
    const auto [start, start_height] = position_and_height(f, k, line);
    Chord chord{line, start, start, start_height, start_height, patch_.facets[f].beyond[k] == EdgeSupport::held};
    while (true) {
      std::size_t out = 0;  // the side across which the line leaves the facet
      while (!(is_beyond(f, out, line) && !is_beyond(f, out + 1, line))) ++out;
      const auto [position, height] = position_and_height(f, out, line);
      chord.to = position;
      chord.low = std::min(chord.low, height);
      chord.high = std::max(chord.high, height);
      const OverhangFacet& facet = patch_.facets[f];
      if (facet.beyond[out] != EdgeSupport::patch) {
        chord.held = chord.held && facet.beyond[out] == EdgeSupport::held;
        return chord;
      }
      f = facet.neighbour[out];
    }
  }

  const OverhangPatch& patch_;
  double spacing_;
  std::vector<std::array<Vec2, 3>> plan_;
};

class Ceiling {
 public:
  Ceiling(const OverhangPatch& patch, const PrintLimits& limits)
      : patch_(patch),
        limits_(limits),
        extent_(extent_of(patch)),
        spacing_(std::clamp(extent_ / k_lines, k_narrowest_spacing, k_widest_spacing)),
        held_(held_edges(patch)),
        rim_(free_rim(patch, held_)) {}

  SupportGaps best() const {
    // Without a supported edge, the whole patch is unsupported.
    if (held_edges(patch_).empty()) return {0, Vec3::Zero(), extent_, patch_.flattest_at};
    std::optional<SupportGaps> best;
    for (const double direction : directions_of(patch_)) {
      const SupportGaps gaps = gaps_along(Frame(direction));
      if (!best || badness(gaps) < badness(*best)) best = gaps;
      if (best->bridge == 0 && best->step <= limits_.step) break;
    }
    return *best;
  }

 private:
  // The larger of both gaps relative to its limit. A limit below the narrowest spacing, such as
  // 0, counts as that spacing.
  double badness(const SupportGaps& gaps) const {
    return std::max(gaps.bridge / std::max(limits_.bridge, k_narrowest_spacing),
                    gaps.step / std::max(limits_.step, k_narrowest_spacing));
  }

  SupportGaps gaps_along(const Frame& frame) const {
    SupportGaps gaps;
    std::vector<Chord> bridges;
    for (const Chord& chord : Chords(patch_, frame, spacing_).all()) {
      if (!chord.held) continue;
      if (chord.high - chord.low <= k_usual_layer) {
        bridges.push_back(chord);
      } else {
        measure_vault(gaps, frame, chord);
      }
    }
    for (const Chord& chord : bridges) measure_bridge(gaps, frame, chord);
    // Bridges support a free rim, if they are within the limit or no longer than the one that is reported.
    const double longest = std::max(gaps.bridge, limits_.bridge);
    bridges.erase(std::remove_if(bridges.begin(), bridges.end(),
                                 [longest](const Chord& chord) { return chord.length() > longest; }),
                  bridges.end());
    measure_rim(gaps, frame, bridges);
    return gaps;
  }

  // The point at a fraction of a chord's length.
  Vec3 point_on(const Frame& frame, const Chord& chord, double share) const {
    const Vec2 plan = frame.in_plan(chord.from + share * chord.length(), static_cast<double>(chord.line) * spacing_);
    return {plan.x(), plan.y(), chord.height()};
  }

  // The point of a chord that is furthest from all supported edges, and its distance from them.
  std::pair<double, Vec3> furthest(const Frame& frame, const Chord& chord) const {
    // An even number, so that the middle is sampled.
    const int parts = std::clamp(2 * static_cast<int>(chord.length() / k_widest_spacing), 2, k_points_of_chord);
    std::pair<double, Vec3> found{0, point_on(frame, chord, 0)};
    for (int i = 1; i < parts; ++i) {
      const Vec3 at = point_on(frame, chord, static_cast<double>(i) / parts);
      const double distance = held_.distance(at.head<2>());
      if (distance > found.first) found = {distance, at};
    }
    return found;
  }

  // A chord that is not level carries no bridge, so its middle must be close to an edge.
  void measure_vault(SupportGaps& gaps, const Frame& frame, const Chord& chord) const {
    if (0.5 * chord.length() <= gaps.step) return;
    const auto [distance, at] = furthest(frame, chord);
    if (distance > gaps.step) std::tie(gaps.step, gaps.step_at) = std::pair(distance, at);
  }

  // A chord everywhere within a step of its edges needs no bridge.
  void measure_bridge(SupportGaps& gaps, const Frame& frame, const Chord& chord) const {
    if (chord.length() <= std::max(gaps.bridge, 2 * limits_.step)) return;
    if (furthest(frame, chord).first <= limits_.step) return;
    gaps.bridge = chord.length();
    gaps.bridge_at = point_on(frame, chord, 0.5);
  }

  void measure_rim(SupportGaps& gaps, const Frame& frame, const std::vector<Chord>& bridges) const {
    for (const RimPoint& point : rim_) {
      if (point.from_edge <= gaps.step) continue;
      const double distance = distance_to_support(bridges, frame(point.at), point.from_edge);
      if (distance > gaps.step) std::tie(gaps.step, gaps.step_at) = std::pair(distance, point.at);
    }
  }

  // Distance of a point to the nearest bridge, or `from_edge` if that is less. The space between two adjacent lines
  // belongs to their bridges, so the distance across is less by the spacing.
  double distance_to_support(const std::vector<Chord>& bridges, const Vec2& point, double from_edge) const {
    double least = from_edge;
    const auto first =
        std::lower_bound(bridges.begin(), bridges.end(), (point.y() - least) / spacing_ - 1,
                         [](const Chord& chord, double line) { return static_cast<double>(chord.line) < line; });
    for (auto chord = first; chord != bridges.end(); ++chord) {
      const double across = static_cast<double>(chord->line) * spacing_ - point.y();
      if (across > least + spacing_) break;
      const double beyond = std::max({chord->from - point.x(), point.x() - chord->to, 0.0});
      least = std::min(least, elementary::hypot(std::max(std::abs(across) - spacing_, 0.0), beyond));
    }
    return least;
  }

  const OverhangPatch& patch_;
  const PrintLimits& limits_;
  double extent_;
  double spacing_;
  NearestSegment held_;
  std::vector<RimPoint> rim_;
};

}  // namespace

SupportGaps support_gaps_of(const OverhangPatch& patch, const PrintLimits& limits) {
  return Ceiling(patch, limits).best();
}

}  // namespace fusee::solid
