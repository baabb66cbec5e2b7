#include "solid/mouths.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fusee/base/units.h"

namespace fusee {
namespace {

// The mouth's wall leans over by this against the groove's edge. PrusaSlicer widens a layer by 0.193 mm at 45° and 0.2 mm
// layers, with squared corners; the tip between a wall and an edge that grows by 0.19 mm stays within it down to 59°.
constexpr double k_lean = radians(20);
// From where the channel's outer edge lies this far within the floor it is left as it is.
constexpr double k_depth = 0.1;
constexpr int k_steps = 12;
constexpr int k_fine_steps = 48;

// Where the outer edge has come far enough into the floor, and the floor's outward normal there.
struct Entry {
  double share = 1;  ///< of the arc's turn
  Vec2 place = Vec2::Zero();
  Vec2 normal = Vec2::Zero();
};

struct Depth {
  double value = std::numeric_limits<double>::infinity();
  Vec2 normal = Vec2::Zero();
};

Depth depth_in(const Polygon& floor, const Vec2& point) {
  Depth depth;
  for (std::size_t i = 0; i < floor.size(); ++i) {
    const Vec2& a = floor[i];
    const Vec2 inward = turned_left(floor[(i + 1) % floor.size()] - a).normalized();
    const double distance = inward.dot(point - a);
    if (distance < depth.value) depth = {distance, -inward};
  }
  return depth;
}

Entry entry_of(const AnchorPath& path, double width, const Polygon& floor) {
  const std::vector<Vec2> arc = path.edge(0.5 * width, k_fine_steps);
  Entry entry;
  for (int k = 0; k <= k_fine_steps; ++k) {
    const Vec2& place = arc[static_cast<std::size_t>(k)];
    const Depth depth = depth_in(floor, place);
    entry = {static_cast<double>(k) / k_fine_steps, place, depth.normal};
    if (depth.value >= k_depth) return entry;
  }
  // Not on the arc: on the straight.
  const double sunk = depth_in(floor, entry.place).value;
  entry.place += (k_depth - sunk) / std::max(0.1, -path.heading().dot(entry.normal)) * path.heading();
  return entry;
}

}  // namespace

ChannelEdges plain_edges(const AnchorPath& path, double width) {
  ChannelEdges edges{path.edge(-0.5 * width, k_steps), path.edge(0.5 * width, k_steps)};
  const Vec2 aside = 0.5 * width * path.outer();
  edges.inner.emplace_back(path.pocket() - aside);
  edges.outer.emplace_back(path.pocket() + aside);
  return edges;
}

ChannelEdges flared_edges(const AnchorPath& path, double width, const Polygon& floor, double beyond) {
  ChannelEdges edges = plain_edges(path, width);
  const Entry entry = entry_of(path, width, floor);
  const Vec2 along = path.sense * turned_left(path.normal);
  const Vec2 out = turned(entry.normal, -path.sense * k_lean);
  // Past all flanges, but not behind the face in which the channel begins.
  const double back = -out.dot(along), behind = (entry.place - path.start).dot(along);
  const double reach = back * beyond > behind ? behind / back : beyond;
  const Vec2 flare = entry.place + reach * out;
  for (int k = 0; k <= k_steps; ++k) {
    const double share = static_cast<double>(k) / k_steps / entry.share;
    if (share <= 1.0) edges.outer[static_cast<std::size_t>(k)] = flare + share * (entry.place - flare);
  }
  return edges;
}

// Of a straight floor: the tangent at the start, moved in by half a tendon.
double mouth_rise(const BodyLayout& layout) {
  AnchorPath path;
  path.start = Vec2::Zero();
  path.normal = {0, 1};
  path.sense = -1;
  path.fillet = layout.channel_fillet;
  path.turn = radians(70);
  path.straight = layout.channel_width;
  const double d = layout.tendon_diameter, far = 100.0 * layout.channel_width;
  const Polygon floor{{-far, -far}, {far, -far}, {far, -0.5 * d}, {-far, -0.5 * d}};
  const double lip = layout.groove_depth - 0.5 * d;
  const ChannelEdges edges = flared_edges(path, layout.channel_width, floor, layout.groove_depth + 1.0);
  double top = 0;
  for (std::size_t k = 0; k < edges.inner.size(); ++k) {
    const Vec2 across = edges.outer[k] - edges.inner[k];
    const double share = across.y() > 0 ? (lip - edges.inner[k].y()) / across.y() : 2.0;
    if (share <= 1.0) top = std::max(top, rise_of(layout, share * across.norm()));
  }
  const GrooveWalls& walls = layout.parts == Parts::two ? layout.p1 : layout.p2;
  const double roof = std::max(walls.below_width(), walls.above_width());
  return std::max(0.0, 0.5 * layout.channel_width + top - roof);
}

}  // namespace fusee
