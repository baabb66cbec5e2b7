#include "solid/tie_off_tools.h"

#include <algorithm>
#include <cmath>

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

}  // namespace

TriangleMesh tie_off_tool(const BodyPlan& plan, const PlannedAnchor& anchor, int variant) {
  const BodyLayout& layout = plan.layout;
  AnchorPath path = anchor.path;
  path.straight *= 1.0 - 0.003 * variant;
  const double radius = layout.pocket_radius;
  const Keyhole shape = keyhole(path, layout.channel_width, radius, pocket_facets(radius) + variant);
  const double half = channel_half_height(layout, variant);
  if (anchor.side == Side::right)
    return keyhole_tool(shape, {layout.z_hub + k_overshoot, layout.z_p2 + half, layout.z_p2 - half, layout.z_p2 - half});
  const double far = layout.z_p1 + half;
  const double roof_share = 1.0 - layout.pocket_roof / rise_of(layout, radius);
  return keyhole_tool(shape, {-k_overshoot, layout.z_p1 - half, far, far + layout.pocket_roof, roof_share});
}

}  // namespace fusee
