#include "solid/channel_entries.h"

#include <algorithm>
#include <cmath>

#include "fusee/base.h"
#include "solid/plane_distance.h"

namespace fusee::solid {
namespace {

// Depth of the channel's outer edge within the floor from which the edge is left unchanged.
constexpr double k_depth = 0.1;
constexpr int k_steps = 12;
constexpr int k_fine_steps = 48;

// The place where the outer edge reaches k_depth into the floor, and the floor's outward normal there.
struct FloorCrossing {
  double turn = 0;      ///< angle of the arc up to there
  double straight = 0;  ///< length past the arc's end
  Vec2 place = Vec2::Zero();
  Vec2 normal = Vec2::Zero();
};

FloorCrossing floor_crossing(const AnchorPath& path, double width, const Polygon& floor) {
  const std::vector<Vec2> arc = path.edge(0.5 * width, k_fine_steps);
  FloorCrossing crossing;
  Depth depth;
  for (int k = 0; k <= k_fine_steps; ++k) {
    const Vec2& place = arc[static_cast<std::size_t>(k)];
    depth = depth_and_normal(floor, place);
    crossing = {path.turn * k / k_fine_steps, 0.0, place, depth.normal};
    if (depth.value >= k_depth) return crossing;
  }
  // The place lies on the straight, not on the arc.
  crossing.straight =
      std::min((k_depth - depth.value) / std::max(0.1, -path.heading().dot(crossing.normal)), path.straight);
  crossing.place += crossing.straight * path.heading();
  return crossing;
}

// Distance along `direction` from `from` to the line through `on` along `along`; negative or huge if they do not meet.
double run_to_line(const Vec2& from, const Vec2& direction, const Vec2& on, const Vec2& along) {
  const double sine = cross(direction, along);
  return std::abs(sine) < 1e-9 ? -1.0 : cross(on - from, along) / sine;
}

// A channel entry between two walls: one stands on the groove edge at the channel's start, the other where its outer
// edge reaches the floor. Seen from the centre of the channel's arc, every ray meets the inner edge once and the outer
// boundary once. The ceiling between them is therefore a piece of a cone.
class Flare {
 public:
  Flare(const AnchorPath& path, double width, const Polygon& floor, double lean, double beyond)
      : path_(path),
        half_(0.5 * width),
        centre_(path.start - path.fillet * path.normal),
        crossing_(floor_crossing(path, width, floor)) {
    const Vec2 radial = (crossing_.place - centre_).normalized();
    out_ = turned(crossing_.normal, -path.sense * lean);
    // A wall that leaned away from the channel's start would be hidden behind the channel's edge.
    if (path.sense * cross(radial, out_) > 0) out_ = radial;
    const double met = run_to_line(path.start, path.normal, crossing_.place, out_);
    meet_ = met > 0 && met < beyond;
    first_ = path.start + (meet_ ? met : beyond) * path.normal;
    corner_ = meet_ ? first_ : Vec2(crossing_.place + beyond * out_);
  }

  ChannelEdges edges() const {
    ChannelEdges edges;
    for (const double turn : turns()) add(edges, ray(turn), path_.fillet - half_, outer_radius(turn));
    if (crossing_.straight > 0) {
      edges.inner.push_back(centre_ + (path_.fillet - half_) * path_.outer() + crossing_.straight * path_.heading());
      edges.outer.push_back(crossing_.place);
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

  double turn_of(const Vec2& place) const {
    const Vec2 from_centre = place - centre_;
    return path_.sense * elementary::atan2(cross(path_.normal, from_centre), path_.normal.dot(from_centre));
  }

  // Evenly spaced, with both ends of the second wall replacing angles that are too close to them.
  std::vector<double> turns() const {
    std::vector<double> marks{0.0, path_.turn};
    if (!meet_) marks.push_back(turn_of(corner_));
    if (crossing_.straight <= 0) marks.push_back(crossing_.turn);
    std::vector<double> turns;
    const double step = path_.turn / k_steps;
    for (const double mark : marks) {
      const bool taken =
          std::any_of(turns.begin(), turns.end(), [&](double turn) { return std::abs(turn - mark) < 0.1 * step; });
      if (mark >= 0 && mark <= path_.turn && !taken) turns.push_back(mark);
    }
    const std::size_t fixed = turns.size();
    for (int k = 1; k < k_steps; ++k) {
      const double turn = k * step;
      const bool near = std::any_of(turns.begin(), turns.begin() + static_cast<std::ptrdiff_t>(fixed),
                                    [&](double mark) { return std::abs(turn - mark) < 0.4 * step; });
      if (!near) turns.push_back(turn);
    }
    std::sort(turns.begin(), turns.end());
    return turns;
  }

  double outer_radius(double turn) const {
    const double plain = path_.fillet + half_;
    if (crossing_.straight <= 0 && turn >= crossing_.turn) return plain;
    const bool before_corner = !meet_ && turn < turn_of(corner_);
    const double reach = before_corner ? run_to_line(centre_, ray(turn), first_, corner_ - first_)
                                       : run_to_line(centre_, ray(turn), crossing_.place, out_);
    // The entry is at least as wide as the channel.
    return std::max(reach, plain);
  }

  const AnchorPath& path_;
  double half_;
  Vec2 centre_;
  FloorCrossing crossing_;
  Vec2 out_ = Vec2::Zero();
  bool meet_ = false;
  Vec2 first_ = Vec2::Zero();   ///< end of the first wall
  Vec2 corner_ = Vec2::Zero();  ///< end of the second
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

// For a straight floor: the tangent at the start, moved in by half a tendon.
double entry_rise(const BodyLayout& layout) {
  AnchorPath path;
  path.start = Vec2::Zero();
  path.normal = {0, 1};
  path.sense = -1;
  path.fillet = layout.channel_fillet;
  path.turn = radians(70);
  path.straight = layout.channel_width;
  const double d = layout.tendon_diameter, far = 100.0 * layout.channel_width;
  const Polygon floor{{-far, -far}, {far, -far}, {far, -0.5 * d}, {-far, -0.5 * d}};
  const double groove_edge = layout.groove_depth - 0.5 * d;
  const ChannelEdges edges =
      flared_edges(path, layout.channel_width, floor, layout.entry_lean, layout.groove_depth + 1.0);
  double top = 0;
  for (std::size_t k = 0; k < edges.inner.size(); ++k) {
    const Vec2 across = edges.outer[k] - edges.inner[k];
    const double share = across.y() > 0 ? (groove_edge - edges.inner[k].y()) / across.y() : 2.0;
    if (share <= 1.0) top = std::max(top, rise_of(layout, share * across.norm()));
  }
  const GrooveWalls& walls = layout.parts == Parts::two ? layout.p1 : layout.p2;
  const double ceiling = std::max(walls.below_width(), walls.above_width());
  return std::max(0.0, 0.5 * layout.channel_width + top - ceiling);
}

}  // namespace fusee::solid
