#include "solid/heights.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "fusee/base.h"
#include "solid/bore.h"
#include "solid/channel_entries.h"
#include "solid/groove.h"
#include "solid/tie_offs.h"

namespace fusee::solid {
namespace {

// Size of the groove edge that the chamfer at the bed must leave, outwards and upwards.
constexpr double k_least_groove_edge = 0.2;

// Flange thickness above a channel's ceiling.
constexpr double k_over_channel = 0.3;

// The chamfer is a printing aid, limited by the size of the flange's edge.
void choose_elephant_foot(BodyLayout& layout, double wanted) {
  const double outward = layout.groove_depth - k_least_groove_edge;
  const double upward = (layout.flange_thickness - k_least_groove_edge) / rise_of(layout, 1.0);
  layout.elephant_foot = std::clamp(std::min(outward, upward), 0.0, wanted);
  if (layout.elephant_foot < wanted) {
    layout.notes.push_back(
        fmt::format("the groove edge is too small for a chamfer of {} mm at the bed: reduced to {} mm", rounded(wanted),
                    rounded(layout.elephant_foot, 3)));
  }
}

// The half of a groove that is above during printing needs the slope of a ceiling. P1 alone is printed upside down.
void choose_walls(BodyLayout& layout, const Mechanism& mechanism) {
  const double lean = 0.5 * mechanism.body.groove_angle;
  const auto half = [&](double angle) {
    return groove_half(mechanism.body, angle, mechanism.tendon.diameter, layout.groove_depth);
  };
  const std::vector<GroovePoint> lower = half(lean), ceiling = half(std::max(lean, layout.ceiling_slope));
  layout.p2 = {lower, ceiling};
  layout.p1 = layout.parts == Parts::two ? GrooveWalls{ceiling, lower} : GrooveWalls{lower, ceiling};
}

void choose_cones(BodyLayout& layout, const FlangeRims& rims) {
  if (layout.ceiling_slope <= 0) return;
  layout.upper_cone = cone_height(rims.groove_edge2, rims.upper, layout.ceiling_slope);
  if (layout.parts == Parts::two) {
    layout.lower_cone = cone_height(rims.groove_edge1, rims.lower, layout.ceiling_slope);
  } else {
    layout.middle_cone = cone_height(rims.groove_edge1, rims.middle, layout.ceiling_slope);
  }
}

// A flange has the requested thickness at the groove edge and is thicker where a channel's ceiling requires it.
void stack_up(BodyLayout& layout) {
  const double flange = layout.flange_thickness;
  const bool apart = layout.parts == Parts::two;
  const double over_entry = layout.ceiling_slope > 0 ? entry_rise(layout) + k_over_channel : 0.0;
  const double ceiling_flange = std::max(flange, over_entry);
  const double over_channel = 0.5 * layout.channel_width + layout.channel_ceiling + k_over_channel;
  layout.z_p1 = (apart ? ceiling_flange : flange) + layout.lower_cone + layout.p1.below_width();
  if (apart) layout.z_p1 = std::max(layout.z_p1, over_channel);
  layout.z_middle = layout.z_p1 + layout.p1.above_width() + layout.middle_cone;
  layout.z_mate = layout.z_middle + (apart ? flange : ceiling_flange);
  if (!apart) layout.z_mate = std::max(layout.z_mate, layout.z_p1 + over_channel);
  layout.z_p2 = layout.z_mate + (apart ? flange : 0.0) + layout.p2.below_width();
  layout.z_top = layout.z_p2 + std::max(layout.p2.above_width() + layout.upper_cone + ceiling_flange, over_channel);
  layout.z_hub = layout.z_top;
}

// Engraving leaves at least two layers of a flange, or half of a thin one. Deeper marks would open into the groove.
void choose_mark_depth(BodyLayout& layout, const Body& body) {
  constexpr double k_least_rest = 0.4;  // mm
  const double most = std::max(0.5 * layout.flange_thickness, layout.flange_thickness - k_least_rest);
  layout.mark_depth = std::min(body.mark_depth, most);
  if (layout.mark_depth == body.mark_depth || body.marks == Marks::none) return;
  layout.notes.push_back(
      fmt::format("marks {} mm deep (body.mark_depth_mm) would cut through a flange of {} mm: engraved {} mm deep",
                  rounded(body.mark_depth), rounded(layout.flange_thickness), rounded(most, 3)));
}

// Moves everything above the middle flange up.
void thicken_middle(BodyLayout& layout, double by) {
  if (by <= 0) return;
  for (double* z : {&layout.z_mate, &layout.z_p2, &layout.z_top, &layout.z_hub}) *z += by;
  if (layout.set_screw.present) layout.set_screw.z += by;
}

}  // namespace

BodyLayout axial_layout(const Mechanism& mechanism, const FlangeRims& rims, Parts parts, double entry_lean) {
  BodyLayout layout;
  layout.parts = parts;
  layout.entry_lean = entry_lean;
  layout.tendon_diameter = mechanism.tendon.diameter;
  layout.ceiling_slope = mechanism.print.supports ? 0.0 : mechanism.print.overhang + k_slope_margin;
  layout.groove_depth = mechanism.groove_depth();
  layout.flange_thickness = mechanism.body.flange_thickness;
  choose_mark_depth(layout, mechanism.body);
  layout.scale = 1.0 / (1.0 - mechanism.material.shrinkage);
  choose_walls(layout, mechanism);
  choose_cones(layout, rims);
  choose_channel(layout, mechanism);
  if (layout.ceiling_slope > 0) layout.channel_ceiling = rise_of(layout, layout.channel_width);
  choose_elephant_foot(layout, mechanism.material.elephant_foot);
  stack_up(layout);
  return layout;
}

void add_pocket_ceiling(BodyLayout& layout) {
  if (layout.parts == Parts::two || layout.ceiling_slope <= 0) return;
  layout.pocket_ceiling = rise_of(layout, 2.0 * layout.pocket_radius);
  thicken_middle(layout,
                 layout.z_p1 + 0.5 * layout.channel_width + layout.pocket_ceiling + layout.min_wall - layout.z_mate);
}

void add_recess_ceiling(BodyLayout& layout) {
  BoreLayout& bore = layout.bore;
  if (layout.ceiling_slope <= 0 || bore.horn_recess <= 0) return;
  bore.horn_ceiling = rise_of(layout, recess_cone(bore).travel);
}

}  // namespace fusee::solid
