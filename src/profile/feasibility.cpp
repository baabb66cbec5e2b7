#include "profile/feasibility.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/golden_section.h"
#include "base/text.h"
#include "profile/pitch_curve.h"
#include "profile/place_conditions.h"
#include "transmission/torque.h"

namespace fusee::profile {
namespace {

/// Number of equal intervals of the joint angle between samples.
constexpr int k_samples = 192;
/// Arc reserved on the closing arc for the tendon's lap and tie-off at the wound end, in tendon diameters.
constexpr double k_anchor_lap = 5.0;

std::string exit_name(transmission::Side side) { return "the exit of sheath " + side_digit(side); }
/// "r1" or "r2".
std::string radius_name(transmission::Side side) { return "r" + side_digit(side); }

/// A quantity along the stroke that must exceed a limit.
struct Probe {
  std::string name;
  std::string unit;
  double limit = 0;
  std::function<double(const TakeOff&)> value;
  std::function<std::string(const std::string& where, double value)> failure;
};

/// The point of the stroke where the probe is smallest: the smallest sample, refined between its neighbours.
TakeOff tightest(const TakeOffs& take_offs, const std::vector<TakeOff>& samples, const Probe& probe) {
  std::size_t smallest = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double value = probe.value(samples[i]);
    // An undefined value counts as the tightest.
    if (!(value == value)) return samples[i];
    if (value < probe.value(samples[smallest])) smallest = i;
  }
  const double sign = transmission::mirror_sign(take_offs.side());
  const Bracket neighbours = {sign * samples[smallest == 0 ? 0 : smallest - 1].stroke.theta,
                              sign * samples[std::min(smallest + 1, samples.size() - 1)].stroke.theta};
  const auto value_at = [&](double theta) { return probe.value(take_offs.at(theta)); };
  constexpr int k_sections = 24;  // 0.618^24: to 1e-5 of the bracket
  const TakeOff refined = take_offs.at(golden_section(neighbours, k_sections, value_at).middle());
  return probe.value(refined) < probe.value(samples[smallest]) ? refined : samples[smallest];
}

Condition condition_of_probe(const Probe& probe, const TakeOff& worst) {
  Condition condition;
  condition.name = probe.name;
  condition.alpha = worst.stroke.alpha;
  condition.value = probe.value(worst);
  condition.limit = probe.limit;
  condition.unit = probe.unit;
  condition.ok = condition.value > probe.limit;
  if (!condition.ok) condition.message = probe.failure(at_alpha_text(condition.alpha), condition.value);
  return condition;
}

/// Clearance between the upper half of a tendon and the other tendon's pin.
Probe clear_of_other_pin(const TakeOffs& take_offs) {
  const transmission::Side side = take_offs.side();
  const std::string pin =
      pin_name(side == transmission::Side::left ? transmission::Side::right : transmission::Side::left);
  const transmission::PinPlace place = take_offs.place();
  const Vec2 other = other_pin(take_offs.transmission(), side);
  const double sign = transmission::mirror_sign(side);
  return {"tendon_" + side_digit(side) + "_clear_of_pin_" + pin, "mm", 0.0,
          [=](const TakeOff& t) { return upper_clearance(place, sign * t.stroke.theta, other) - place.rho; },
          [=](const std::string& where, double value) {
            return "tendon " + side_digit(side) + " cuts " + rounded(-value, 3) + " mm into pin " + pin + " at " +
                   where + ", which is the other tendon's";
          }};
}

/// Probes ordered so that a failure makes the later ones meaningless.
std::vector<Probe> path_probes(const Mechanism& mechanism, const TakeOffs& take_offs) {
  const transmission::Side side = take_offs.side();
  const double tendon_radius = 0.5 * mechanism.tendon.diameter;
  const transmission::PinPlace place = take_offs.place();
  const auto tendon = [&take_offs](const TakeOff& t) -> const transmission::TendonPoint& {
    return take_offs.tendon(t);
  };
  const std::string pin = pin_name(side);
  std::vector<Probe> probes;
  probes.push_back({"radius_P" + side_digit(side), "mm", 0.0,
                    [=](const TakeOff& t) { return tendon(t).p - tendon_radius; },
                    [=](const std::string& where, double value) {
                      return radius_name(side) + " falls to " + rounded(value + tendon_radius) + " mm at " + where +
                             ": less than half the tendon's diameter, the groove floor would cross the axis";
                    }});
  const transmission::LowerGuide lower = place.lower();
  const std::string from = place.sheath_exit ? "mouth_" + side_digit(side) : "pin_" + pin;
  probes.push_back({"line_reaches_" + from, "mm", 0.0,
                    [=](const TakeOff& t) { return lower.c() - std::abs(tendon(t).p - lower.rho); },
                    [=](const std::string& where, double value) {
                      return radius_name(side) + " is too large at " + where + ": " +
                             (place.sheath_exit ? exit_name(side) : "pin " + pin) + " lies " + rounded(-value) +
                             " mm inside the pulley's pitch curve";
                    }});
  probes.push_back({"tendon_on_pin_" + pin, "deg", 0.0, [=](const TakeOff& t) { return degrees(tendon(t).wrap); },
                    [=](const std::string& where, double value) {
                      return "tendon " + side_digit(side) + " leaves pin " + pin + " at " + where + ": its wrap there" +
                             (place.sheath_exit ? ", down into its sheath," : "") + " is " + rounded(value, 3) +
                             "° and must stay above 0°";
                    }});
  if (!mechanism.joint.is_plain()) probes.push_back(clear_of_other_pin(take_offs));
  return probes;
}

std::vector<Probe> curve_probes(const Mechanism& mechanism, const TakeOffs& take_offs) {
  const transmission::Side side = take_offs.side();
  const double tendon_radius = 0.5 * mechanism.tendon.diameter;
  const bool sheathed = mechanism.sheath.is_there();
  const auto tendon = [&take_offs](const TakeOff& t) -> const transmission::TendonPoint& {
    return take_offs.tendon(t);
  };
  std::vector<Probe> probes;
  probes.push_back({"take_off_advances_P" + side_digit(side), "deg/deg", 0.0, [](const TakeOff& t) { return t.dpsi; },
                    [=](const std::string& where, double) {
                      return radius_name(side) + " changes so fast at " + where +
                             " that the take-off point moves backwards";
                    }});
  probes.push_back({"convex_floor_P" + side_digit(side), "mm", k_least_floor_radius,
                    [=](const TakeOff& t) { return t.curve.radius - tendon_radius; },
                    [=](const std::string& where, double value) {
                      const std::string radius = " (radius of curvature " + rounded(std::abs(value), 3) + " mm)";
                      return "P" + side_digit(side) + " would be " + (value > 0 ? "too sharp" : "concave") + " at " +
                             where + radius + ": a tendon requires a convex groove floor with a radius above " +
                             rounded(k_least_floor_radius) + " mm";
                    }});
  probes.push_back({"free_span_" + side_digit(side), "mm", 0.0,
                    [=](const TakeOff& t) { return tendon(t).lower_reach - t.curve.dh; },
                    [=](const std::string& where, double value) {
                      return "tendon " + side_digit(side) + " has no free span between " +
                             (sheathed ? "its sheath" : "pin") + " and pulley at " + where + " (" + rounded(value, 3) +
                             " mm): the " + (sheathed ? "sheath exit" : "pin") + " lies inside the pulley";
                    }});
  return probes;
}

/// Appends the conditions up to the first failure; true when all hold.
bool add_probe_conditions(std::vector<Condition>& conditions, const std::vector<Probe>& probes,
                          const TakeOffs& take_offs, const std::vector<TakeOff>& samples) {
  for (const Probe& probe : probes) {
    conditions.push_back(condition_of_probe(probe, tightest(take_offs, samples, probe)));
    if (!conditions.back().ok) return false;
  }
  return true;
}

/// The sampled joint angles of the image, numbered from 0 to k_samples. rad
struct StrokeOfImage {
  double begin = 0, end = 0;

  StrokeOfImage(const Mechanism& mechanism, transmission::Side side)
      : begin(side == transmission::Side::right ? mechanism.joint.theta_min : -mechanism.joint.theta_max),
        end(side == transmission::Side::right ? mechanism.joint.theta_max : -mechanism.joint.theta_min) {}
  double theta(int i) const { return i == k_samples ? end : begin + (end - begin) * i / k_samples; }
};

std::vector<TakeOff> take_samples(const Mechanism& mechanism, const TakeOffs& take_offs) {
  const StrokeOfImage stroke(mechanism, take_offs.side());
  std::vector<TakeOff> samples;
  samples.reserve(k_samples + 1);
  // The curve is sampled on both sides of each lift-off angle.
  const std::vector<double> lift_off_angles = lift_offs(mechanism, take_offs.transmission(), take_offs.side());
  auto lift_off = lift_off_angles.begin();
  double last = stroke.begin;
  const auto add = [&](double theta) {
    samples.push_back(take_offs.at(theta));
    last = theta;
  };
  for (int i = 0; i <= k_samples; ++i) {
    const double theta = stroke.theta(i);
    for (; lift_off != lift_off_angles.end() && *lift_off < theta; ++lift_off) {
      for (const double beside : {*lift_off - k_beside_lift_off, *lift_off + k_beside_lift_off}) {
        if (beside > last && beside < theta) add(beside);
      }
    }
    add(theta);
  }
  return samples;
}

/// Tests the pitch curve at each angle at which a tendon leaves its drum. The slope of that tendon's moment arm m jumps
/// up there. A curve with a radius proportional to m is straight there. A curve with a radius proportional to 1/m would
/// need a hollow: P2 beside a round P1, since r2 = r1 m2/m1. False at the first hollow.
bool add_lift_off_conditions(std::vector<Condition>& conditions, const Mechanism& mechanism, const TakeOffs& take_offs,
                             SideAttempt& attempt) {
  const transmission::Side side = take_offs.side();
  const double sign = transmission::mirror_sign(side);
  for (const double theta : lift_offs(mechanism, take_offs.transmission(), side)) {
    const double straight = straight_length(take_offs, theta);
    if (straight > k_least_straight) attempt.straight.push_back(take_offs.at(theta).curve.psi);
    Condition condition;
    condition.name = "convex_at_lift_off_P" + side_digit(side);
    condition.alpha = take_offs.transmission().alpha(sign * theta);
    condition.value = straight;
    condition.unit = "mm";
    condition.ok = straight > -k_least_straight;
    if (!condition.ok) {
      const std::string other =
          side_digit(side == transmission::Side::left ? transmission::Side::right : transmission::Side::left);
      condition.message = "tendon " + other + " leaves the drum at " + at_alpha_text(condition.alpha) + ", and P" +
                          side_digit(side) + " would need a hollow there of " + rounded(-straight, 3) +
                          " mm: beside a round P" + other + " it stays on the drum, or off it, over the whole range";
    }
    conditions.push_back(condition);
    if (!condition.ok) return false;
  }
  return true;
}

/// The condition that active arc and anchor lap fit into one turn. The tendon stays wound at the beginning of the
/// image's stroke.
Condition one_turn_condition(const Mechanism& mechanism, transmission::Side side, const std::vector<TakeOff>& samples) {
  // A polar drawing spans the motor's own turn.
  const double active = mechanism.pulley.method == Method::exact
                            ? samples.back().curve.psi - samples.front().curve.psi
                            : std::abs(samples.back().stroke.alpha - samples.front().stroke.alpha);
  const double lap = k_anchor_lap * mechanism.tendon.diameter / samples.front().curve.h;
  Condition condition;
  condition.name = "one_turn_P" + side_digit(side);
  condition.alpha = samples.front().stroke.alpha;
  condition.value = degrees(k_two_pi - active - lap);
  condition.limit = 0;
  condition.unit = "deg";
  condition.ok = condition.value > 0;
  if (!condition.ok) {
    condition.message = "P" + side_digit(side) + " would need " + rounded(degrees(active), 4) + "° of active arc and " +
                        rounded(degrees(lap), 3) + "° for the anchor: more than one turn" +
                        (mechanism.pulley.winding == WindingChoice::automatic &&
                                 mechanism.pulley.method == Method::exact && !mechanism.sheath.is_there()
                             ? ", and only 'fusee build', 'kit', 'optimize' and 'rewind' support several"
                             : "");
  }
  return condition;
}

Condition closing_condition(const Mechanism& mechanism, transmission::Side side, const SideAttempt& attempt) {
  const double tendon_radius = 0.5 * mechanism.tendon.diameter;
  Condition condition;
  condition.name = "closing_arc_P" + side_digit(side);
  condition.alpha = attempt.samples.back().stroke.alpha;
  condition.value = attempt.closing ? attempt.closing->least_support() - tendon_radius : 0.0;
  condition.unit = "mm";
  condition.ok = attempt.closing && condition.value > 0;
  if (attempt.closing && !condition.ok) {
    condition.message = "the arc that closes P" + side_digit(side) + " would pass the axis at " +
                        rounded(-condition.value, 3) + " mm on the wrong side";
  } else if (!condition.ok) {
    condition.message =
        "the ends of P" + side_digit(side) + "'s active arc (" + radius_name(side) + " " +
        rounded(attempt.samples.front().curve.h) + " and " + rounded(attempt.samples.back().curve.h) +
        " mm) cannot be joined by a convex arc over the " +
        rounded(360.0 - degrees(attempt.samples.back().curve.psi - attempt.samples.front().curve.psi), 3) + "° left";
  }
  return condition;
}

/// The condition that both tendons have a moment arm over the whole range.
Condition moment_arm_condition(const transmission::Transmission& transmission) {
  Condition condition;
  condition.name = "moment_arms";
  condition.unit = "deg";
  condition.ok = !transmission.dead_centre();
  if (condition.ok) return condition;
  constexpr double k_least_arm = 1e-6;  // mm
  const double theta = *transmission.dead_centre();
  const bool left_fails =
      !(transmission::upper_span(transmission.place(transmission::Side::left), -theta).m > k_least_arm);
  const transmission::Side side = left_fails ? transmission::Side::left : transmission::Side::right;
  condition.value = degrees(theta);
  condition.alpha = transmission.alpha(theta);
  if (!std::isfinite(condition.alpha)) condition.alpha = 0;  // C lies within a pin
  condition.message = "tendon " + side_digit(side) + " passes through the joint axis (dead centre), or C meets pin " +
                      pin_name(side) + ", at θ = " + rounded(degrees(theta), 4) + "°, " +
                      at_alpha_text(condition.alpha) + ": the range must end before it";
  return condition;
}

/// The condition that the smooth curve through the table increases between its rows too. Tested along α, because the
/// ends of the stroke are defined only if it holds.
Condition growth_condition(const Mechanism& mechanism, const transmission::Transmission& transmission) {
  constexpr int k_steps = 1024;
  // The innermost rows that enclose the range.
  const std::vector<LawRow>& rows = mechanism.pulley.rows;
  std::size_t first = 0;
  while (first + 1 < rows.size() && rows[first + 1].theta <= mechanism.joint.theta_min) ++first;
  std::size_t last = rows.size() - 1;
  while (last > first + 1 && rows[last - 1].theta >= mechanism.joint.theta_max) --last;
  Condition condition;
  condition.name = "law_grows";
  condition.unit = "deg/deg";
  condition.value = 1e300;
  for (int i = 0; i <= k_steps; ++i) {
    const double alpha = rows[first].alpha + (rows[last].alpha - rows[first].alpha) * i / k_steps;
    const double g = transmission.at_alpha(alpha).g;
    if (g < condition.value) {
      condition.value = g;
      condition.alpha = alpha;
    }
  }
  condition.ok = condition.value > 0;
  if (!condition.ok) {
    condition.message = "the smooth curve through the table stops rising at " + at_alpha_text(condition.alpha) +
                        ": make its rows closer and its steps more even there";
  }
  return condition;
}

/// The condition that load and wanted torque have the same sign at every angle, so that motor and joint turn together.
Condition torque_condition(const Mechanism& mechanism) {
  const transmission::TorqueMatch worst = transmission::tightest_torque(mechanism);
  Condition condition;
  condition.name = "torque_holds";
  condition.unit = "deg/deg";
  condition.value = worst.slope();
  condition.ok = condition.value > 0 && std::isfinite(condition.value);
  if (condition.ok) return condition;
  const std::string where = " at θ = " + rounded(degrees(worst.theta), 4) + "°";
  const std::string load = "[load] and [spring] turn the joint with " + rounded(worst.load, 4) + " N·mm against +θ";
  if (worst.motor == 0) {
    condition.message = "the wanted torque of the motor is 0" + where + ", where " + load;
  } else {
    condition.message = load + where + ", and the wanted torque of the motor is " + rounded(worst.motor, 4) +
                        " N·mm: both must have the same sign and not be 0 over the whole range";
  }
  return condition;
}

/// The closing arc with the largest minimum radius of a few candidates; sharper bends where necessary.
std::optional<ClosingArc> closing_arc_of(const Mechanism& mechanism, const std::vector<TakeOff>& samples) {
  const CurvePoint& end = samples.back().curve;
  CurvePoint next_turn = samples.front().curve;
  next_turn.psi += k_two_pi;
  const double diameter = mechanism.tendon.diameter;
  const double mean_support = 0.5 * (end.h + next_turn.h);
  for (const double least :
       {0.5 * mean_support, 0.25 * mean_support, 2.5 * diameter, 0.5 * diameter + k_least_floor_radius}) {
    if (auto closing = ClosingArc::between(end, next_turn, least)) return closing;
  }
  return std::nullopt;
}

SideAttempt attempt_side(std::vector<Condition>& conditions, const Mechanism& mechanism, const TakeOffs& take_offs,
                         Turns turns) {
  SideAttempt side{take_offs, take_samples(mechanism, take_offs), std::nullopt, {}};
  if (!add_probe_conditions(conditions, path_probes(mechanism, take_offs), take_offs, side.samples)) return side;
  const bool exact = mechanism.pulley.method == Method::exact;
  // A polar drawing need not be an envelope: it is drawn as it is, and its error is measured.
  if (exact && !add_probe_conditions(conditions, curve_probes(mechanism, take_offs), take_offs, side.samples))
    return side;
  if (exact && !add_lift_off_conditions(conditions, mechanism, take_offs, side)) return side;
  if (turns == Turns::many) return side;
  conditions.push_back(one_turn_condition(mechanism, take_offs.side(), side.samples));
  if (!exact || !conditions.back().ok) return side;
  side.closing = closing_arc_of(mechanism, side.samples);
  conditions.push_back(closing_condition(mechanism, take_offs.side(), side));
  return side;
}

}  // namespace

bool Attempt::feasible() const {
  return std::all_of(conditions.begin(), conditions.end(), [](const Condition& condition) { return condition.ok; });
}

std::string at_alpha_text(double alpha) { return "α = " + rounded(degrees(alpha), 3) + "°"; }

Attempt attempt(const Mechanism& mechanism, const transmission::Transmission& transmission, Turns turns) {
  Attempt attempt{place_conditions(mechanism), {}};
  if (!attempt.feasible()) return attempt;
  if (mechanism.pulley.law == Law::torque) {
    attempt.conditions.push_back(torque_condition(mechanism));
    if (!attempt.conditions.back().ok) return attempt;
  }
  attempt.conditions.push_back(moment_arm_condition(transmission));
  if (!attempt.conditions.back().ok) return attempt;
  if (mechanism.pulley.law == Law::table) {
    attempt.conditions.push_back(growth_condition(mechanism, transmission));
    if (!attempt.conditions.back().ok) return attempt;
  }
  for (const transmission::Side side : {transmission::Side::left, transmission::Side::right}) {
    const TakeOffs take_offs(transmission, side);
    attempt.sides[side == transmission::Side::left ? 0 : 1] =
        attempt_side(attempt.conditions, mechanism, take_offs, turns);
  }
  return attempt;
}

namespace {

/// A failure at nine of the samples of attempt_side(), with the same probes.
std::optional<Condition> failure_at_few_places(const Mechanism& mechanism, const TakeOffs& take_offs) {
  std::vector<Probe> probes = path_probes(mechanism, take_offs);
  if (mechanism.pulley.method == Method::exact) {
    for (Probe& probe : curve_probes(mechanism, take_offs)) probes.push_back(std::move(probe));
  }
  const StrokeOfImage stroke(mechanism, take_offs.side());
  for (int i = 0; i <= k_samples; i += k_samples / 8) {
    const TakeOff at = take_offs.at(stroke.theta(i));
    for (const Probe& probe : probes) {
      if (!(probe.value(at) > probe.limit)) return condition_of_probe(probe, at);
    }
  }
  return std::nullopt;
}

/// The first failed condition; null when all hold.
std::optional<Condition> first_failed(const std::vector<Condition>& conditions) {
  const auto failed =
      std::find_if(conditions.begin(), conditions.end(), [](const Condition& condition) { return !condition.ok; });
  return failed == conditions.end() ? std::nullopt : std::optional<Condition>(*failed);
}

}  // namespace

std::optional<Condition> first_failure(const Mechanism& mechanism, const transmission::Transmission& transmission) {
  std::vector<Condition> conditions = place_conditions(mechanism);
  if (auto failed = first_failed(conditions)) return failed;
  if (mechanism.pulley.law == Law::torque) conditions.push_back(torque_condition(mechanism));
  if (auto failed = first_failed(conditions)) return failed;
  conditions.push_back(moment_arm_condition(transmission));
  if (mechanism.pulley.law == Law::table && conditions.back().ok)
    conditions.push_back(growth_condition(mechanism, transmission));
  if (auto failed = first_failed(conditions)) return failed;
  for (const transmission::Side side : {transmission::Side::left, transmission::Side::right}) {
    if (auto failed = failure_at_few_places(mechanism, TakeOffs(transmission, side))) return failed;
  }
  for (const transmission::Side side : {transmission::Side::left, transmission::Side::right}) {
    conditions.clear();
    attempt_side(conditions, mechanism, TakeOffs(transmission, side), Turns::one);
    if (auto failed = first_failed(conditions)) return failed;
  }
  return std::nullopt;
}

std::vector<std::string> bend_warnings(const Mechanism& mechanism, const Attempt& attempt) {
  std::vector<std::string> warnings;
  if (mechanism.pulley.method == Method::paper) return warnings;
  const double least = 0.5 * mechanism.tendon.bend_ratio * mechanism.tendon.diameter;
  for (const transmission::Side side : {transmission::Side::left, transmission::Side::right}) {
    const std::vector<TakeOff>& samples = attempt.sides[side == transmission::Side::left ? 0 : 1]->samples;
    const auto tightest = std::min_element(samples.begin(), samples.end(), [](const TakeOff& a, const TakeOff& b) {
      return a.curve.radius < b.curve.radius;
    });
    if (tightest->curve.radius >= least) continue;
    warnings.push_back(
        "P" + side_digit(side) + " bends the tendon to a radius of " + rounded(tightest->curve.radius, 3) + " mm at " +
        at_alpha_text(tightest->stroke.alpha) + "; this tendon requires " + rounded(least, 3) +
        " mm or more (tendon.bend_ratio, D/d = " + rounded(mechanism.tendon.bend_ratio, 3) + "): expect wear there");
  }
  return warnings;
}

}  // namespace fusee::profile
