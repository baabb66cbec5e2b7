#include <array>

#include "base/golden_section.h"
#include "base/text.h"
#include "fusee/base.h"
#include "fusee/optimize.h"
#include "fusee/transmission.h"
#include "optimize/objective_at.h"
#include "profile/take_off.h"
#include "transmission/torque.h"

namespace fusee::optimize {
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

/// Sampled places of the stroke; a maximum between two of them is searched.
constexpr int k_sampled_places = 61;
/// Cost of an impossible design. Twice this value marks an impossible place.
constexpr double k_impossible = 1e300;
/// A larger value counts as impossible: a moment arm is practically zero.
constexpr double k_largest = 1e12;

Evaluation impossible(std::string reason) {
  Evaluation evaluation;
  evaluation.reason = std::move(reason);
  return evaluation;
}

/// A place of the stroke and the value there.
struct PlaceValue {
  double place = 0;  ///< 0 … 1
  double value = -k_impossible;
};

double place_of(int i) { return static_cast<double>(i) / (k_sampled_places - 1); }

/// True if a local maximum may lie within a step of `i`: no neighbour is larger, and at an end of the range the value
/// increases inward.
template <typename Value>
bool peaks_near(const std::array<double, k_sampled_places>& values, int i, Value value) {
  const auto k = static_cast<std::size_t>(i);
  constexpr double k_inward = 0.25 / (k_sampled_places - 1);  // a quarter of a step
  if (i == 0) return values[k] >= values[k + 1] && value(k_inward) > values[k];
  if (i == k_sampled_places - 1) return values[k] >= values[k - 1] && value(1.0 - k_inward) > values[k];
  return values[k] >= values[k - 1] && values[k] >= values[k + 1];
}

/// Maximum of `value(place)` over places 0 … 1; impossible where it is not finite. The highest of several peaks may lie
/// further from the samples than another one, so all candidates near the maximum are refined.
template <typename Value>
Evaluation largest_over_range(const Mechanism& mechanism, Value value) {
  constexpr double k_near = 1e-2;  // relative; samples a sixtieth of the range apart miss less of a peak
  constexpr int k_sections = 24;
  std::array<double, k_sampled_places> values{};
  PlaceValue worst;
  for (int i = 0; i < k_sampled_places; ++i) {
    const double sample = value(place_of(i));
    if (!(std::abs(sample) < k_largest)) return impossible("");
    values[static_cast<std::size_t>(i)] = sample;
    if (sample > worst.value) worst = {place_of(i), sample};
  }
  const double at_least = worst.value - k_near * std::abs(worst.value);
  for (int i = 0; i < k_sampled_places; ++i) {
    if (!(values[static_cast<std::size_t>(i)] >= at_least) || !peaks_near(values, i, value)) continue;
    const Bracket neighbours = {std::max(0, i - 1) / (k_sampled_places - 1.0),
                                std::min(i + 1, k_sampled_places - 1) / (k_sampled_places - 1.0)};
    const double place = golden_section(neighbours, k_sections, [&](double inner) { return -value(inner); }).middle();
    const double refined = value(place);
    if (refined > worst.value) worst = {place, refined};
  }
  Evaluation evaluation;
  evaluation.possible = true;
  evaluation.value = worst.value;
  evaluation.theta = mechanism.joint.theta_min + worst.place * (mechanism.joint.theta_max - mechanism.joint.theta_min);
  return evaluation;
}

/// Laws and joints covered by the equations of objective_at.h.
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

/// Solves the equations by Transmission and paper_forces(): for cases without a closed form, and for the reason of a
/// missing value.
Evaluation evaluate_by_transmission(Objective objective, const Mechanism& mechanism) {
  const transmission::Transmission transmission(mechanism);
  if (const auto theta = transmission.dead_centre()) {
    const std::string where = " at θ = " + rounded(degrees(*theta), 4) + "°";
    if (mechanism.pulley.law == Law::torque && !(transmission::tightest_torque(mechanism).slope() > 0))
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
    const transmission::TransmissionPoint point = transmission.at_theta(mechanism.joint.theta_min + place * range);
    const std::string where = " at θ = " + rounded(degrees(point.theta), 3) + "°";
    if (!(point.t1.lower_reach > 0))
      reason = "pin B lies inside pulley P1" + where;
    else if (!(point.t2.lower_reach > 0))
      reason = "pin D lies inside pulley P2" + where;
    else if (!(point.t1.wrap >= 0))
      reason = "tendon 1 leaves pin B" + where;
    else if (!(point.t2.wrap >= 0))
      reason = "tendon 2 leaves pin D" + where;
    if (!reason.empty()) return 2.0 * k_impossible;
    const transmission::PaperForces forces = transmission::paper_forces(loaded, point);
    if (objective == Objective::max_tension) return forces.Tb;
    if (objective == Objective::motor_torque) return forces.Tb * point.t2.p;
    if (objective == Objective::max_error) return degrees(forces.elongation / point.t2.m);
    transmission::Domain domain;
    return objective_at(objective, numbers_of(mechanism), place, domain);
  };
  Evaluation evaluation = largest_over_range(mechanism, value);
  if (!evaluation.possible)
    evaluation.reason = reason.empty() ? "a force grows without bound: a moment arm is nearly zero" : reason;
  return evaluation;
}

/// Minimum radius of curvature of both pitch curves; the envelope exists if it is positive.
Evaluation smallest_bend(const Mechanism& mechanism) {
  const transmission::Transmission transmission(mechanism);
  // This evaluation fails at the dead centre, too, and reports why.
  if (transmission.dead_centre()) return evaluate_by_transmission(Objective::max_tension, mechanism);
  const double range = mechanism.joint.theta_max - mechanism.joint.theta_min;
  const profile::TakeOffs left(transmission, transmission::Side::left), right(transmission, transmission::Side::right);
  const auto tightness = [&](double place) {
    const double theta = mechanism.joint.theta_min + place * range;
    return -std::min(left.at(-theta).curve.radius, right.at(theta).curve.radius);
  };
  Evaluation evaluation = largest_over_range(mechanism, tightness);
  evaluation.value = -evaluation.value;
  if (!evaluation.possible) evaluation.reason = "a pin lies inside a pulley";
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
  return info(objective).is_maximized ? -value : value;
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
    transmission::Domain domain;
    const double value = objective_at(objective, numbers, place, domain);
    return domain.possible ? value : 2.0 * k_impossible;
  });
  // The slow evaluation reports the reason.
  if (!evaluation.possible) evaluation.reason = evaluate_by_transmission(objective, mechanism).reason;
  return evaluation;
}

}  // namespace fusee::optimize
