#include "solid/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

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

class Planner {
 public:
  Planner(const Mechanism& mechanism, const SynthesisResult& synthesis)
      : mechanism_(mechanism),
        synthesis_(synthesis),
        d_(mechanism.tendon.diameter),
        base_(axial_layout(mechanism)),
        tie_offs_(mechanism, synthesis) {
    rims_ = flange_rims(synthesis.p1, synthesis.p2, d_, base_.groove_depth, mechanism.body.flange);
    choose_channel(base_, mechanism);
  }

  BodyPlan plan() {
    BodyPlan plan;
    plan.rims = rims_;
    plan.layout = preferred_layout();
    const WoundTieOffs wound = tie_offs_.wound(plan.layout);
    tie_offs_.settle_pockets(plan.layout, wound);
    plan.anchors = tie_offs_.all(plan.layout, wound);
    turn_set_screw(plan);
    plan.conditions = conditions_of(mechanism_, synthesis_, plan.layout, rims_, tie_offs_.rooms(plan.layout, wound));
    return plan;
  }

 private:
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

  bool fits(const BodyLayout& layout) const {
    return bore_fits(layout) && tie_offs_.has_room(layout, tie_offs_.wound(layout));
  }
  bool bore_fits(const BodyLayout& layout) const {
    const auto thick = [&](const Outline& outline) {
      return wall_between(floor(outline), layout.bore.outline).thickness >= layout.min_wall;
    };
    return thick(synthesis_.p1) && thick(synthesis_.p2);
  }

  BodyLayout layout_with(double bore, double wall) const {
    BodyLayout layout = base_;
    layout.min_wall = wall;
    layout.bore = bore_layout(mechanism_.body, bore, mechanism_.material.hole_compensation);
    if (mechanism_.body.bore_diameter <= 0 && bore < k_bores.front()) {
      layout.notes.push_back(fmt::format("no room for a bore of {} mm: made {} mm", k_bores.front(), bore));
    }
    choose_hub(layout, mechanism_, inradius(rims_.upper));
    return layout;
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

  const Mechanism& mechanism_;
  const SynthesisResult& synthesis_;
  double d_;
  BodyLayout base_;
  FlangeRims rims_;
  TieOffPlanner tie_offs_;
};

}  // namespace

bool BodyPlan::possible() const {
  return std::all_of(conditions.begin(), conditions.end(), [](const Condition& condition) { return condition.ok; });
}

BodyPlan plan_body(const Mechanism& mechanism, const SynthesisResult& synthesis) {
  return Planner(mechanism, synthesis).plan();
}

}  // namespace fusee
