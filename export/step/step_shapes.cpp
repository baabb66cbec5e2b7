#include "export/step/step_shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "fusee/base.h"
#include "solid/anchors.h"
#include "solid/bore.h"
#include "solid/set_screw.h"
#include "solid/tools.h"

namespace fusee::formats {
namespace {

StepContour contour_of(const Polygon& points) {
  StepContour contour{points.front(), {}};
  for (std::size_t i = 1; i < points.size(); ++i) contour.pieces.push_back({points[i], {}});
  contour.pieces.push_back({points.front(), {}});
  return contour;
}

StepTool prism_between(StepContour contour, double low, double high) {
  StepPrism prism;
  prism.outer = std::move(contour);
  prism.low = std::min(low, high);
  prism.high = std::max(low, high);
  return {{prism}};
}

StepTool cylinder(const Vec2& centre, double radius, double low, double high) {
  return {{StepFrustum{centre, centre, std::min(low, high), std::max(low, high), radius, radius}}};
}

// ---- along the axis -------------------------------------------------------------------------------------------------

/// The bore's outline; its first points may describe an arc about the axis.
StepContour bore_contour(const solid::BoreLayout& bore) {
  if (bore.arc_points < 3) return contour_of(bore.outline);
  const auto last = static_cast<std::ptrdiff_t>(bore.arc_points) - 1;
  StepContour contour{bore.outline.front(), {}};
  contour.pieces.push_back({bore.outline[bore.arc_points - 1], bore.outline[bore.arc_points / 2]});
  for (auto point = bore.outline.begin() + last + 1; point != bore.outline.end(); ++point)
    contour.pieces.push_back({*point, {}});
  contour.pieces.push_back({bore.outline.front(), {}});
  return contour;
}

StepTool bore_between(const solid::BoreLayout& bore, double low, double high) {
  if (bore.circle) return cylinder(bore.circle->centre, 0.5 * bore.circle->diameter, low, high);
  return prism_between(bore_contour(bore), low, high);
}

/// The cone above a horn's recess; for a toothed one with the mesh's facets.
StepTool recess_ceiling(const solid::BoreLayout& bore) {
  const double low = bore.horn_recess, high = low + bore.horn_ceiling;
  if (bore.circle) {
    const solid::RoundHole hole = solid::circle_within(bore.screw_holes.front());
    return {{StepFrustum{hole.centre, hole.centre, low, high, 0.5 * bore.circle->diameter, 0.5 * hole.diameter}}};
  }
  const solid::RecessCone cone = solid::recess_cone(bore);
  return {{solid::strip({solid::at_height(cone.rim, low), solid::at_height(cone.hole, high)})}};
}

void add_bore(std::vector<StepTool>& tools, const solid::BodyLayout& layout) {
  const solid::BoreLayout& bore = layout.bore;
  const double top = layout.z_hub + solid::k_overshoot;
  if (bore.horn_recess > 0) {
    tools.push_back(bore_between(bore, -solid::k_overshoot, bore.horn_recess));
    if (bore.horn_ceiling > 0) tools.push_back(recess_ceiling(bore));
  } else {
    tools.push_back(bore_between(bore, -solid::k_overshoot, top));
  }
  for (std::size_t k = 0; k < bore.screw_holes.size(); ++k) {
    const solid::RoundHole hole = solid::circle_within(bore.screw_holes[k]);
    const bool in_recess = bore.horn_recess > 0 && k == 0;
    constexpr double k_into_recess = 0.5;  // mm, so that no faces coincide
    tools.push_back(cylinder(hole.centre, 0.5 * hole.diameter,
                             in_recess ? bore.horn_recess - k_into_recess : -solid::k_overshoot, top));
  }
}

void add_dowels(std::vector<StepTool>& tools, const solid::DowelLayout& dowels) {
  constexpr double k_tip = 0.05;  // radius at the cone's end per radius of the hole
  const double radius = 0.5 * dowels.hole_diameter;
  for (const Vec2& place : dowels.places) {
    tools.push_back(cylinder(place, radius, -solid::k_overshoot, dowels.z_end));
    if (dowels.ceiling > 0)
      tools.push_back(
          {{StepFrustum{place, place, dowels.z_end, dowels.z_end + dowels.ceiling, radius, k_tip * radius}}});
  }
}

void add_set_screw(std::vector<StepTool>& tools, const solid::BodyLayout& layout) {
  const solid::SetScrewLayout& screw = layout.set_screw;
  if (!screw.present) return;
  const Vec2 out = unit(screw.angle), across = turned_left(out);
  const double radius = 0.5 * screw.hole_diameter;
  StepPrism hole;
  hole.origin = {0, 0, screw.z};
  hole.x = {across.x(), across.y(), 0};
  hole.z = {out.x(), out.y(), 0};
  const Vec2 left = radius * unit(0.5 * k_pi + screw.ceiling_slope),
             right = radius * unit(0.5 * k_pi - screw.ceiling_slope);
  hole.outer = {left, {{right, Vec2(0, -radius)}, {Vec2(0, solid::teardrop_top(screw)), {}}, {left, {}}}};
  hole.high = layout.hub_radius + solid::k_overshoot;
  tools.push_back({{hole}});
  if (!screw.nut_trap) return;
  const Vec2 middle = screw.nut_distance * out;
  const Vec2 along = 0.5 * screw.nut_thickness * out, aside = 0.5 * screw.nut_width * across;
  tools.push_back(prism_between(
      contour_of({middle - along - aside, middle + along - aside, middle + along + aside, middle - along + aside}),
      screw.z - solid::nut_corner(screw), layout.z_hub + solid::k_overshoot));
}

// ---- tie-offs -------------------------------------------------------------------------------------------------------

/// Heights above the groove's plane in print orientation, as z in the part.
struct HeightAxis {
  double plane = 0;
  double up = 1;  ///< −1: the part is printed upside down
  double at(double height) const { return plane + up * height; }
};

/// Appends points of a channel's edge as lines and, on the arc about its bend, as arcs.
void append_edge(StepContour& contour, const Polygon& edge, const solid::ChannelBend& bend, double radius) {
  constexpr double k_on_curve = 1e-7;  // mm
  const auto on_arc = [&](const Vec2& point) { return std::abs((point - bend.centre).norm() - radius) < k_on_curve; };
  const auto is_straight = [&](const Vec2& a, const Vec2& b, const Vec2& c) {
    return std::abs(cross(b - a, c - a)) < k_on_curve * (c - a).norm();
  };
  for (std::size_t i = 1; i < edge.size();) {
    std::size_t end = i;
    if (on_arc(edge[i - 1]) && on_arc(edge[i])) {
      while (end + 1 < edge.size() && on_arc(edge[end + 1])) ++end;
      const Vec2 half = (edge[i - 1] - bend.centre + edge[end] - bend.centre).normalized();
      contour.pieces.push_back({edge[end], Vec2(bend.centre + radius * half)});
    } else {
      while (end + 1 < edge.size() && is_straight(edge[i - 1], edge[end], edge[end + 1]) &&
             !(on_arc(edge[end]) && on_arc(edge[end + 1])))
        ++end;
      contour.pieces.push_back({edge[end], {}});
    }
    i = end + 1;
  }
}

/// Both edges of a channel, cut at the end of its bend.
struct ChannelPlan {
  StepContour bent;
  StepContour straight;
};

ChannelPlan plan_of(const solid::Anchor& anchor, double half_width) {
  const solid::ChannelBend& bend = *anchor.bend;
  const auto half = static_cast<std::ptrdiff_t>(anchor.entry.size() / 2);
  const Polygon outer(anchor.entry.begin(), anchor.entry.begin() + half);
  const Polygon inner(anchor.entry.rbegin(), anchor.entry.rbegin() + half);
  // The inner edge is an arc, whose last point has the index `arc`, and a straight.
  std::size_t arc = 0;
  const double inner_radius = bend.radius - half_width;
  while (arc + 1 < inner.size() && std::abs((inner[arc + 1] - bend.centre).norm() - inner_radius) < 1e-7) ++arc;
  const auto cut = static_cast<std::ptrdiff_t>(arc);
  const auto closed = [&](const Polygon& out, const Polygon& in) {
    StepContour contour{out.front(), {}};
    append_edge(contour, out, bend, bend.radius + half_width);
    contour.pieces.push_back({in.back(), {}});
    append_edge(contour, Polygon(in.rbegin(), in.rend()), bend, inner_radius);
    contour.pieces.push_back({out.front(), {}});
    return contour;
  };
  ChannelPlan plan;
  plan.bent = closed(Polygon(outer.begin(), outer.begin() + cut + 1), Polygon(inner.begin(), inner.begin() + cut + 1));
  if (cut + 1 < half)
    plan.straight = closed(Polygon(outer.begin() + cut, outer.end()), Polygon(inner.begin() + cut, inner.end()));
  return plan;
}

/// Direction across the straight, away from the bend's centre.
Vec2 away_from_bend(const solid::Anchor& anchor) {
  return (anchor.pocket - anchor.bend->straight * anchor.bend->heading - anchor.bend->centre).normalized();
}

/// The channel's ceiling rises from the inner wall outwards: a cone about the bend's centre, and a plane.
void add_channel(std::vector<StepTool>& tools, const solid::Anchor& anchor, const solid::BodyLayout& layout,
                 const HeightAxis& z) {
  const solid::ChannelBend& bend = *anchor.bend;
  const double width = layout.channel_width, half = bend.half_height;
  const double slope = layout.channel_ceiling / width;
  const ChannelPlan plan = plan_of(anchor, 0.5 * width);
  double reach = 0;
  for (const Vec2& point : anchor.entry) reach = std::max(reach, (point - bend.centre).norm());
  const double far = reach + 1, inner = bend.radius - 0.5 * width;
  const double highest = half + slope * (far - inner) + 1;
  StepTool bent = prism_between(plan.bent, z.at(-half), z.at(slope > 0 ? highest : half));
  if (slope > 0) {
    // The section to turn exceeds the prism by 1 mm below and outside. Its sloped top is the ceiling.
    const double near = 0.5 * inner;
    const auto corner = [&](double radius, double height) { return Vec2(radius, z.at(height)); };
    bent.common.push_back(
        StepTurned{bend.centre,
                   {corner(near, -half - 1), corner(far, -half - 1), corner(far, half + slope * (far - inner)),
                    corner(near, half + slope * (near - inner))},
                   0,
                   k_two_pi});
  }
  tools.push_back(std::move(bent));
  if (plan.straight.pieces.empty()) return;
  StepTool straight = prism_between(plan.straight, z.at(-half), z.at(slope > 0 ? highest : half));
  if (slope > 0) {
    const Vec2 outer = away_from_bend(anchor), on_wall = bend.centre + inner * outer;
    const Vec3 point(on_wall.x(), on_wall.y(), z.at(half));
    std::get<StepPrism>(straight.common.front()).ceiling =
        StepPrism::Ceiling{point, Vec3(-slope * outer.x(), -slope * outer.y(), z.up)};
  }
  tools.push_back(std::move(straight));
}

/// A circle, with a tab at the channel's end if the channel's slope would meet the circle too sharply.
StepContour pocket_contour(const solid::Anchor& anchor, const solid::BodyLayout& layout) {
  const solid::ChannelBend& bend = *anchor.bend;
  const double radius = layout.pocket_radius;
  const Vec2 outer = away_from_bend(anchor);
  const auto place = [&](double along, double across) -> Vec2 {
    return anchor.pocket + along * bend.heading + across * outer;
  };
  if (!(layout.channel_ceiling > 0 && bend.straight > radius + solid::k_pocket_excess))
    return {place(radius, 0), {{place(-radius, 0), place(0, radius)}, {place(radius, 0), place(0, -radius)}}};
  const double half = solid::half_tab(layout.channel_width, radius), behind = std::sqrt(radius * radius - half * half);
  return {place(-behind, half),
          {{place(-radius - solid::k_pocket_excess, half), {}},
           {place(-radius - solid::k_pocket_excess, -half), {}},
           {place(-behind, -half), {}},
           {place(-behind, half), place(radius, 0)}}};
}

void add_pocket(std::vector<StepTool>& tools, const solid::Anchor& anchor, const solid::BodyLayout& layout,
                const HeightAxis& z) {
  const bool left = anchor.side == transmission::Side::left, turned = left && layout.parts == Parts::two;
  const double closed = anchor.bend->half_height + solid::k_pocket_excess;
  // A pocket that opens upwards in print orientation requires no ceiling.
  if (turned || !left) {
    const double open = (left ? layout.z_p1 : layout.z_hub - layout.z_p2) + solid::k_overshoot;
    tools.push_back(prism_between(pocket_contour(anchor, layout), z.at(-closed), z.at(open)));
    return;
  }
  StepTool tool = prism_between(pocket_contour(anchor, layout), z.at(-layout.z_p1 - solid::k_overshoot),
                                z.at(closed + layout.pocket_ceiling + 1));
  const double slope = 0.5 * layout.pocket_ceiling / layout.pocket_radius;
  const Vec2 outer = away_from_bend(anchor);
  auto& prism = std::get<StepPrism>(tool.common.front());
  if (slope > 0)
    prism.ceiling =
        StepPrism::Ceiling{Vec3(anchor.pocket.x(), anchor.pocket.y(), z.at(closed + 0.5 * layout.pocket_ceiling)),
                           Vec3(-slope * outer.x(), -slope * outer.y(), 1)};
  else
    prism.high = z.at(closed);
  tools.push_back(std::move(tool));
}

/// Depths below a face, as z in the part.
struct DepthAxis {
  double face = 0;
  double in = 1;  ///< +1: depths grow upwards; −1: downwards
  double at(double depth) const { return face + in * depth; }
};

DepthAxis from_face(transmission::Side side, const solid::BodyLayout& layout) {
  return side == transmission::Side::left ? DepthAxis{0, 1} : DepthAxis{layout.z_top, -1};
}

void add_face_hole(std::vector<StepTool>& tools, const solid::Anchor& anchor, const solid::BodyLayout& layout) {
  // The slot ends past the groove's plane, mm. The countersink ends within the slot's round end, at this share of its
  // radius. Both avoid faces that coincide.
  constexpr double k_past_plane = 0.03, k_share = 0.9;
  const solid::FaceSeat& seat = *anchor.seat;
  const bool left = anchor.side == transmission::Side::left;
  const DepthAxis face = from_face(anchor.side, layout);
  const double outside = solid::k_overshoot + (left ? 0.0 : layout.z_hub - layout.z_top);
  const double to_groove = left ? layout.z_p1 : layout.z_top - layout.z_p2;
  const Polygon& slot = anchor.channel;
  const Vec2 normal = (slot.back() - slot.front()).normalized();
  const double radius = 0.5 * layout.channel_width;
  const Vec2 first = seat.hole + radius * turned_left(normal), second = seat.hole - radius * turned_left(normal);
  const StepContour contour{first,
                            {{second, Vec2(seat.hole - radius * normal)},
                             {second + seat.length * normal, {}},
                             {first + seat.length * normal, {}},
                             {first, {}}}};
  tools.push_back(prism_between(contour, face.at(-outside), face.at(to_groove + k_past_plane)));
  if (seat.depth <= 0) return;
  // A cone with the slope of the countersink would require twice this additional depth to narrow to that share.
  const double deeper = seat.depth * (1.0 + 0.5 * (1.0 - k_share) * radius / (seat.radius - radius));
  tools.push_back(cylinder(anchor.pocket, seat.radius, face.at(-0.5 * solid::k_overshoot - outside), face.at(0)));
  StepFrustum sunk{anchor.pocket, seat.hole, face.at(0), face.at(deeper), seat.radius, k_share * radius};
  if (!left) {
    std::swap(sunk.low_centre, sunk.high_centre);
    std::swap(sunk.low, sunk.high);
    std::swap(sunk.low_radius, sunk.high_radius);
  }
  tools.push_back({{sunk}});
}

void add_tail(std::vector<StepTool>& tools, const solid::Anchor& anchor, const solid::BodyLayout& layout) {
  const solid::TailSlot& slot = *anchor.tail;
  const DepthAxis face = from_face(anchor.side, layout);
  const Vec2 along = (slot.to - slot.from).normalized(), across = turned_left(along);
  StepPrism prism;
  prism.origin = {slot.from.x(), slot.from.y(), face.face};
  prism.x = {across.x(), across.y(), 0};
  prism.z = {along.x(), along.y(), 0};
  const double half = 0.5 * slot.width;
  Polygon section{
      {-half, -face.in * solid::k_overshoot}, {half, -face.in * solid::k_overshoot}, {half, face.in * slot.depth}};
  if (slot.ceiling > 0) section.emplace_back(0, face.in * (slot.depth + slot.ceiling));
  section.emplace_back(-half, face.in * slot.depth);
  prism.outer = contour_of(section);
  prism.high = (slot.to - slot.from).norm();
  tools.push_back({{prism}});
  if (slot.pilot_diameter > 0)
    tools.push_back(
        cylinder(slot.to, 0.5 * slot.pilot_diameter, face.at(-solid::k_overshoot), face.at(slot.pilot_depth)));
}

StepTool mark_tool(const solid::Mark& mark, double low, double high) {
  StepTool tool = prism_between(contour_of(mark.loops.front()), low, high);
  for (std::size_t k = 1; k < mark.loops.size(); ++k)
    std::get<StepPrism>(tool.common.front()).inner.push_back(contour_of(mark.loops[k]));
  return tool;
}

double facets_beyond_circle(double diameter) {
  const double radius = 0.5 * diameter;
  return std::abs(signed_area(solid::polyhole(diameter, Vec2::Zero()))) - k_pi * radius * radius;
}

}  // namespace

std::vector<StepTool> step_cuts(const Mechanism& mechanism, const solid::Pulley& pulley) {
  const solid::BodyLayout& layout = pulley.layout;
  std::vector<StepTool> tools;
  add_bore(tools, layout);
  add_dowels(tools, layout.dowels);
  add_set_screw(tools, layout);
  for (const solid::Anchor& anchor : pulley.anchors) {
    const bool left = anchor.side == transmission::Side::left;
    const HeightAxis z{left ? layout.z_p1 : layout.z_p2, left && layout.parts == Parts::two ? -1.0 : 1.0};
    if (anchor.seat) add_face_hole(tools, anchor, layout);
    if (anchor.bend) {
      add_channel(tools, anchor, layout, z);
      if (layout.pocket_radius > 0) add_pocket(tools, anchor, layout, z);
    }
    if (anchor.tail) add_tail(tools, anchor, layout);
  }
  const double depth = layout.mark_depth;
  for (const solid::Mark& mark : pulley.marks) {
    if (!mark.on_top) tools.push_back(mark_tool(mark, -solid::k_overshoot, depth));
    if (mark.on_top && mechanism.body.marks == Marks::engraved)
      tools.push_back(mark_tool(mark, layout.z_top - depth, layout.z_top + solid::k_overshoot));
  }
  return tools;
}

std::vector<StepTool> step_raised(const Mechanism& mechanism, const solid::Pulley& pulley) {
  const solid::BodyLayout& layout = pulley.layout;
  std::vector<StepTool> raised;
  if (mechanism.body.marks != Marks::raised) return raised;
  for (const solid::Mark& mark : pulley.marks) {
    if (mark.on_top)
      raised.push_back(
          mark_tool(mark, layout.z_top - 0.5 * layout.flange_thickness, layout.z_top + mechanism.body.mark_depth));
  }
  return raised;
}

double round_hole_excess(const solid::Pulley& pulley) {
  const solid::BodyLayout& layout = pulley.layout;
  const solid::BoreLayout& bore = layout.bore;
  double volume = 0;
  if (bore.circle)
    volume += facets_beyond_circle(bore.circle->diameter) * (bore.horn_recess > 0 ? bore.horn_recess : layout.z_hub);
  for (std::size_t k = 0; k < bore.screw_holes.size(); ++k) {
    const double below = bore.horn_recess > 0 && k == 0 ? bore.horn_recess + bore.horn_ceiling : 0;
    volume += facets_beyond_circle(solid::circle_within(bore.screw_holes[k]).diameter) * (layout.z_hub - below);
  }
  for (std::size_t k = 0; k < layout.dowels.places.size(); ++k)
    volume += facets_beyond_circle(layout.dowels.hole_diameter) * layout.dowels.z_end;
  for (const solid::Anchor& anchor : pulley.anchors) {
    if (anchor.tail && anchor.tail->pilot_diameter > 0)
      volume += facets_beyond_circle(anchor.tail->pilot_diameter) * anchor.tail->pilot_depth;
  }
  return volume;
}

}  // namespace fusee::formats
