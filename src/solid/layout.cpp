#include "fusee/solid/layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "fusee/base/text.h"
#include "solid/groove.h"
#include "solid/plan.h"

namespace fusee {
namespace {

// What the chamfer at the bed leaves of the lip, outwards and upwards.
constexpr double k_lip_left = 0.2;

// A printing aid, no dimension: as much of it as the lower flange's lip bears.
void choose_elephant_foot(BodyLayout& layout, double wanted) {
  layout.elephant_foot = std::clamp(std::min(layout.groove_depth, layout.flange_thickness) - k_lip_left, 0.0, wanted);
  if (layout.elephant_foot < wanted) {
    layout.notes.push_back(fmt::format("the lip is too small for a chamfer of {} mm at the bed: made {} mm",
                                       rounded(wanted), rounded(layout.elephant_foot)));
  }
}

}  // namespace

RoundHole circle_within(const Polygon& facets) {
  const Vec2 centre = std::accumulate(facets.begin(), facets.end(), Vec2(0, 0)) / static_cast<double>(facets.size());
  return {centre, 2.0 * distance_to_edges(facets, centre)};
}

BodyLayout axial_layout(const Mechanism& mechanism) {
  const double d = mechanism.tendon.diameter;
  BodyLayout layout;
  layout.groove_depth = mechanism.groove_depth();
  layout.groove = groove_section(mechanism.body, d, layout.groove_depth);
  layout.groove_half_width = layout.groove.back().dz;
  layout.flange_thickness = mechanism.body.flange_thickness;
  const double half = layout.groove_half_width, flange = layout.flange_thickness;
  layout.z_p1 = flange + half;
  layout.z_p2 = layout.z_p1 + 2.0 * half + flange;
  layout.z_top = layout.z_p2 + half + flange;
  layout.z_hub = layout.z_top;
  choose_elephant_foot(layout, mechanism.material.elephant_foot);
  layout.mark_depth = mechanism.body.mark_depth;
  layout.scale = 1.0 / (1.0 - mechanism.material.shrinkage);
  return layout;
}

BodyLayout resolve_layout(const Mechanism& mechanism, const SynthesisResult& synthesis) {
  return plan_body(mechanism, synthesis).layout;
}

}  // namespace fusee
