#include "solid/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "solid/bore.h"
#include "solid/conditions.h"
#include "solid/hub.h"
#include "solid/set_screw.h"

namespace fusee {
namespace {

// Diameters to try for an automatic bore.
constexpr std::array<double, 6> k_bores{5.0, 4.0, 3.0, 2.5, 2.0, 1.5};
// An automatic wall: of parts of ordinary size, per radius of small ones, and the least that a nozzle of 0.4 mm makes.
constexpr double k_wall = 1.2;
constexpr double k_wall_per_radius = 0.12;
constexpr double k_least_wall = 0.4;
// Below it an automatic channel would close in printing.
constexpr double k_least_channel = 0.6;
// A pocket narrower than this many channel widths is none: the knot would be pulled through.
constexpr double k_least_pocket = 0.55;
// An automatic pocket on a thin tendon, in channel widths.
constexpr double k_thin_pocket = 0.85;
// A pocket beside the hub leaves this gap to it rather than a sliver.
constexpr double k_hub_gap = 0.4;

struct Pair {
  std::optional<AnchorPath> p1, p2;
  bool both() const { return p1 && p2; }
};

class Planner {
 public:
  Planner(const Mechanism& mechanism, const SynthesisResult& synthesis)
      : mechanism_(mechanism), synthesis_(synthesis), d_(mechanism.tendon.diameter), base_(axial_layout(mechanism)) {
    rims_ = flange_rims(synthesis.p1, synthesis.p2, d_, base_.groove_depth, mechanism.body.flange);
    const double width =
        mechanism.body.anchor_hole > 0 ? mechanism.body.anchor_hole : std::max(d_ + 0.3, k_least_channel);
    base_.channel_width = width;
    base_.channel_fillet = std::max(2.0 * d_, 0.75 * width);
  }

  BodyPlan plan() {
    BodyPlan plan;
    plan.rims = rims_;
    plan.layout = preferred_layout();
    const Pair wound = wound_anchors(plan.layout);
    settle_pockets(plan.layout, wound);
    add_anchors(plan, wound);
    turn_set_screw(plan);
    plan.conditions = conditions_of(mechanism_, synthesis_, plan.layout, rims_, rooms(wound));
    return plan;
  }

 private:
  double wanted_pocket() const {
    if (mechanism_.body.knot_pocket > 0) return 0.5 * mechanism_.body.knot_pocket;
    return std::max(1.75 * d_, k_thin_pocket * base_.channel_width);
  }
  double least_pocket() const {
    return mechanism_.body.knot_pocket > 0 ? wanted_pocket() : k_least_pocket * base_.channel_width;
  }

  Polygon floor(const Outline& outline) const { return parallel(outline, -0.5 * d_); }

  // From the one to be preferred to the last that may be tried.
  std::vector<double> walls() const {
    if (mechanism_.body.min_wall > 0) return {mechanism_.body.min_wall};
    const double radius = std::min(inradius(floor(synthesis_.p1)), inradius(floor(synthesis_.p2)));
    const double wall = std::clamp(k_wall_per_radius * radius, k_least_wall, k_wall);
    std::vector<double> tried;
    for (const double thickness : {wall, 0.75 * wall, 0.55 * wall}) tried.push_back(std::max(thickness, k_least_wall));
    return tried;
  }
  std::vector<double> bores() const {
    if (mechanism_.body.bore_diameter > 0) return {mechanism_.body.bore_diameter};
    if (mechanism_.body.bore == Bore::horn) return {k_bores.front()};
    return {k_bores.begin(), k_bores.end()};
  }

  // Thick walls before large bores, both as large as leaves room for both tie-offs. Where the least of all has none,
  // none of the others has.
  BodyLayout preferred_layout() const {
    const std::vector<double> walls = this->walls(), bores = this->bores();
    const BodyLayout least = layout_with(bores.back(), walls.back());
    if (!fits(least)) return least;
    for (const double wall : walls) {
      for (const double bore : bores) {
        const BodyLayout layout = layout_with(bore, wall);
        if (fits(layout)) return layout;
      }
    }
    return least;
  }

  bool fits(const BodyLayout& layout) const { return bore_fits(layout) && has_room(wound_anchors(layout)); }
  bool bore_fits(const BodyLayout& layout) const {
    const auto thick = [&](const Outline& outline) {
      return wall_between(floor(outline), layout.bore.outline).thickness >= layout.min_wall;
    };
    return thick(synthesis_.p1) && thick(synthesis_.p2);
  }
  bool has_room(const Pair& wound) const {
    return wound.both() && std::min(wound.p1->room, wound.p2->room) >= least_pocket();
  }

  BodyLayout layout_with(double bore, double wall) const {
    BodyLayout layout = base_;
    layout.min_wall = wall;
    layout.bore = bore_layout(mechanism_, bore);
    if (mechanism_.body.bore_diameter <= 0 && bore < k_bores.front()) {
      layout.notes.push_back(fmt::format("no room for a bore of {} mm: made {} mm", k_bores.front(), bore));
    }
    choose_hub(layout, mechanism_, inradius(rims_.upper));
    return layout;
  }

  AnchorSite site(const BodyLayout& layout, const Outline& outline) const {
    AnchorSite site{outline, d_, layout.channel_width, layout.channel_fillet, layout.min_wall, {}, {}};
    site.holes.push_back({Vec2::Zero(), Vec2::Zero(), layout.bore.radius});
    for (const Polygon& hole : layout.bore.screw_holes) {
      Vec2 centre = Vec2::Zero();
      for (const Vec2& point : hole) centre += point / static_cast<double>(hole.size());
      site.holes.push_back({centre, centre, (hole.front() - centre).norm()});
    }
    return site;
  }

  // Near the wound end where there is room, anywhere else.
  std::optional<AnchorPath> anchor_at(const AnchorSite& site, bool wound_end, double wanted) const {
    auto path = find_anchor(site, wound_end, wanted, AnchorReach::near);
    if (!wound_end || (path && path->room >= wanted)) return path;
    return find_anchor(site, wound_end, wanted, AnchorReach::anywhere);
  }

  // P2's pockets open on the face that the hub stands on. They avoid it where they can, and cut into its side where
  // they cannot.
  std::optional<AnchorPath> p2_anchor(AnchorSite site, const BodyLayout& layout, bool wound_end, double wanted) const {
    if (layout.hub_radius > 0) {
      site.above_pocket.push_back({Vec2::Zero(), Vec2::Zero(), layout.hub_radius + k_hub_gap - layout.min_wall});
      if (auto path = anchor_at(site, wound_end, wanted); path && path->room >= least_pocket()) return path;
      site.above_pocket.clear();
    }
    return anchor_at(site, wound_end, wanted);
  }

  Pair wound_anchors(const BodyLayout& layout) const {
    return {anchor_at(site(layout, synthesis_.p1), true, wanted_pocket()),
            p2_anchor(site(layout, synthesis_.p2), layout, true, wanted_pocket())};
  }

  // One size of pocket for all: the smaller of what the wound ends have room for.
  void settle_pockets(BodyLayout& layout, const Pair& wound) const {
    layout.pocket_radius = wanted_pocket();
    if (!wound.both()) return;
    layout.pocket_radius = std::min(wound.p1->room, wound.p2->room);
    if (mechanism_.body.knot_pocket <= 0 && layout.pocket_radius < wanted_pocket()) {
      layout.notes.push_back(fmt::format("no room for knot pockets of {:.2f} mm: made {:.2f} mm", 2.0 * wanted_pocket(),
                                         2.0 * layout.pocket_radius));
    }
  }

  // The spare tie-offs at the other ends of the arcs are left out where they have no room beside the first.
  void add_anchors(BodyPlan& plan, const Pair& wound) const {
    if (!wound.both()) return;
    const double radius = plan.layout.pocket_radius;
    const auto add = [&](const Outline& outline, const AnchorPath& first) {
      const bool left = outline.side == Side::left;
      plan.anchors.push_back({outline.side, true, first});
      AnchorSite beside = site(plan.layout, outline);
      const std::vector<Bar> bars = first.bars(plan.layout.channel_width);
      beside.holes.insert(beside.holes.end(), bars.begin(), bars.end());
      beside.holes.push_back({first.pocket(), first.pocket(), radius});
      const auto spare = left ? anchor_at(beside, false, radius) : p2_anchor(beside, plan.layout, false, radius);
      if (spare && spare->room >= radius) {
        plan.anchors.push_back({outline.side, false, *spare});
      } else {
        plan.layout.notes.push_back(fmt::format("no room for a spare tie-off on {}: left out", pulley_name(outline.side)));
      }
    };
    add(synthesis_.p1, *wound.p1);
    add(synthesis_.p2, *wound.p2);
  }

  // Where a pocket cuts into the hub the set screw must point elsewhere; on a shaft with a flat it cannot.
  void turn_set_screw(BodyPlan& plan) const {
    SetScrewLayout& screw = plan.layout.set_screw;
    if (!screw.present) return;
    const double half_width = 0.5 * std::max(screw.hole_diameter, screw.nut_width);
    const auto clear_at = [&](double angle) {
      const Vec2 tip = plan.layout.hub_radius * unit(angle);
      return std::all_of(plan.anchors.begin(), plan.anchors.end(), [&](const PlannedAnchor& anchor) {
        if (anchor.side == Side::left) return true;
        const double near = gap({anchor.path.pocket(), anchor.path.pocket(), plan.layout.pocket_radius},
                                {Vec2::Zero(), tip, half_width});
        return near >= std::min(plan.layout.min_wall, 1.0);
      });
    };
    const int choices = mechanism_.body.bore == Bore::round ? 24 : 1;
    for (int k = 0; k < choices; ++k) {
      // To the left and to the right of +y in turn.
      const double angle = 0.5 * k_pi + (k % 2 == 0 ? 1.0 : -1.0) * k_two_pi / 24.0 * ((k + 1) / 2);
      if (!clear_at(angle)) continue;
      screw.angle = angle;
      return;
    }
    screw = {};
    plan.layout.notes.push_back("a knot pocket stands where the set screw would be: no set screw");
  }

  std::vector<AnchorRoom> rooms(const Pair& wound) const {
    const auto room_of = [this](Side side, const std::optional<AnchorPath>& found) {
      return AnchorRoom{side, found ? found->room : 0.0, least_pocket()};
    };
    return {room_of(Side::left, wound.p1), room_of(Side::right, wound.p2)};
  }

  const Mechanism& mechanism_;
  const SynthesisResult& synthesis_;
  double d_;
  BodyLayout base_;
  FlangeRims rims_;
};

}  // namespace

bool BodyPlan::possible() const {
  return std::all_of(conditions.begin(), conditions.end(), [](const Condition& condition) { return condition.ok; });
}

BodyPlan plan_body(const Mechanism& mechanism, const SynthesisResult& synthesis) {
  return Planner(mechanism, synthesis).plan();
}

}  // namespace fusee
