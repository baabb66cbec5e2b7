#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "fusee/profile.h"
#include "profile/feasibility.h"
#include "profile/polar_curve.h"
#include "profile/sampling.h"
#include "transmission/alpha_range.h"

namespace fusee::profile {
namespace {

/// Distance from a pitch curve to the body's outermost parallel curve: the groove edge and a margin.
double flange_reach(const Mechanism& mechanism) { return mechanism.groove_depth() + mechanism.tendon.diameter; }

/// Largest turn of a chord. A chord with turn δ is shorter than its arc by the fraction δ²/24. If a pulley is about as
/// large as the joint's drum, the joint angle has the same relative error, up to 0.0015° at the end of the range. Plain
/// joints turn less, because their levers exceed their pulleys.
double largest_turn(const Mechanism& mechanism) {
  constexpr double k_theta_error = radians(0.0015);
  const double usual = SamplingOptions{}.largest_turn;
  if (mechanism.joint.is_plain()) return usual;
  const double furthest = std::max(-mechanism.joint.theta_min, mechanism.joint.theta_max);
  return std::min(usual, std::sqrt(24.0 * k_theta_error / furthest));
}

bool is_feasible(const Mechanism& mechanism) {
  return attempt(mechanism, transmission::Transmission(mechanism)).feasible();
}

std::unique_ptr<PitchCurve> pitch_curve(const Mechanism& mechanism, const SideAttempt& side,
                                        std::vector<std::string>& warnings) {
  if (mechanism.pulley.method == Method::exact)
    return std::make_unique<EnvelopeCurve>(side.take_offs, side.samples, *side.closing, side.straight);
  auto polar = std::make_unique<PolarCurve>(mechanism, side.take_offs);
  constexpr double k_noted_hollow = 0.01;  // mm
  if (polar->deepest_hollow() > k_noted_hollow) {
    warnings.push_back("the polar drawing of " + std::string(transmission::pulley_name(side.take_offs.side())) +
                       " is hollow by up to " + rounded(polar->deepest_hollow(), 3) +
                       " mm: the tendon bridges it, and the groove is made as the bridge");
  }
  return polar;
}

void draw(SynthesisResult& result, const Mechanism& mechanism, const Attempt& attempt,
          const SynthesisOptions& options) {
  result.warnings = bend_warnings(mechanism, attempt);
  const auto curve1 = pitch_curve(mechanism, *attempt.sides[0], result.warnings);
  const auto curve2 = pitch_curve(mechanism, *attempt.sides[1], result.warnings);
  auto outlines =
      sample(*curve1, *curve2,
             {options.chord_error_mm, std::max(flange_reach(mechanism), options.drawn_out), largest_turn(mechanism)});
  result.p1 = std::move(outlines[0]);
  result.p2 = std::move(outlines[1]);
}

std::string stroke_text(const std::vector<transmission::TransmissionPoint>& stroke) {
  const auto [low, high] =
      std::minmax_element(stroke.begin(), stroke.end(), [](const auto& a, const auto& b) { return a.t2.p < b.t2.p; });
  return "α " + fixed(degrees(stroke.front().alpha), 2) + "° … " + fixed(degrees(stroke.back().alpha), 2) + "°, r2 " +
         fixed(low->t2.p, 3) + " … " + fixed(high->t2.p, 3) + " mm";
}

}  // namespace

std::vector<Condition> failed_of(const std::vector<Condition>& conditions) {
  std::vector<Condition> failed;
  std::copy_if(conditions.begin(), conditions.end(), std::back_inserter(failed),
               [](const Condition& condition) { return !condition.ok; });
  return failed;
}

bool is_of_one_turn(const Condition& condition) { return condition.name.starts_with("one_turn_"); }

std::optional<Condition> obstacle_to(const Mechanism& mechanism) {
  return first_failure(mechanism, transmission::Transmission(mechanism));
}

std::optional<Condition> obstacle_but_one_turn(const Mechanism& mechanism) {
  for (Condition& failed : failed_of(attempt(mechanism, transmission::Transmission(mechanism)).conditions))
    if (!is_of_one_turn(failed)) return std::move(failed);
  return std::nullopt;
}

SynthesisResult synthesise(const Mechanism& mechanism, const SynthesisOptions& options) {
  SynthesisResult result;
  const transmission::Transmission transmission(mechanism);
  Attempt tried = attempt(mechanism, transmission);
  if (!transmission.dead_centre()) result.stroke = transmission::stroke_over_range(transmission, options.stroke_steps);
  if (tried.feasible()) {
    result.status = SynthesisStatus::made;
    draw(result, mechanism, tried, options);
  } else if (options.advice) {
    result.advice = nearest_changes(mechanism, is_feasible);
  }
  result.conditions = std::move(tried.conditions);
  return result;
}

bool needs_multi_turn(const SynthesisResult& synthesis) {
  const std::vector<Condition> failed = failed_of(synthesis.conditions);
  return !failed.empty() && std::all_of(failed.begin(), failed.end(), is_of_one_turn);
}

std::optional<std::string> kept_to_one_turn(const Mechanism& mechanism) {
  if (mechanism.pulley.winding == WindingChoice::one_turn) return "pulley.winding = \"one_turn\"";
  if (mechanism.pulley.method == Method::paper) return "pulley.method = \"paper\" draws no spirals";
  if (mechanism.sheath.is_there()) return "a tendon out of a sheath is not wound several times yet";
  return std::nullopt;
}

const transmission::TransmissionPoint* SynthesisResult::home() const {
  const auto nearest = std::min_element(
      stroke.begin(), stroke.end(), [](const auto& a, const auto& b) { return std::abs(a.alpha) < std::abs(b.alpha); });
  return nearest == stroke.end() ? nullptr : &*nearest;
}

std::string SynthesisResult::brief() const {
  if (made()) return stroke_text(stroke);
  std::string text;
  for (const Condition& condition : conditions) {
    if (condition.ok) continue;
    text += (text.empty() ? "" : "; ") + condition.message;
  }
  const std::string change = advice_sentence(advice);
  return text + ": " + (change.empty() ? "no change of a single number was found that makes it possible" : change);
}

}  // namespace fusee::profile
