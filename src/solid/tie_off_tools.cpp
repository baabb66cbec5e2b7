#include "solid/tie_off_tools.h"

#include <algorithm>
#include <cmath>

#include "fusee/base.h"
#include "solid/boolean.h"
#include "solid/bore.h"
#include "solid/channel_entries.h"
#include "solid/face_holes.h"
#include "solid/tools.h"

namespace fusee::solid {
namespace {

// A slot to the face begins this far past the groove's plane, in the floor's band.
constexpr double k_past_plane = 0.03;

/// Axial position of a tie-off in print orientation: heights are measured upwards from the groove's plane.
struct Heights {
  double plane = 0;
  double up = 1;               ///< −1: printed upside down
  double half = 0;             ///< half the height of the channel
  double channel_ceiling = 0;  ///< rise of its ceiling
  double open = 0;             ///< height of the pocket's open end; negative: the pocket opens on the bed
  double pocket_ceiling = 0;   ///< height of the ceiling of a pocket that opens on the bed
};

Heights heights_of(const BodyLayout& layout, transmission::Side side, int variant) {
  Heights heights;
  const bool left = side == transmission::Side::left, upside_down = left && layout.parts == Parts::two;
  heights.plane = left ? layout.z_p1 : layout.z_p2;
  heights.up = upside_down ? -1.0 : 1.0;
  heights.half = channel_half_height(layout, variant);
  heights.channel_ceiling = layout.channel_ceiling;
  heights.open = left ? layout.z_p1 + k_overshoot : layout.z_hub - layout.z_p2 + k_overshoot;
  if (left && !upside_down) {
    heights.open = -heights.open;
    heights.pocket_ceiling = layout.pocket_ceiling;
  }
  return heights;
}

// The ceiling is one slope that rises from the inner wall, which supports its whole length, to the outer one. Where the
// outer wall ends, at the entry, the slope continues into the groove's own ceiling. A flat ceiling would be bridged
// only if it were closed all round. The strips of a peaked ceiling would end in mid-air at such an oblique entry.
TriangleMesh channel(const ChannelEdges& edges, double width, const Heights& heights) {
  std::vector<std::vector<Vec3>> sections;
  for (std::size_t k = 0; k < edges.outer.size(); ++k) {
    const Vec2 &outer = edges.outer[k], &inner = edges.inner[k];
    const double outer_ceiling = heights.half + heights.channel_ceiling * (outer - inner).norm() / width;
    sections.push_back({{inner.x(), inner.y(), -heights.half},
                        {outer.x(), outer.y(), -heights.half},
                        {outer.x(), outer.y(), outer_ceiling},
                        {inner.x(), inner.y(), heights.half}});
  }
  return strip(sections);
}

// Seen from its centre, x ahead and y to the channel's outer side: a circle, and a tab in which the channel ends at a
// wall across it. The circle alone would meet the channel's slope at too sharp an angle.
std::vector<Vec2> pocket_outline(double radius, double width, bool has_tab, int facets) {
  // Slightly wider than the channel, so that no two of their faces coincide.
  const double half = half_tab(width, radius), behind = elementary::asin(half / radius);
  const double step = k_two_pi / facets;
  std::vector<Vec2> points;
  if (!has_tab) {
    for (int k = 0; k < facets; ++k) points.push_back(radius * unit(k * step));
    return points;
  }
  for (double angle = 0; angle < k_pi - behind - 0.3 * step; angle += step) points.push_back(radius * unit(angle));
  points.push_back(radius * unit(k_pi - behind));
  points.emplace_back(-radius - k_pocket_excess, half);
  points.emplace_back(-radius - k_pocket_excess, -half);
  points.push_back(radius * unit(k_pi + behind));
  // The circle's other half is the mirror image of the first. The last four points are the tab's.
  const std::size_t half_circle = points.size() - 4;
  for (std::size_t k = half_circle; k-- > 1;) points.emplace_back(points[k].x(), -points[k].y());
  return points;
}

// The ceiling over a pocket that opens on the bed rises across it as the channel's does. The channel's ceiling lies
// entirely below it, so that no ridge hangs down between the two.
TriangleMesh pocket(const AnchorPath& path, double radius, double width, int facets, const Heights& heights) {
  const bool has_tab = heights.channel_ceiling > 0 && path.straight > radius + k_pocket_excess;
  std::vector<Vec3> open_end, closed_end;
  for (const Vec2& local : pocket_outline(radius, width, has_tab, facets)) {
    const Vec2 point = path.pocket() + local.x() * path.heading() + local.y() * path.outer();
    const double ceiling = heights.pocket_ceiling * 0.5 * (1.0 + local.y() / radius);
    open_end.emplace_back(point.x(), point.y(), heights.open);
    closed_end.emplace_back(point.x(), point.y(),
                            std::copysign(heights.half + k_pocket_excess, -heights.open) + ceiling);
  }
  return strip({open_end, closed_end});
}

TriangleMesh channel_tool(const BodyPlan& plan, transmission::Side side, const AnchorPath& planned, int variant) {
  const BodyLayout& layout = plan.layout;
  const AnchorPath path = varied(planned, variant);
  const double width = layout.channel_width, radius = layout.pocket_radius;
  const Heights heights = heights_of(layout, side, variant);
  const ChannelEdges edges = channel_edges(plan, side, path);
  const auto both = unite(rounded_to_float(channel(edges, width, heights)),
                          rounded_to_float(pocket(path, radius, width, pocket_facets(radius) + variant, heights)));
  demand(both.has_value(), "channel and knot pocket do not join");
  TriangleMesh tool = both->mesh;
  for (Vec3& vertex : tool.vertices) vertex.z() = heights.plane + heights.up * vertex.z();
  if (heights.up < 0) turn_inside_out(tool);
  return tool;
}

// The countersink narrows into the slot's round end, but not exactly to its circle, so that no two faces coincide.
TriangleMesh countersink(const FaceHole& hole, double depth, double outside, int variant) {
  constexpr double k_share = 0.9;
  const auto circle = [&](const Vec2& centre, double radius) {
    const int facets = pocket_facets(hole.hole_radius) + variant;
    Polygon points;
    for (int k = 0; k < facets; ++k) points.push_back(centre + radius * unit(k_two_pi * (k + 0.31) / facets));
    return points;
  };
  // The depth at which the cone has narrowed to that smaller circle, on the same slope: its widest ceiling is
  // 2 (room − r) + (1 − k_share) r instead of 2 (room − r), with the slot's half width r.
  const double deeper = depth * (1.0 + 0.5 * (1.0 - k_share) * hole.hole_radius / (hole.room - hole.hole_radius));
  const Polygon outer = circle(hole.pocket(), hole.room), inner = circle(hole.hole, k_share * hole.hole_radius);
  return strip({at_height(outer, -0.5 * k_overshoot - outside), at_height(outer, 0.0), at_height(inner, deeper)});
}

// The tool is first made as seen from the face, which lies at height 0, and then moved to its side.
TriangleMesh face_hole_tool(const BodyLayout& layout, transmission::Side side, const FaceHole& hole, int variant) {
  const bool left = side == transmission::Side::left;
  const double outside = k_overshoot + (left ? 0.0 : layout.z_hub - layout.z_top);
  const double to_groove = left ? layout.z_p1 : layout.z_top - layout.z_p2;
  TriangleMesh tool = prism({hole_outline(hole, variant)}, -outside, to_groove + k_past_plane);
  if (const double depth = countersink_depth(layout, hole); depth > 0) {
    const auto both =
        unite(rounded_to_float(std::move(tool)), rounded_to_float(countersink(hole, depth, outside, variant)));
    demand(both.has_value(), "slot and countersink do not join");
    tool = both->mesh;
  }
  if (left) return tool;
  for (Vec3& vertex : tool.vertices) vertex.z() = layout.z_top - vertex.z();
  turn_inside_out(tool);
  return tool;
}

}  // namespace

// The height is increased until the channel's floor does not lie in the plane of a ring.
double channel_half_height(const BodyLayout& layout, int variant) {
  double half = 0.5 * layout.channel_width * (1.0 + 0.002 * variant);
  const auto on_ring = [&half](const std::vector<GroovePoint>& wall) {
    return std::any_of(wall.begin(), wall.end(),
                       [&half](const GroovePoint& point) { return std::abs(point.dz - half) < 0.01; });
  };
  // P2's groove has the same two walls as P1's.
  while (on_ring(layout.p1.below) || on_ring(layout.p1.above)) half += 0.013;
  return half;
}

AnchorPath varied(AnchorPath path, int variant) {
  path.start += 0.011 * variant * path.sense * turned_left(path.normal);
  path.straight *= 1.0 - 0.003 * variant;
  return path;
}

ChannelEdges channel_edges(const BodyPlan& plan, transmission::Side side, const AnchorPath& path) {
  const BodyLayout& layout = plan.layout;
  if (layout.channel_ceiling <= 0) return plain_edges(path, layout.channel_width);
  const double cones = std::max({layout.lower_cone, layout.middle_cone, layout.upper_cone}) / rise_of(layout, 1.0);
  const double beyond = layout.groove_depth + cones + k_overshoot;
  return flared_edges(path, layout.channel_width, side == transmission::Side::left ? plan.floor1 : plan.floor2,
                      layout.entry_lean, beyond);
}

bool is_pocket_face_on_bed(const BodyLayout& layout, transmission::Side side) {
  return layout.ceiling_slope > 0 && side == transmission::Side::left && layout.parts == Parts::one;
}

// A half circle about the floor's end, and tangents outwards from both of its ends.
Polygon hole_outline(const FaceHole& hole, int variant) {
  const int steps = (pocket_facets(hole.hole_radius) + 1) / 2 + variant;
  Polygon points;
  for (int k = 0; k <= steps; ++k)
    points.push_back(hole.hole + hole.hole_radius * turned(hole.normal, 0.5 * k_pi + k_pi * k / steps));
  points.push_back(points.back() + hole.length * hole.normal);
  points.push_back(points.front() + hole.length * hole.normal);
  return points;
}

TriangleMesh tie_off_tool(const BodyPlan& plan, const PlannedAnchor& anchor, int variant) {
  if (const auto* path = std::get_if<AnchorPath>(&anchor.tie_off))
    return channel_tool(plan, anchor.side, *path, variant);
  return face_hole_tool(plan.layout, anchor.side, std::get<FaceHole>(anchor.tie_off), variant);
}

// A section across the slot is a rectangle. If the face lies on the bed, a peaked ceiling is added. Each of its slopes
// grows out of its own wall over the whole length, so that it prints up to the opening into the pocket.
TriangleMesh tail_slot_tool(const BodyLayout& layout, transmission::Side side, const TailSlot& slot) {
  const double face = side == transmission::Side::left ? 0.0 : layout.z_top,
               in = side == transmission::Side::left ? 1.0 : -1.0;
  const Vec2 across = 0.5 * slot.width * turned_left((slot.to - slot.from).normalized());
  const auto section_at = [&](const Vec2& place) {
    std::vector<Vec3> section;
    const auto add = [&](double aside, double depth) {
      const Vec2 point = place + aside * across;
      section.emplace_back(point.x(), point.y(), face + in * depth);
    };
    add(-1, -k_overshoot);
    add(1, -k_overshoot);
    add(1, slot.depth);
    if (slot.ceiling > 0) add(0, slot.depth + slot.ceiling);
    add(-1, slot.depth);
    return section;
  };
  return strip({section_at(slot.from), section_at(slot.to)});
}

TriangleMesh clamp_pilot_tool(const BodyLayout& layout, transmission::Side side, const TailSlot& slot) {
  const Polygon hole = polyhole(slot.pilot_diameter, slot.to);
  if (side == transmission::Side::left) return prism({hole}, -k_overshoot, slot.pilot_depth);
  return prism({hole}, layout.z_top - slot.pilot_depth, layout.z_top + k_overshoot);
}

}  // namespace fusee::solid
