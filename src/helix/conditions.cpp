#include "helix/conditions.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "profile/feasibility.h"
#include "profile/pitch_curve.h"
#include "profile/place_conditions.h"

namespace fusee::helix {
namespace {

constexpr std::array<transmission::Side, 2> k_sides = {transmission::Side::left, transmission::Side::right};

/// The condition that `value` does not exceed `limit`, still without a message.
profile::Condition at_most(std::string name, double alpha, double value, double limit, std::string unit) {
  profile::Condition condition;
  condition.name = std::move(name);
  condition.alpha = alpha;
  condition.value = value;
  condition.limit = limit;
  condition.unit = std::move(unit);
  condition.ok = value <= limit;
  return condition;
}

profile::Condition turn_count_condition(const transmission::Transmission& planar, transmission::Side side) {
  const profile::TakeOffs take_offs(planar, side);
  const double first = take_offs.at(transmission::mirror_sign(side) * planar.theta(planar.alpha_min())).curve.psi;
  const double last = take_offs.at(transmission::mirror_sign(side) * planar.theta(planar.alpha_max())).curve.psi;
  const double turns = std::abs(last - first) / k_two_pi;
  const double furthest = std::abs(planar.alpha_min()) > planar.alpha_max() ? planar.alpha_min() : planar.alpha_max();
  const std::string pulley(transmission::pulley_name(side));
  profile::Condition condition = at_most("turns_" + pulley, furthest, turns, k_most_turns, "1");
  if (!condition.ok) {
    condition.message = pulley + " would wind " + rounded(turns, 3) + " turns over the range: at most " +
                        rounded(k_most_turns) + " are supported, " + rounded(100.0 * k_most_turns / turns, 2) +
                        " % of this range";
  }
  return condition;
}

/// Limit of the fleet angle δ. A straight tendon rises by the groove's depth h over the length √(2ρh) and moves aside
/// by that length times tan δ. Above the limit it touches the groove edge. The largest radius of curvature ρ gives the
/// lowest limit.
profile::Condition fleet_condition(const HelixSide& helix, transmission::Side side, const HelixGroove& groove,
                                   double largest_radius) {
  constexpr double k_rounding = 1e-9;  // rad; a tendon without any fleet angle passes where there is no room
  const double length_to_edge = std::sqrt(2.0 * largest_radius * groove.groove_edge);
  const double limit = std::max(k_rounding, elementary::atan(groove.room_at_groove_edge / length_to_edge));
  const std::string number = side == transmission::Side::left ? "1" : "2";
  profile::Condition condition =
      at_most("fleet_angle_" + number, helix.fleet_at, degrees(helix.fleet), degrees(limit), "deg");
  if (!condition.ok) {
    condition.message = "tendon " + number + " leaves its groove at a fleet angle of " +
                        rounded(degrees(helix.fleet), 3) + "° at " + profile::at_alpha_text(helix.fleet_at) +
                        ": above " + rounded(degrees(limit), 3) +
                        "° it touches the groove edge. Increase pulley.EF_mm, reduce body.lead_mm or the number of "
                        "turns, or increase body.groove_angle_deg";
  }
  return condition;
}

profile::Condition lead_condition(const Mechanism& mechanism, const HelixGeometry& geometry, transmission::Side side) {
  const std::string pulley(transmission::pulley_name(side));
  profile::Condition condition;
  condition.name = "neighbouring_turns_" + pulley;
  condition.value = geometry.slope * geometry.circumference;
  condition.limit = geometry.needed_lead;
  condition.unit = "mm";
  constexpr double k_rounding = 1e-9;  // relative
  condition.ok = condition.value >= condition.limit * (1.0 - k_rounding);
  if (!condition.ok) {
    condition.message =
        "a lead of " + rounded(mechanism.body.lead, 4) + " mm (body.lead_mm) is too small: groove, rib " +
        "and the step between neighbouring turns of " + pulley + " require " + rounded(geometry.needed_lead, 4) + " mm";
  }
  return condition;
}

/// The condition that the spare turns are convex, as the tendon and the groove floor require.
profile::Condition spare_turn_condition(const Mechanism& mechanism, const Spiral& spiral, transmission::Side side) {
  const double half = 0.5 * mechanism.tendon.diameter;
  const std::string pulley(transmission::pulley_name(side));
  profile::Condition condition;
  condition.name = "spare_turns_" + pulley;
  condition.unit = "mm";
  condition.limit = profile::k_least_floor_radius;
  condition.value = 1e300;
  for (const SpiralRow& row : spiral.rows) condition.value = std::min(condition.value, row.rho - half);
  condition.ok = condition.value > condition.limit;
  if (!condition.ok) {
    condition.message = "the spare turns of " + pulley +
                        " cannot continue beyond the range as convex curves: the floor's radius falls to " +
                        rounded(condition.value, 3) +
                        " mm. Increase body.spare_turns, or choose a law whose radius changes more slowly there";
  }
  return condition;
}

profile::Condition closure_condition(const Windings& windings) {
  constexpr double k_limit = 0.002;  // mm
  profile::Condition condition = at_most("sloped_paths_close", 0, windings.closure, k_limit, "mm");
  if (!condition.ok) {
    condition.message = "the tendon lengths along the sloped paths do not converge: the residual is " +
                        rounded(windings.closure, 3) + " mm (a law with sharp bends, or a path too steep)";
  }
  return condition;
}

}  // namespace

std::vector<profile::Condition> turn_conditions(const Mechanism& mechanism, const transmission::Transmission& planar) {
  std::vector<profile::Condition> conditions;
  for (const transmission::Side side : k_sides) {
    conditions.push_back(turn_count_condition(planar, side));
    for (const double lift_off : profile::lift_offs(mechanism, planar, side)) {
      profile::Condition condition;
      condition.name = "on_drum_all_the_way";
      condition.alpha = planar.alpha(transmission::mirror_sign(side) * lift_off);
      condition.ok = false;
      condition.message = "a tendon leaves the joint's drum at " + profile::at_alpha_text(condition.alpha) +
                          ": with a multi-turn pulley it must stay on the drum, or off it, over the whole range";
      conditions.push_back(condition);
    }
  }
  return conditions;
}

std::vector<profile::Condition> helix_conditions(const Mechanism& mechanism, const HelixSynthesis& made,
                                                 const Windings& windings, const HelixGroove& groove) {
  std::vector<profile::Condition> conditions = {closure_condition(windings)};
  for (const transmission::Side side : k_sides) {
    const std::size_t i = side == transmission::Side::left ? 0 : 1;
    const HelixSide& helix = made.sides[i];
    double largest = 0;
    for (std::size_t k = helix.spiral.first_used; k <= helix.spiral.last_used; ++k)
      largest = std::max(largest, helix.spiral.rows[k].rho);
    conditions.push_back(spare_turn_condition(mechanism, helix.spiral, side));
    conditions.push_back(lead_condition(mechanism, windings.geometry[i], side));
    conditions.push_back(fleet_condition(helix, side, groove, largest));
  }
  return conditions;
}

std::vector<std::string> helix_warnings(const HelixSynthesis& made) {
  std::vector<std::string> warnings;
  for (const transmission::Side side : k_sides) {
    const HelixSide& helix = made.sides[side == transmission::Side::left ? 0 : 1];
    if (helix.fleet <= k_warned_fleet) continue;
    warnings.push_back(
        "tendon " + std::string(side == transmission::Side::left ? "1" : "2") +
        " leaves its groove at a fleet angle of up to " + rounded(degrees(helix.fleet), 3) + "° (" +
        profile::at_alpha_text(helix.fleet_at) +
        "): above 2° it wears and may climb the groove's wall. Increase pulley.EF_mm or reduce body.lead_mm.");
  }
  return warnings;
}

}  // namespace fusee::helix
