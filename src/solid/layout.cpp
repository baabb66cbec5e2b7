#include "fusee/solid/layout.h"

#include <algorithm>

#include "solid/groove.h"
#include "solid/plan.h"

namespace fusee {
namespace {

// Lip above the floor per tendon diameter: a tendon that goes slack for a moment stays in.
constexpr double k_depth_ratio = 2.0;

}  // namespace

BodyLayout axial_layout(const Mechanism& mechanism) {
  const Body& body = mechanism.body;
  const double d = mechanism.tendon.diameter;
  BodyLayout layout;
  layout.groove_depth = body.groove_depth > 0 ? body.groove_depth : k_depth_ratio * d;
  layout.groove = groove_section(body, d, layout.groove_depth);
  layout.groove_half_width = layout.groove.back().dz;
  layout.flange_thickness = body.flange_thickness;
  const double half = layout.groove_half_width, flange = layout.flange_thickness;
  layout.z_p1 = flange + half;
  layout.z_p2 = layout.z_p1 + 2.0 * half + flange;
  layout.z_top = layout.z_p2 + half + flange;
  layout.z_hub = layout.z_top;
  layout.elephant_foot = mechanism.material.elephant_foot;
  layout.mark_depth = body.mark_depth;
  layout.scale = 1.0 / (1.0 - mechanism.material.shrinkage);
  return layout;
}

BodyLayout resolve_layout(const Mechanism& mechanism, const SynthesisResult& synthesis) {
  return plan_body(mechanism, synthesis).layout;
}

}  // namespace fusee
