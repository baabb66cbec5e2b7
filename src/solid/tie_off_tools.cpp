#include "solid/tie_off_tools.h"

#include <algorithm>
#include <cmath>

#include "fusee/base/units.h"
#include "solid/bore.h"
#include "solid/face_holes.h"
#include "solid/tools.h"

namespace fusee {
namespace {

// Tools stand out of the body by this, so that no two of their faces coincide.
constexpr double k_overshoot = 1.0;

// The channel's floor and roof must not lie in the plane of a ring.
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

TriangleMesh channel_tool(const BodyLayout& layout, Side side, AnchorPath path, int variant) {
  path.straight *= 1.0 - 0.003 * variant;
  const double radius = layout.pocket_radius;
  const Keyhole shape = keyhole(path, layout.channel_width, radius, pocket_facets(radius) + variant);
  const double half = channel_half_height(layout, variant);
  if (side == Side::right)
    return keyhole_tool(shape,
                        {layout.z_hub + k_overshoot, layout.z_p2 + half, layout.z_p2 - half, layout.z_p2 - half});
  const double far = layout.z_p1 + half;
  const double roof_share = 1.0 - layout.pocket_roof / rise_of(layout, radius);
  return keyhole_tool(shape, {-k_overshoot, layout.z_p1 - half, far, far + layout.pocket_roof, roof_share});
}

// The countersink begins a little outside of the face, so that no edge of it lies in the face.
TriangleMesh face_hole_tool(const BodyLayout& layout, Side side, const FaceHole& hole, int variant) {
  constexpr double k_outside = 0.02;
  const Polygon inner = hole_outline(hole, variant);
  Polygon outer = inner;
  const double wider = std::max(hole.room, hole.hole_radius + k_outside) / hole.hole_radius;
  for (Vec2& point : outer) point = hole.pocket() + wider * (point - hole.hole);
  const double half = channel_half_height(layout, variant);
  const double depth = std::max(countersink_depth(layout, hole), k_outside);
  if (side == Side::left) return countersunk_tool(inner, outer, {-k_overshoot, -k_outside, depth, layout.z_p1 + half});
  return countersunk_tool(
      inner, outer, {layout.z_hub + k_overshoot, layout.z_top + k_outside, layout.z_top - depth, layout.z_p2 - half});
}

}  // namespace

Polygon hole_outline(const FaceHole& hole, int variant) {
  const int facets = pocket_facets(hole.hole_radius) + variant;
  Polygon points;
  for (int k = 0; k < facets; ++k)
    points.push_back(hole.hole + hole.hole_radius * unit(k_two_pi * (k + 0.31) / facets));
  return points;
}

TriangleMesh tie_off_tool(const BodyPlan& plan, const PlannedAnchor& anchor, int variant) {
  if (const auto* path = std::get_if<AnchorPath>(&anchor.way))
    return channel_tool(plan.layout, anchor.side, *path, variant);
  return face_hole_tool(plan.layout, anchor.side, std::get<FaceHole>(anchor.way), variant);
}

TriangleMesh tail_slot_tool(const BodyLayout& layout, Side side, const TailSlot& slot) {
  if (side == Side::left) return prism({slot.outline()}, -k_overshoot, slot.depth);
  return prism({slot.outline()}, layout.z_top - slot.depth, layout.z_top + k_overshoot);
}

TriangleMesh clamp_pilot_tool(const BodyLayout& layout, Side side, const TailSlot& slot) {
  const Polygon hole = polyhole(slot.pilot_diameter, slot.to);
  if (side == Side::left) return prism({hole}, 0.5 * slot.depth, slot.pilot_depth);
  return prism({hole}, layout.z_top - slot.pilot_depth, layout.z_top - 0.5 * slot.depth);
}

}  // namespace fusee
