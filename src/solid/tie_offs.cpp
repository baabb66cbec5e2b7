#include "solid/tie_offs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/thread_pool.h"
#include "fusee/base.h"
#include "solid/face_holes.h"

namespace fusee::solid {
namespace {

// Clearance of a tendon in an automatic channel, on the diameter, mm.
constexpr double k_channel_clearance = 0.3;
// A narrower automatic channel would close in printing. mm
constexpr double k_least_channel = 0.6;
// Radius of a channel's fillet in tendon diameters, and its least value in channel widths.
constexpr double k_fillet_ratio = 2.0;
constexpr double k_least_fillet_ratio = 0.75;
// Least pocket radius in channel widths: the knot would be pulled through a smaller one.
constexpr double k_least_pocket = 0.55;
// Radius of an automatic pocket in tendon diameters, and its least value, on a thin tendon, in channel widths.
constexpr double k_pocket_ratio = 1.75;
constexpr double k_thin_pocket = 0.85;
// Gap between a pocket and the hub, which avoids a sliver. mm
constexpr double k_hub_gap = 0.4;

// Step of wrap at which a load-carrying tie-off is tried, from the far end of the closing arc.
constexpr double k_wrap_step = radians(5);
// Angle on both sides of a rejected tie-off within which none is planned again.
constexpr double k_rejected_around = radians(9);

// Prefers a channel near its end of the arc. The channel of a load-carrying tie-off may also pass the axis.
std::optional<AnchorPath> anchor_at(const AnchorSite& site, bool wound_end, double wanted, const LapRange& laps) {
  auto path = find_anchor(site, wound_end, wanted, AnchorReach::near, laps);
  if (!wound_end || (path && path->room >= wanted)) return path;
  return find_anchor(site, wound_end, wanted, AnchorReach::anywhere, laps);
}

// A property that both kinds of tie-off have.
template <typename Property>
auto property_of(const TieOff& tie_off, const Property& property) {
  return std::visit(property, tie_off);
}
double room_of(const TieOff& tie_off) {
  return property_of(tie_off, [](const auto& found) { return found.room; });
}
double lap_of(const TieOff& tie_off) {
  return property_of(tie_off, [](const auto& found) { return found.lap; });
}
double wrap_of(const TieOff& tie_off) {
  return property_of(tie_off, [](const auto& found) { return found.wrap; });
}
Vec2 pocket_of(const TieOff& tie_off) {
  return property_of(tie_off, [](const auto& found) { return found.pocket(); });
}
bool is_channel(const TieOff& tie_off) { return std::holds_alternative<AnchorPath>(tie_off); }

double pocket_radius_of(const TieOff& tie_off, const BodyLayout& layout) {
  return is_channel(tie_off) ? layout.pocket_radius : room_of(tie_off);
}

// True if a pocket overlaps the hub in plan.
bool cuts_into(const BodyLayout& layout, const TieOff& tie_off) {
  return pocket_of(tie_off).norm() < layout.hub_radius + pocket_radius_of(tie_off, layout);
}

std::vector<Bar> bars_of(const TieOff& tie_off, const BodyLayout& layout) {
  std::vector<Bar> bars =
      property_of(tie_off, [&layout](const auto& found) { return found.bars(layout.channel_width); });
  bars.push_back({pocket_of(tie_off), pocket_of(tie_off), pocket_radius_of(tie_off, layout)});
  return bars;
}

// Number of pockets that cut into the hub.
int count_cuts_into_hub(const BodyLayout& layout, const TieOffPair& pair) {
  return int{cuts_into(layout, pair.wound)} + int{pair.spare && cuts_into(layout, *pair.spare)};
}

// On a shaft with a flat the set screw cannot be turned away from a pocket.
bool blocks_set_screw(const BodyLayout& layout, const TieOffPair& pair) {
  if (!layout.set_screw.present || layout.bore.kind == Bore::round) return false;
  const auto blocks = [&layout](const TieOff& tie_off) {
    return !clears_set_screw(layout, layout.set_screw.angle, tie_off);
  };
  return blocks(pair.wound) || (pair.spare && blocks(*pair.spare));
}

}  // namespace

Vec2 PlannedAnchor::start() const {
  return property_of(tie_off, [](const auto& found) { return found.start; });
}
Vec2 PlannedAnchor::pocket() const { return pocket_of(tie_off); }
double PlannedAnchor::pocket_radius(const BodyLayout& layout) const { return pocket_radius_of(tie_off, layout); }
bool PlannedAnchor::cuts_into_hub(const BodyLayout& layout) const {
  return side == transmission::Side::right && cuts_into(layout, tie_off);
}
double PlannedAnchor::wrap() const { return wrap_of(tie_off); }
std::vector<Bar> PlannedAnchor::bars(const BodyLayout& layout) const { return bars_of(tie_off, layout); }

bool clears_set_screw(const BodyLayout& layout, double angle, const TieOff& tie_off) {
  const SetScrewLayout& screw = layout.set_screw;
  const Bar bar{Vec2::Zero(), layout.hub_radius * unit(angle), 0.5 * std::max(screw.hole_diameter, screw.nut_width)};
  return gap({pocket_of(tie_off), pocket_of(tie_off), pocket_radius_of(tie_off, layout)}, bar) >=
         std::min(layout.min_wall, 1.0);
}

void choose_channel(BodyLayout& layout, const Mechanism& mechanism) {
  const double d = mechanism.tendon.diameter;
  layout.channel_width =
      mechanism.body.anchor_hole > 0 ? mechanism.body.anchor_hole : std::max(d + k_channel_clearance, k_least_channel);
  layout.channel_fillet = std::max(k_fillet_ratio * d, k_least_fillet_ratio * layout.channel_width);
}

double TieOffPlanner::wanted_pocket(const BodyLayout& layout) const {
  if (mechanism_.body.knot_pocket > 0) return 0.5 * mechanism_.body.knot_pocket;
  return std::max(k_pocket_ratio * mechanism_.tendon.diameter, k_thin_pocket * layout.channel_width);
}

double TieOffPlanner::least_pocket(const BodyLayout& layout) const {
  return mechanism_.body.knot_pocket > 0 ? wanted_pocket(layout) : k_least_pocket * layout.channel_width;
}

AnchorSite TieOffPlanner::site(const BodyLayout& layout, const AnchorGround& ground) const {
  AnchorSite site{ground, mechanism_.tendon.diameter, layout.channel_width, layout.channel_fillet, layout.min_wall, {},
                  {}};
  site.rim = ground.outline().side == transmission::Side::left ? &rims_.lower : &rims_.upper;
  site.holes.push_back({Vec2::Zero(), Vec2::Zero(), layout.bore.radius});
  for (const Polygon& hole : layout.bore.screw_holes) {
    Vec2 centre = Vec2::Zero();
    for (const Vec2& point : hole) centre += point / static_cast<double>(hole.size());
    site.holes.push_back({centre, centre, (hole.front() - centre).norm()});
  }
  return site;
}

std::optional<AnchorPath> TieOffPlanner::channel(AnchorSite site, const BodyLayout& layout, bool wound_end,
                                                 double wanted, const LapRange& laps) const {
  // P2's pockets open on the face that the hub stands on. They avoid the hub if possible and otherwise cut into its
  // side.
  if (site.ground.outline().side == transmission::Side::right && layout.hub_radius > 0) {
    // The search adds the least wall, which is not required towards the hub.
    site.above_pocket.push_back({Vec2::Zero(), Vec2::Zero(), layout.hub_radius + k_hub_gap - layout.min_wall});
    if (auto path = anchor_at(site, wound_end, wanted, laps); path && path->room >= least_pocket(layout)) return path;
    site.above_pocket.clear();
  }
  return anchor_at(site, wound_end, wanted, laps);
}

std::optional<TieOff> TieOffPlanner::tie_off(const AnchorSite& site, const BodyLayout& layout, bool wound_end,
                                             double wanted, const LapRange& laps) const {
  const auto path = channel(site, layout, wound_end, wanted, laps);
  if (face_holes_ && !(path && path->room >= least_pocket(layout))) {
    if (const auto hole = find_face_hole(site, layout, wound_end, wanted, laps)) return hole;
  }
  return path;
}

WoundTieOffs TieOffPlanner::wound(const BodyLayout& layout) const {
  const auto at_wound_end = [&](const AnchorGround& ground) {
    const LapRange laps = ground.lap_range(true, mechanism_.body.wrap);
    return tie_off(site(layout, ground), layout, true, wanted_pocket(layout), laps);
  };
  return {at_wound_end(ground1_), at_wound_end(ground2_)};
}

bool TieOffPlanner::has_room(const BodyLayout& layout, const WoundTieOffs& wound) const {
  const auto enough = [&](const TieOff& tie_off) {
    return !is_channel(tie_off) || room_of(tie_off) >= least_pocket(layout);
  };
  return wound.both() && enough(*wound.p1) && enough(*wound.p2);
}

void TieOffPlanner::settle_pockets(BodyLayout& layout, const WoundTieOffs& wound) const {
  const double wanted = wanted_pocket(layout);
  layout.pocket_radius = wanted;
  if (!wound.both()) return;
  for (const TieOff& tie_off : {*wound.p1, *wound.p2}) {
    if (is_channel(tie_off)) layout.pocket_radius = std::min(layout.pocket_radius, room_of(tie_off));
  }
  if (mechanism_.body.knot_pocket <= 0 && layout.pocket_radius < wanted) {
    layout.omit("knot_pocket", fmt::format("no space for knot pockets of {:.2f} mm: reduced to {:.2f} mm", 2.0 * wanted,
                                           2.0 * layout.pocket_radius));
  }
}

std::vector<PlannedAnchor> TieOffPlanner::all(BodyLayout& layout, const WoundTieOffs& wound) const {
  std::vector<PlannedAnchor> anchors;
  if (!wound.both()) return anchors;
  // Both searches are independent. Without a search for the furthest, they end before a thread would have started.
  const bool takes_long = mechanism_.body.wrap <= 0 && wishes_.wrap == WrapChoice::furthest;
  auto search_p2 = run_async([&] { return wrapped_furthest(layout, ground2_, *wound.p2); }, takes_long);
  const TieOffPair pair1 = wrapped_furthest(layout, ground1_, *wound.p1);
  const TieOffPair pair2 = search_p2.get();
  add(anchors, layout, ground1_, pair1);
  add(anchors, layout, ground2_, pair2);
  return anchors;
}

void TieOffPlanner::add(std::vector<PlannedAnchor>& anchors, BodyLayout& layout, const AnchorGround& ground,
                        const TieOffPair& pair) const {
  anchors.push_back({ground.outline().side, true, pair.wound, {}});
  if (!is_channel(pair.wound)) {
    const std::string_view name = transmission::pulley_name(ground.outline().side);
    layout.omit(fmt::format("channel_{}", name),
                fmt::format("no space on {} for a tie-off's channel and pocket: the tendon goes through a slot "
                            "to the face",
                            name));
  }
  if (pair.spare) {
    anchors.push_back({ground.outline().side, false, *pair.spare, {}});
  } else {
    const std::string_view name = transmission::pulley_name(ground.outline().side);
    layout.omit(fmt::format("spare_tie_off_{}", name),
                fmt::format("no space for a spare tie-off on {}: omitted", name));
  }
}

// A place near a rejected one is rejected as well. A spare tie-off has only one place.
bool TieOffPlanner::is_rejected(transmission::Side side, bool wound_end, double wrap) const {
  return std::any_of(wishes_.rejected.begin(), wishes_.rejected.end(), [&](const Rejection& rejection) {
    return !rejection.tail && rejection.side == side && rejection.wound_end == wound_end &&
           (!wound_end || std::abs(rejection.wrap - wrap) < k_rejected_around);
  });
}

// Wrap reduces the knot's load by e^(−μφ). The tie-off therefore goes as far round the closing arc as the spare one
// permits, but not into the hub with the set screw.
TieOffPair TieOffPlanner::wrapped_furthest(const BodyLayout& layout, const AnchorGround& ground,
                                           const TieOff& first) const {
  const TieOffPair nearest{first, spare_beside(layout, ground, first)};
  if (mechanism_.body.wrap > 0 || wishes_.wrap == WrapChoice::nearest) return nearest;
  const double radius = pocket_radius_of(first, layout);
  for (double wrap = k_two_pi; wrap > wrap_of(first); wrap -= k_wrap_step) {
    LapRange laps = ground.lap_range(true, wrap);
    laps.most = laps.least;
    const auto wound = tie_off(site(layout, ground), layout, true, radius, laps);
    if (!wound || is_channel(*wound) != is_channel(first) || room_of(*wound) < radius) continue;
    if (is_rejected(ground.outline().side, true, wrap_of(*wound))) continue;
    const TieOffPair further{*wound, spare_beside(layout, ground, *wound)};
    const bool in_the_way = ground.outline().side == transmission::Side::right &&
                            (count_cuts_into_hub(layout, further) > count_cuts_into_hub(layout, nearest) ||
                             blocks_set_screw(layout, further));
    const bool complete = further.spare || is_rejected(ground.outline().side, false, 0.0);
    if (complete && !in_the_way) return further;
  }
  return nearest;
}

// A second tie-off at the other end of the arc. Its entry is beyond the part of the floor that carries the tendon of
// the first.
std::optional<TieOff> TieOffPlanner::spare_beside(const BodyLayout& layout, const AnchorGround& ground,
                                                  const TieOff& first) const {
  if (is_rejected(ground.outline().side, false, 0.0)) return std::nullopt;
  const double radius = pocket_radius_of(first, layout);
  AnchorSite beside = site(layout, ground);
  const std::vector<Bar> bars = bars_of(first, layout);
  beside.holes.insert(beside.holes.end(), bars.begin(), bars.end());
  const auto spare = tie_off(beside, layout, false, radius, {0.0, ground.arc(true).length() - lap_of(first)});
  const bool as_good = spare && is_channel(*spare) == is_channel(first) && room_of(*spare) >= radius;
  return as_good ? spare : std::nullopt;
}

std::vector<AnchorRoom> TieOffPlanner::rooms(const BodyLayout& layout, const WoundTieOffs& wound) const {
  std::vector<AnchorRoom> rooms;
  const auto add_room = [&](transmission::Side side, const std::optional<TieOff>& found) {
    if (found && !is_channel(*found)) return;
    rooms.push_back({side, found ? room_of(*found) : 0.0, least_pocket(layout)});
  };
  add_room(transmission::Side::left, wound.p1);
  add_room(transmission::Side::right, wound.p2);
  return rooms;
}

}  // namespace fusee::solid
