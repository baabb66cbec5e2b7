#include "solid/channel_entries.h"

#include <algorithm>
#include <cmath>

#include "fusee/base.h"
#include "solid/plane_distance.h"

namespace fusee::solid {
namespace {

// Depth inside the floor from which the channel's outer edge is left unchanged. mm
constexpr double k_crossing_depth = 0.1;
// Number of chords of a channel's arc as it is cut.
constexpr int k_steps = 12;
// Number of chords of the arc for finding where it crosses the floor.
constexpr int k_fine_steps = 48;

// The point where the outer edge reaches k_crossing_depth inside the floor, and the floor's outward normal there.
struct FloorCrossing {
  double turn = 0;      ///< angle of the arc up to the point
  double straight = 0;  ///< length from the arc's end to the point; 0: it lies on the arc
  Vec2 point = Vec2::Zero();
  Vec2 normal = Vec2::Zero();
};

FloorCrossing floor_crossing(const AnchorPath& path, double width, const Polygon& floor) {
  const std::vector<Vec2> arc = path.edge(0.5 * width, k_fine_steps);
  FloorCrossing crossing;
  Depth depth;
  for (int k = 0; k <= k_fine_steps; ++k) {
    const Vec2& point = arc[static_cast<std::size_t>(k)];
    depth = depth_and_normal(floor, point);
    crossing = {path.turn * k / k_fine_steps, 0.0, point, depth.normal};
    if (depth.value >= k_crossing_depth) return crossing;
  }
  // The point lies on the straight, not on the arc. The depth grows along the straight by the sine of its angle to the
  // floor, which is limited because a straight along the floor never reaches the depth.
  const double sine = std::max(0.1, -path.heading().dot(crossing.normal));
  crossing.straight = std::min((k_crossing_depth - depth.value) / sine, path.straight);
  crossing.point += crossing.straight * path.heading();
  return crossing;
}

// Distance along `direction` from `from` to the line through `on` along `along`. Negative if they meet behind `from` or
// are parallel.
double distance_to_line(const Vec2& from, const Vec2& direction, const Vec2& on, const Vec2& along) {
  constexpr double k_parallel = 1e-9;
  const double sine = cross(direction, along);
  return std::abs(sine) < k_parallel ? -1.0 : cross(on - from, along) / sine;
}

// A channel entry between two walls. The first stands on the groove edge at the channel's start, the second where the
// channel's outer edge reaches the floor. The walls may meet outside. Seen from the centre of the channel's arc, every
// ray meets the inner edge once and the outer boundary once. The ceiling between them is therefore a piece of a cone.
class Flare {
 public:
  Flare(const AnchorPath& path, double width, const Polygon& floor, double lean, double beyond)
      : path_(path),
        half_(0.5 * width),
        centre_(path.start - path.fillet * path.normal),
        crossing_(floor_crossing(path, width, floor)) {
    const Vec2 radial = (crossing_.point - centre_).normalized();
    second_wall_ = turned(crossing_.normal, -path.sense * lean);
    // A wall that leaned away from the channel's start would be hidden behind the channel's edge.
    if (path.sense * cross(radial, second_wall_) > 0) second_wall_ = radial;
    const double to_second_wall = distance_to_line(path.start, path.normal, crossing_.point, second_wall_);
    walls_meet_ = to_second_wall > 0 && to_second_wall < beyond;
    first_wall_end_ = path.start + (walls_meet_ ? to_second_wall : beyond) * path.normal;
    second_wall_end_ = walls_meet_ ? first_wall_end_ : Vec2(crossing_.point + beyond * second_wall_);
  }

  ChannelEdges edges() const {
    ChannelEdges edges;
    for (const double turn : turns()) add(edges, ray(turn), path_.fillet - half_, outer_radius(turn));
    if (crossing_.straight > 0) {
      edges.inner.push_back(centre_ + (path_.fillet - half_) * path_.outer() + crossing_.straight * path_.heading());
      edges.outer.push_back(crossing_.point);
    }
    edges.inner.push_back(path_.pocket() - half_ * path_.outer());
    edges.outer.push_back(path_.pocket() + half_ * path_.outer());
    return edges;
  }

 private:
  Vec2 ray(double turn) const { return turned(path_.normal, path_.sense * turn); }
  void add(ChannelEdges& edges, const Vec2& direction, double inner, double outer) const {
    edges.inner.push_back(centre_ + inner * direction);
    edges.outer.push_back(centre_ + outer * direction);
  }

  // The angle at which a ray from the arc's centre passes through a point.
  double turn_of(const Vec2& point) const {
    const Vec2 from_centre = point - centre_;
    return path_.sense * elementary::atan2(cross(path_.normal, from_centre), path_.normal.dot(from_centre));
  }

  // Angles of the rays at which the edges have points. They are evenly spaced. Both ends of the second wall replace
  // angles that are too close to them.
  std::vector<double> turns() const {
    std::vector<double> required{0.0, path_.turn};
    if (!walls_meet_) required.push_back(turn_of(second_wall_end_));
    if (crossing_.straight <= 0) required.push_back(crossing_.turn);
    std::vector<double> turns;
    const double step = path_.turn / k_steps;
    const auto is_close_to_one = [&turns](std::size_t count, double turn, double distance) {
      return std::any_of(turns.begin(), turns.begin() + static_cast<std::ptrdiff_t>(count),
                         [&](double other) { return std::abs(other - turn) < distance; });
    };
    for (const double turn : required) {
      const bool is_within = turn >= 0 && turn <= path_.turn;
      if (is_within && !is_close_to_one(turns.size(), turn, 0.1 * step)) turns.push_back(turn);
    }
    const std::size_t required_count = turns.size();
    for (int k = 1; k < k_steps; ++k) {
      if (!is_close_to_one(required_count, k * step, 0.4 * step)) turns.push_back(k * step);
    }
    std::sort(turns.begin(), turns.end());
    return turns;
  }

  // Distance from the arc's centre to the outer boundary. The boundary is the line from the first wall's end to the
  // second wall's (unless they meet), then the second wall, then the channel's own edge.
  double outer_radius(double turn) const {
    const double of_channel = path_.fillet + half_;
    if (crossing_.straight <= 0 && turn >= crossing_.turn) return of_channel;
    const bool is_between_walls = !walls_meet_ && turn < turn_of(second_wall_end_);
    const double of_entry =
        is_between_walls ? distance_to_line(centre_, ray(turn), first_wall_end_, second_wall_end_ - first_wall_end_)
                         : distance_to_line(centre_, ray(turn), crossing_.point, second_wall_);
    // The entry is at least as wide as the channel.
    return std::max(of_entry, of_channel);
  }

  const AnchorPath& path_;
  double half_;  ///< half the channel's width
  Vec2 centre_;  ///< of the channel's arc
  FloorCrossing crossing_;
  Vec2 second_wall_ = Vec2::Zero();  ///< direction of the second wall, outwards
  bool walls_meet_ = false;
  Vec2 first_wall_end_ = Vec2::Zero();
  Vec2 second_wall_end_ = Vec2::Zero();
};

}  // namespace

ChannelEdges plain_edges(const AnchorPath& path, double width) {
  ChannelEdges edges{path.edge(-0.5 * width, k_steps), path.edge(0.5 * width, k_steps)};
  const Vec2 aside = 0.5 * width * path.outer();
  edges.inner.emplace_back(path.pocket() - aside);
  edges.outer.emplace_back(path.pocket() + aside);
  return edges;
}

ChannelEdges flared_edges(const AnchorPath& path, double width, const Polygon& floor, double lean, double beyond) {
  return Flare(path, width, floor, lean, beyond).edges();
}

// Computed for a straight floor. The pitch curve's tangent at the start is the x axis, and the floor lies half a tendon
// below it.
double entry_rise(const BodyLayout& layout) {
  AnchorPath path;
  path.start = Vec2::Zero();
  path.normal = {0, 1};
  path.sense = -1;
  path.fillet = layout.channel_fillet;
  path.turn = radians(70);  // the preferred turn of a channel
  path.straight = layout.channel_width;
  const double d = layout.tendon_diameter, far = 100.0 * layout.channel_width;
  const Polygon floor{{-far, -far}, {far, -far}, {far, -0.5 * d}, {-far, -0.5 * d}};
  const double groove_edge = layout.groove_depth - 0.5 * d;
  const ChannelEdges edges =
      flared_edges(path, layout.channel_width, floor, layout.entry_lean, layout.groove_depth + 1.0);
  double top = 0;
  for (std::size_t k = 0; k < edges.inner.size(); ++k) {
    const Vec2 across = edges.outer[k] - edges.inner[k];
    // The fraction of the ceiling's width at which it passes the groove edge; above 1: it ends below.
    const double share = across.y() > 0 ? (groove_edge - edges.inner[k].y()) / across.y() : 2.0;
    if (share <= 1.0) top = std::max(top, rise_of(layout, share * across.norm()));
  }
  const GrooveWalls& walls = layout.parts == Parts::two ? layout.p1 : layout.p2;
  const double ceiling = std::max(walls.below_width(), walls.above_width());
  return std::max(0.0, 0.5 * layout.channel_width + top - ceiling);
}

}  // namespace fusee::solid
