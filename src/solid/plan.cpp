#include "solid/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <utility>

#include "mechanism/catalogue.h"
#include "solid/bore.h"
#include "solid/conditions.h"
#include "solid/dowels.h"
#include "solid/heights.h"
#include "solid/hub.h"
#include "solid/knot_loads.h"
#include "solid/marks.h"
#include "solid/set_screw.h"
#include "solid/size.h"
#include "solid/tails.h"

namespace fusee::solid {
namespace {

// Diameters to try for an automatic bore.
constexpr std::array<double, 6> k_bores{5.0, 4.0, 3.0, 2.5, 2.0, 1.5};
// Automatic wall of a part of ordinary size.
constexpr double k_wall = 1.2;
// Automatic wall of a small part, per mm of its radius.
constexpr double k_wall_per_radius = 0.12;
// Least automatic wall, for a nozzle of 0.4 mm.
constexpr double k_least_wall = 0.4;

// Highest cone under the middle flange for one print. Two prints require pins and glue.
constexpr double k_highest_cone = 3.0;

// Some points of a convex floor. Their polygon lies within the floor.
Polygon floor_within(const profile::Outline& outline, double tendon_diameter) {
  const Polygon all = profile::parallel(outline, -0.5 * tendon_diameter);
  Polygon floor;
  for (const std::size_t i : coarse_floor(all.size())) floor.push_back(all[i]);
  return floor;
}

FlangeRims rims_of(const Mechanism& mechanism, const profile::SynthesisResult& synthesis) {
  return flange_rims(synthesis.p1, synthesis.p2, mechanism.tendon.diameter, mechanism.groove_depth(),
                     mechanism.body.flange);
}

// Plans a body with given heights.
class Planner {
 public:
  Planner(const Mechanism& mechanism, const profile::SynthesisResult& synthesis, const FlangeRims& rims,
          const BodyLayout& base, const TieOffWishes& wishes)
      : mechanism_(mechanism),
        synthesis_(synthesis),
        d_(mechanism.tendon.diameter),
        base_(base),
        rims_(rims),
        wishes_(wishes),
        tie_offs_(mechanism, synthesis, rims, wishes) {}

  // Takes the hub of lowest cost, and the largest of these. Whether a plan exists does not depend on an automatic hub.
  BodyPlan plan() {
    const BodyLayout body = preferred_layout();
    const std::vector<HubChoice> hubs = hub_choices(body, mechanism_, inradius(rims_.upper));
    std::optional<BodyPlan> best;
    int least_cost = 0;
    for (const HubChoice& hub : hubs) {
      BodyPlan plan = plan_with(with_hub(body, hub));
      // The hub is needlessly large if it has the size for a screw that has no place in it.
      const bool is_needless =
          mechanism_.body.hub_diameter <= 0 && hub.set_screw.present && !plan.layout.set_screw.present;
      if (best && is_needless) continue;
      const int cost = wishes_.conditions_alone ? 0 : cost_of(plan) + (is_needless ? 1 : 0);
      const bool is_better = !best || (plan.is_possible() && (!best->is_possible() || cost < least_cost));
      if (!is_better) continue;
      best = std::move(plan);
      least_cost = cost;
      if (best->is_possible() && cost == 0) break;
      if (wishes_.conditions_alone) break;
    }
    return *std::move(best);
  }

 private:
  BodyPlan plan_with(const BodyLayout& layout) const {
    BodyPlan plan;
    plan.rims = rims_;
    plan.floor1 = floor_within(synthesis_.p1, d_);
    plan.floor2 = floor_within(synthesis_.p2, d_);
    plan.layout = layout;
    const WoundTieOffs wound = tie_offs_.wound(plan.layout);
    tie_offs_.settle_pockets(plan.layout, wound);
    plan.anchors = tie_offs_.all(plan.layout, wound);
    turn_set_screw(plan);
    add_pocket_ceiling(plan.layout);
    plan.conditions = conditions_of(mechanism_, synthesis_, plan.layout, rims_, tie_offs_.rooms(plan.layout, wound));
    if (wishes_.conditions_alone && !plan.is_possible()) return plan;
    if (plan.layout.parts == Parts::two) plan.layout.dowels = choose_dowels(mechanism_, plan);
    if (wishes_.conditions_alone && find_screw(mechanism_.body.clamp_screw) == nullptr) return plan;
    const std::vector<profile::Condition> of_tails = place_tails(plan, mechanism_, wishes_.rejected);
    plan.conditions.insert(plan.conditions.end(), of_tails.begin(), of_tails.end());
    if (!wishes_.conditions_alone) plan.marks = marks_of(mechanism_.body.marks, plan);
    return plan;
  }

  // Number of drawbacks of a plan: omitted features, pockets that weaken the hub, and knots that carry too much after
  // their wrap. An omitted nut does not count, because a thread in the hub replaces it.
  int cost_of(const BodyPlan& plan) {
    const std::vector<Omission>& omissions = plan.layout.omissions;
    auto cost = std::count_if(omissions.begin(), omissions.end(),
                              [](const Omission& omission) { return omission.feature != "nut"; });
    cost += std::count_if(plan.anchors.begin(), plan.anchors.end(), [&plan](const PlannedAnchor& anchor) {
      return plan.layout.hub_radius > 0 && anchor.cuts_into_hub(plan.layout);
    });
    if (!knots_) knots_.emplace(mechanism_, synthesis_);
    return static_cast<int>(cost) + knots_->count_unsafe(plan.anchors);
  }

  Polygon floor_of(const profile::Outline& outline) const { return profile::parallel(outline, -0.5 * d_); }

  // Wall thicknesses to try, in order of preference.
  std::vector<double> walls() const {
    if (mechanism_.body.min_wall > 0) return {mechanism_.body.min_wall};
    const double radius = std::min(inradius(floor_of(synthesis_.p1)), inradius(floor_of(synthesis_.p2)));
    const double wall = std::clamp(k_wall_per_radius * radius, k_least_wall, k_wall);
    std::vector<double> tried;
    for (const double thickness : {wall, 0.75 * wall, 0.55 * wall}) tried.push_back(std::max(thickness, k_least_wall));
    return tried;
  }

  // Shaft diameters to try, the largest first.
  std::vector<double> bores() const {
    if (mechanism_.body.bore_diameter > 0) return {mechanism_.body.bore_diameter};
    if (mechanism_.body.bore == Bore::horn) return {k_bores.front()};
    std::vector<double> bores;
    std::copy_if(k_bores.begin(), k_bores.end(), std::back_inserter(bores),
                 [this](double shaft) { return !flat_off_shaft(mechanism_.body, shaft); });
    return bores.empty() ? std::vector<double>{k_bores.front()} : bores;
  }

  // The layout with the thickest wall, and then the largest bore, with which both tie-offs fit. If they do not fit with
  // the thinnest wall and the smallest bore, they fit with no other.
  BodyLayout preferred_layout() {
    const std::vector<double> walls = this->walls(), bores = this->bores();
    const BodyLayout least = layout_with(bores.back(), walls.back());
    if (!fits(least)) tie_offs_.allow_face_holes();
    if (!fits(least)) return least;
    for (const double wall : walls) {
      for (const double bore : bores) {
        const BodyLayout layout = layout_with(bore, wall);
        if (fits(layout)) return layout;
      }
    }
    return least;
  }

  // True if bore and tie-offs fit. The hub does not matter: P2's channels avoid it only if their pockets keep their
  // size beside it.
  bool fits(const BodyLayout& layout) const {
    return bore_fits(layout) && tie_offs_.has_room(layout, tie_offs_.wound(layout));
  }
  bool bore_fits(const BodyLayout& layout) const {
    const BoreLayout uncompensated = bore_of_shaft(mechanism_, layout.bore);
    const auto has_wall = [&](const profile::Outline& outline) {
      const Polygon floor = floor_of(outline);
      return std::min(wall_between(floor, layout.bore.outline).thickness,
                      wall_between(floor, uncompensated.outline).thickness) >= layout.min_wall;
    };
    return has_wall(synthesis_.p1) && has_wall(synthesis_.p2);
  }

  BodyLayout layout_with(double bore, double wall) const {
    BodyLayout layout = base_;
    layout.min_wall = wall;
    layout.bore = bore_layout(mechanism_, bore);
    if (mechanism_.body.bore_diameter <= 0 && bore < k_bores.front()) {
      layout.omit("bore", fmt::format("no space for a bore of {} mm: reduced to {} mm", k_bores.front(), bore));
    }
    add_recess_ceiling(layout);
    return layout;
  }

  BodyLayout with_hub(BodyLayout layout, const HubChoice& hub) const {
    set_hub(layout, mechanism_, hub);
    return layout;
  }

  // Turns the set screw away from pockets that cut into the hub. Only on a round shaft may it have any direction.
  void turn_set_screw(BodyPlan& plan) const {
    SetScrewLayout& screw = plan.layout.set_screw;
    if (!screw.present) return;
    const auto clear_at = [&plan](double angle) {
      return std::all_of(plan.anchors.begin(), plan.anchors.end(), [&](const PlannedAnchor& anchor) {
        return anchor.side == transmission::Side::left || clears_set_screw(plan.layout, angle, anchor.tie_off);
      });
    };
    const int choices = mechanism_.body.bore == Bore::round ? 24 : 1;
    for (int k = 0; k < choices; ++k) {
      // Alternates to the left and to the right of +y.
      const double angle = 0.5 * k_pi + (k % 2 == 0 ? 1.0 : -1.0) * k_two_pi / 24.0 * ((k + 1) / 2);
      if (!clear_at(angle)) continue;
      screw.angle = angle;
      return;
    }
    screw = {};
    plan.layout.omit("set_screw", "a knot pocket occupies the place of the set screw: screw omitted");
  }

  const Mechanism& mechanism_;
  const profile::SynthesisResult& synthesis_;
  double d_;  ///< diameter of the tendon
  const BodyLayout& base_;
  const FlangeRims& rims_;
  const TieOffWishes& wishes_;
  TieOffPlanner tie_offs_;
  std::optional<KnotLoads> knots_;
};

// The failed conditions on the size of both curves. A part that is too large is not planned.
std::vector<profile::Condition> too_far_out(const profile::SynthesisResult& synthesis) {
  std::vector<profile::Condition> far;
  for (const profile::Outline* outline : {&synthesis.p1, &synthesis.p2}) {
    double reach = 0, active_reach = 0;
    for (std::size_t i = 0; i < outline->points.size(); ++i) {
      const double here = outline->points[i].position.norm();
      reach = std::max(reach, here);
      if (outline->is_active(i)) active_reach = std::max(active_reach, here);
    }
    if (auto condition = solid::too_far_out(outline->side, reach, active_reach)) far.push_back(std::move(*condition));
  }
  return far;
}

// True if P1 and P2 fit together at one angle only: by pins, a horn's screws, or a shaft with one flat or key. A hex or
// square shaft allows several angles.
bool is_located(const BodyLayout& layout) {
  return !layout.dowels.places.empty() || layout.bore.screw_holes.size() > 1 || layout.bore.kind == Bore::d ||
         layout.bore.kind == Bore::keyway;
}

}  // namespace

bool BodyPlan::is_possible() const {
  return std::all_of(conditions.begin(), conditions.end(),
                     [](const profile::Condition& condition) { return condition.ok; });
}

BodyPlan plan_body(const Mechanism& mechanism, const profile::SynthesisResult& synthesis, const TieOffWishes& wishes) {
  if (std::vector<profile::Condition> far = too_far_out(synthesis); !far.empty()) {
    BodyPlan none;
    none.conditions = std::move(far);
    return none;
  }
  const FlangeRims rims = rims_of(mechanism, synthesis);
  const TieOffWishes nearest_wishes{WrapChoice::nearest, wishes.rejected, wishes.entry_lean};
  const auto plan_on = [&](const BodyLayout& base) {
    BodyPlan plan = Planner(mechanism, synthesis, rims, base, wishes).plan();
    if (plan.is_possible() || wishes.wrap == WrapChoice::nearest) return plan;
    BodyPlan nearest = Planner(mechanism, synthesis, rims, base, nearest_wishes).plan();
    if (!nearest.is_possible()) return plan;
    nearest.layout.notes.push_back("the tie-offs have the least wrap only: with more, another feature had no place");
    return nearest;
  };
  const auto base_in = [&](Parts parts) { return axial_layout(mechanism, rims, parts, wishes.entry_lean); };
  if (mechanism.print.parts != Parts::automatic) return plan_on(base_in(mechanism.print.parts));
  const BodyLayout whole = base_in(Parts::one);
  if (whole.middle_cone <= k_highest_cone) return plan_on(whole);
  if (wishes.conditions_alone) {
    // A plan in one print suffices to show that a plan exists, even if two prints would be preferred.
    BodyPlan one = plan_on(whole);
    if (one.is_possible()) return one;
    BodyPlan two = plan_on(base_in(Parts::two));
    return two.is_possible() && is_located(two.layout) ? two : one;
  }
  BodyPlan two = plan_on(base_in(Parts::two));
  if (two.is_possible() && is_located(two.layout)) return two;
  BodyPlan one = plan_on(whole);
  one.layout.notes.push_back(fmt::format(
      "a cone of {:.1f} mm remains under the middle flange: there is no space for pins to print P1 and P2 separately",
      one.layout.middle_cone));
  return one;
}

}  // namespace fusee::solid
