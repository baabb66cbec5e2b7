#include "fusee/optimize/objectives.h"

#include <array>

#include "base/golden_section.h"
#include "fusee/base/diagnostics.h"
#include "fusee/base/text.h"
#include "fusee/transmission/tension.h"
#include "fusee/transmission/torque.h"
#include "optimize/objective_at.h"
#include "profile/take_off.h"

namespace fusee {
namespace {

constexpr std::array<ObjectiveInfo, 5> k_objectives{{
    {Objective::max_tension, "max_tension", "N/N", "largest T_b over the range, per newton of tip force [6]-[8]", false,
     true},
    {Objective::max_error, "max_error", "deg/N",
     "largest joint error by stretch over the range, per newton of tip force [9]-[11]", false, true},
    {Objective::footprint, "footprint", "mm^2", "largest rectangle around link, pins and pulley in any pose", false,
     true},
    {Objective::motor_torque, "motor_torque", "N mm/N", "largest T_b r2 over the range, per newton of tip force", false,
     true},
    {Objective::min_bend, "min_bend", "mm", "smallest radius of curvature that a tendon is bent to on P1 or P2", true,
     false},
}};

/// Places of the stroke that are looked at; where the worst lies between two, it is searched for.
constexpr int k_places_looked_at = 61;
constexpr double k_impossible = 1e300;
/// A value beyond this is no design: a moment arm is as good as gone.
constexpr double k_largest = 1e12;

Evaluation impossible(std::string reason) {
  Evaluation evaluation;
  evaluation.reason = std::move(reason);
  return evaluation;
}

struct PlaceValue {
  double place = 0;
  double value = -k_impossible;
};

double place_of(int i) { return static_cast<double>(i) / (k_places_looked_at - 1); }

/// Whether there can be a largest value within a step of `i`: it is as large as its neighbours, and at an end of the
/// range the value grows inward.
template <typename Value>
bool peaks_near(const std::array<double, k_places_looked_at>& values, int i, Value value) {
  const auto k = static_cast<std::size_t>(i);
  constexpr double k_inward = 0.25 / (k_places_looked_at - 1);
  if (i == 0) return values[k] >= values[k + 1] && value(k_inward) > values[k];
  if (i == k_places_looked_at - 1) return values[k] >= values[k - 1] && value(1.0 - k_inward) > values[k];
  return values[k] >= values[k - 1] && values[k] >= values[k + 1];
}

/// Largest of `value(place)` over places 0 … 1; not finite where it has none. Of several peaks the highest may lie
/// further from the places that are looked at than another: all that come near are followed to their tops.
template <typename Value>
Evaluation largest_over_range(const Mechanism& mechanism, Value value) {
  constexpr double k_near = 1e-2;  // a step of a sixtieth misses less of a peak
  std::array<double, k_places_looked_at> values{};
  PlaceValue worst;
  for (int i = 0; i < k_places_looked_at; ++i) {
    const double here = value(place_of(i));
    if (!(std::abs(here) < k_largest)) return impossible("");
    values[static_cast<std::size_t>(i)] = here;
    if (here > worst.value) worst = {place_of(i), here};
  }
  const double at_least = worst.value - k_near * std::abs(worst.value);
  for (int i = 0; i < k_places_looked_at; ++i) {
    if (!(values[static_cast<std::size_t>(i)] >= at_least) || !peaks_near(values, i, value)) continue;
    const Bracket neighbours = {std::max(0, i - 1) / (k_places_looked_at - 1.0),
                                std::min(i + 1, k_places_looked_at - 1) / (k_places_looked_at - 1.0)};
    const double refined = golden_section(neighbours, 24, [&](double at) { return -value(at); }).middle();
    const double there = value(refined);
    if (there > worst.value) worst = {refined, there};
  }
  Evaluation evaluation;
  evaluation.possible = true;
  evaluation.value = worst.value;
  evaluation.theta = mechanism.joint.theta_min + worst.place * (mechanism.joint.theta_max - mechanism.joint.theta_min);
  return evaluation;
}

/// Laws and joints whose equations objective_at.h has.
bool has_closed_form(const Mechanism& mechanism) {
  return mechanism.pulley.law != Law::table && mechanism.pulley.law != Law::torque && !mechanism.sheath.is_there() &&
         mechanism.joint.drum_centre == Attachment{} && mechanism.guides.D_below_B == 0;
}

DesignNumbers<double> numbers_of(const Mechanism& mechanism) {
  DesignNumbers<double> numbers =
      design_numbers(file_numbers(mechanism), mechanism.pulley.law, mechanism.has_point_pins());
  if (const WideKind kind = wide_kind(mechanism); !kind.is_papers())
    numbers.wide = wide_numbers(kind, wide_file_numbers(mechanism), numbers.R, mechanism.tendon.diameter, numbers.rho);
  return numbers;
}

/// The same equations through Transmission and paper_forces(): what has no closed form, and the words for why there is
/// no value.
Evaluation evaluate_by_transmission(Objective objective, const Mechanism& mechanism) {
  const Transmission transmission(mechanism);
  if (const auto theta = transmission.dead_centre()) {
    const std::string where = " at θ = " + rounded(degrees(*theta), 4) + "°";
    if (mechanism.pulley.law == Law::torque && !(tightest_torque(mechanism).slope() > 0))
      return impossible("the wanted torque of the motor does not hold the load" + where);
    return impossible("a tendon loses its moment arm" + where);
  }
  Mechanism loaded = mechanism;
  loaded.load = {};
  loaded.spring = {};
  loaded.load.tip_force = 1.0;
  std::string reason;
  const double range = mechanism.joint.theta_max - mechanism.joint.theta_min;
  const auto value = [&](double place) {
    const TransmissionPoint point = transmission.at_theta(mechanism.joint.theta_min + place * range);
    const std::string where = " at θ = " + rounded(degrees(point.theta), 3) + "°";
    if (!(point.t1.lower_reach > 0))
      reason = "pin B stands in pulley P1" + where;
    else if (!(point.t2.lower_reach > 0))
      reason = "pin D stands in pulley P2" + where;
    else if (!(point.t1.wrap >= 0))
      reason = "tendon 1 leaves pin B" + where;
    else if (!(point.t2.wrap >= 0))
      reason = "tendon 2 leaves pin D" + where;
    if (!reason.empty()) return 2.0 * k_impossible;
    const PaperForces forces = paper_forces(loaded, point);
    if (objective == Objective::max_tension) return forces.Tb;
    if (objective == Objective::motor_torque) return forces.Tb * point.t2.p;
    if (objective == Objective::max_error) return degrees(forces.elongation / point.t2.m);
    Domain domain;
    return objective_at(objective, numbers_of(mechanism), place, domain);
  };
  Evaluation evaluation = largest_over_range(mechanism, value);
  if (!evaluation.possible)
    evaluation.reason = reason.empty() ? "a force grows without bound: a moment arm is nearly gone" : reason;
  return evaluation;
}

/// Smallest radius of curvature of both pitch curves; the envelope's own condition is that it is positive.
Evaluation smallest_bend(const Mechanism& mechanism) {
  const Transmission transmission(mechanism);
  if (transmission.dead_centre()) return evaluate_by_transmission(Objective::max_tension, mechanism);
  const double range = mechanism.joint.theta_max - mechanism.joint.theta_min;
  const TakeOffs left(transmission, Side::left), right(transmission, Side::right);
  const auto tightness = [&](double place) {
    const double theta = mechanism.joint.theta_min + place * range;
    return -std::min(left.at(-theta).curve.radius, right.at(theta).curve.radius);
  };
  Evaluation evaluation = largest_over_range(mechanism, tightness);
  evaluation.value = -evaluation.value;
  if (!evaluation.possible) evaluation.reason = "a pin stands in a pulley";
  return evaluation;
}

}  // namespace

std::span<const ObjectiveInfo> objectives() { return k_objectives; }

const ObjectiveInfo& info(Objective objective) { return k_objectives.at(static_cast<std::size_t>(objective)); }

Objective find_objective(std::string_view name) {
  for (const ObjectiveInfo& candidate : k_objectives) {
    if (candidate.name == name) return candidate.objective;
  }
  throw Bug("objective " + std::string(name));
}

double Evaluation::cost(Objective objective) const {
  if (!possible) return k_impossible;
  return info(objective).largest ? -value : value;
}

FileNumbers<double> file_numbers(const Mechanism& m) {
  return {m.joint.R,        m.guides.EB,       m.guides.ED,      m.guides.OE,     m.pulley.EF,
          m.pulley.r1,      m.pulley.ratio,    m.guides.mu,      m.guides.radius, m.tendon.diameter,
          m.tendon.modulus, m.joint.theta_min, m.joint.theta_max};
}

Evaluation evaluate(Objective objective, const Mechanism& mechanism) {
  if (objective == Objective::min_bend) return smallest_bend(mechanism);
  if (!has_closed_form(mechanism)) return evaluate_by_transmission(objective, mechanism);
  const DesignNumbers<double> numbers = numbers_of(mechanism);
  Evaluation evaluation = largest_over_range(mechanism, [&](double place) {
    Domain domain;
    const double value = objective_at(objective, numbers, place, domain);
    return domain.possible ? value : 2.0 * k_impossible;
  });
  // The slow way knows why.
  if (!evaluation.possible) evaluation.reason = evaluate_by_transmission(objective, mechanism).reason;
  return evaluation;
}

}  // namespace fusee
