#include "solid/heights.h"

#include <fmt/format.h>

#include <algorithm>

#include "fusee/base/text.h"
#include "fusee/base/units.h"
#include "solid/bore.h"
#include "solid/groove.h"

namespace fusee {
namespace {

// Roofs are made steeper than the flattest slope by this: slicers take a slope of up to a degree more for too flat
// (PrusaSlicer 2.5 supports 45.5° at a threshold of 45°, and 46° no longer), and coordinates are floats.
constexpr double k_slope_margin = radians(1.5);
// What the chamfer at the bed leaves of the lip, outwards and upwards.
constexpr double k_lip_left = 0.2;

// A printing aid, no dimension: as much of it as the flange's lip bears.
void choose_elephant_foot(BodyLayout& layout, double wanted) {
  const double outward = layout.groove_depth - k_lip_left;
  const double upward = (layout.flange_thickness - k_lip_left) / rise_of(layout, 1.0);
  layout.elephant_foot = std::clamp(std::min(outward, upward), 0.0, wanted);
  if (layout.elephant_foot < wanted) {
    layout.notes.push_back(fmt::format("the lip is too small for a chamfer of {} mm at the bed: made {} mm",
                                       rounded(wanted), rounded(layout.elephant_foot, 3)));
  }
}

// P1 is printed turned over where it is printed for itself.
void choose_walls(BodyLayout& layout, const Mechanism& mechanism) {
  const double lean = 0.5 * mechanism.body.groove_angle;
  const auto half = [&](double angle) {
    return groove_half(mechanism.body, angle, mechanism.tendon.diameter, layout.groove_depth);
  };
  const std::vector<GroovePoint> ground = half(lean), roof = half(std::max(lean, layout.roof_slope));
  layout.p2 = {ground, roof};
  layout.p1 = layout.parts == Parts::two ? GrooveWalls{roof, ground} : GrooveWalls{ground, roof};
}

void choose_cones(BodyLayout& layout, const FlangeRims& rims) {
  if (layout.roof_slope <= 0) return;
  layout.upper_cone = cone_height(rims.lip2, rims.upper, layout.roof_slope);
  if (layout.parts == Parts::two) {
    layout.lower_cone = cone_height(rims.lip1, rims.lower, layout.roof_slope);
  } else {
    layout.middle_cone = cone_height(rims.lip1, rims.middle, layout.roof_slope);
  }
}

void stack_up(BodyLayout& layout) {
  const double flange = layout.flange_thickness;
  layout.z_p1 = flange + layout.lower_cone + layout.p1.below_width();
  layout.z_middle = layout.z_p1 + layout.p1.above_width() + layout.middle_cone;
  layout.z_mate = layout.z_middle + flange;
  const double lip2 = layout.parts == Parts::two ? layout.z_mate + flange : layout.z_mate;
  layout.z_p2 = lip2 + layout.p2.below_width();
  layout.z_top = layout.z_p2 + layout.p2.above_width() + layout.upper_cone + flange;
  layout.z_hub = layout.z_top;
}

// Moves all that stands on the middle flange up.
void thicken_middle(BodyLayout& layout, double by) {
  for (double* z : {&layout.z_mate, &layout.z_p2, &layout.z_top, &layout.z_hub}) *z += by;
  if (layout.set_screw.present) layout.set_screw.z += by;
}

}  // namespace

BodyLayout axial_layout(const Mechanism& mechanism, const FlangeRims& rims, Parts parts) {
  BodyLayout layout;
  layout.parts = parts;
  layout.roof_slope = mechanism.print.supports ? 0.0 : mechanism.print.overhang + k_slope_margin;
  layout.groove_depth = mechanism.groove_depth();
  layout.flange_thickness = mechanism.body.flange_thickness;
  layout.mark_depth = mechanism.body.mark_depth;
  layout.scale = 1.0 / (1.0 - mechanism.material.shrinkage);
  choose_walls(layout, mechanism);
  choose_cones(layout, rims);
  choose_elephant_foot(layout, mechanism.material.elephant_foot);
  stack_up(layout);
  return layout;
}

void roof_pockets(BodyLayout& layout) {
  const double ledge = layout.pocket_radius - 0.5 * k_longest_bridge;
  if (layout.parts == Parts::two || layout.roof_slope <= 0 || ledge <= 0) return;
  // A little of the bridge is kept for the facets.
  layout.pocket_roof = rise_of(layout, ledge + 0.1);
  const double top = layout.z_p1 + 0.5 * layout.channel_width + layout.pocket_roof + layout.min_wall;
  thicken_middle(layout, std::max(0.0, top - layout.z_mate));
}

void roof_recess(BodyLayout& layout) {
  const BoreLayout& bore = layout.bore;
  if (layout.roof_slope <= 0 || bore.horn_recess <= 0) return;
  layout.bore.horn_roof = rise_of(layout, circumradius(bore.outline) * (1.0 - recess_roof_share(bore)));
}

}  // namespace fusee
