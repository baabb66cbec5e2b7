#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.h"
#include "fusee/analysis.h"
#include "fusee/base.h"
#include "fusee/solid.h"
#include "solid/knot_loads.h"
#include "solid/plan.h"
#include "solid/wrap.h"
#include "transmission/load.h"

namespace fusee::solid {
namespace {

std::size_t index_of(transmission::Side side) { return side == transmission::Side::left ? 0 : 1; }

// Angle from the take-off at each place of the stroke to the end of the active arc, which is the take-off at α_max on
// P1 and at α_min on P2. The direction of the line in the pulley's frame is its direction in space plus α.
std::vector<double> turns_to_end(const std::vector<transmission::TransmissionPoint>& stroke, transmission::Side side) {
  const auto direction = [&](std::size_t i) {
    return (side == transmission::Side::left ? stroke[i].t1 : stroke[i].t2).lower_normal + stroke[i].alpha;
  };
  std::vector<double> turns(stroke.size(), 0.0);
  for (std::size_t i = 1; i < stroke.size(); ++i)
    turns[i] = turns[i - 1] + std::abs(std::remainder(direction(i) - direction(i - 1), k_two_pi));
  if (side == transmission::Side::left) {
    for (double& turn : turns) turn = turns.back() - turn;
  }
  return turns;
}

// Raises the tensions at place i of the stroke to those of an equilibrium, if they are larger.
void raise_tensions(StrokeLoads& loads, std::size_t i, const joint::EquilibriumPoint& point) {
  if (point.status == joint::EquilibriumStatus::no_equilibrium) return;
  for (const transmission::Side side : {transmission::Side::left, transmission::Side::right}) {
    double& tension = loads[index_of(side)][i].tension;
    tension = std::max(tension, (side == transmission::Side::left ? point.t1 : point.t2).lower);
  }
}

std::vector<double> alphas_of(const std::vector<transmission::TransmissionPoint>& stroke) {
  std::vector<double> alphas;
  for (const transmission::TransmissionPoint& point : stroke) alphas.push_back(point.alpha);
  return alphas;
}

bool all_hold(const Holding& holding) {
  return std::all_of(holding.knots.begin(), holding.knots.end(),
                     [&holding](const KnotHold& knot) { return holding.share(knot).value_or(0) <= k_safe_knot_share; });
}

// The knots' loads on the planned tie-offs of a mechanism. Empty if its body cannot be made.
std::optional<Holding> with_planned_tie_offs(const Mechanism& mechanism, const profile::SynthesisResult& synthesis,
                                             const StrokeLoads& loads) {
  const BodyPlan plan = plan_body(mechanism, synthesis);
  if (!plan.is_possible()) return std::nullopt;
  Holding holding;
  holding.strength = analysis::tendon_strength(mechanism.tendon);
  for (const PlannedAnchor& anchor : plan.anchors) {
    if (!anchor.wound_end) continue;
    holding.knots.push_back(worst_knot(anchor.side, loads, mechanism.pulley.mu, anchor.wrap()));
  }
  return holding;
}

// Single changes, each tried, with which every knot is safe.
std::vector<std::string> helpful_changes(const Mechanism& mechanism, const profile::SynthesisResult& synthesis,
                                         const StrokeLoads& loads, const Holding& holding) {
  std::vector<std::string> changes;
  for (double wrap = 30; wrap <= 330; wrap += 15) {  // deg
    Mechanism changed = mechanism;
    changed.body.wrap = radians(wrap);
    const auto better = with_planned_tie_offs(changed, synthesis, loads);
    if (!better || !all_hold(*better)) continue;
    changes.push_back(fmt::format("body.wrap_deg = {}", rounded(wrap)));
    break;
  }
  // A larger radius turns less over the stroke and leaves more of the pulley for wrap.
  for (const double factor : {1.1, 1.2, 1.35, 1.5}) {
    if (mechanism.pulley.law != Law::compensate) break;
    Mechanism changed = mechanism;
    // Rounded up to a tenth of a mm.
    changed.pulley.r1 = std::ceil(10.0 * factor * mechanism.pulley.r1) / 10.0;
    const profile::SynthesisResult other = profile::synthesise(changed, {.advice = false});
    if (!other.made()) continue;
    const std::vector<analysis::StrokePoint> loaded = analysis::settled_stroke(changed, alphas_of(other.stroke));
    const auto better = with_planned_tie_offs(changed, other, stroke_loads(changed, other.stroke, loaded));
    if (!better || !all_hold(*better)) continue;
    changes.push_back(fmt::format("pulley.r1_mm = {}", rounded(changed.pulley.r1)));
    break;
  }
  // The forces do not depend on the tendon's strength, so the required strength follows directly.
  double needed = 0;
  for (const KnotHold& knot : holding.knots)
    needed = std::max(needed, knot.at_knot / (k_safe_knot_share * mechanism.tendon.knot_efficiency));
  const double rounded_up = std::ceil(0.1 * needed) * 10.0;  // to tens of N
  changes.push_back(fmt::format("a tendon with a strength of {} N (tendon.strength_N)", rounded_up));
  return changes;
}

std::string joined_by_or(const std::vector<std::string>& parts) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) text += i + 1 < parts.size() ? ", " : " or ";
    text += parts[i];
  }
  return text;
}

std::string warning_of(const KnotHold& knot, const Holding& holding, const std::vector<std::string>& changes) {
  const analysis::Strength& strength = *holding.strength;
  return fmt::format(
      "the knot of tendon {} on {} carries up to {} N, at alpha = {} deg: {:.0f} % of the {} N at which it breaks "
      "there ({} x tendon.knot_efficiency). At most half is safe. Try {}",
      knot.side == transmission::Side::left ? 1 : 2, transmission::pulley_name(knot.side), rounded(knot.at_knot, 3),
      fixed(degrees(knot.alpha), 1), 100.0 * *holding.share(knot), rounded(strength.at_knot), strength.source,
      joined_by_or(changes));
}

}  // namespace

StrokeLoads stroke_loads(const Mechanism& mechanism, const std::vector<transmission::TransmissionPoint>& stroke,
                         const std::vector<analysis::StrokePoint>& loaded) {
  StrokeLoads loads;
  const std::vector<double> alphas = alphas_of(stroke);
  for (const transmission::Side side : {transmission::Side::left, transmission::Side::right}) {
    const std::vector<double> turns = turns_to_end(stroke, side);
    for (std::size_t i = 0; i < stroke.size(); ++i) loads[index_of(side)].push_back({alphas[i], 0.0, turns[i]});
  }
  Mechanism unloaded = mechanism;
  transmission::keep_law(unloaded);
  unloaded.load = {};
  unloaded.spring = {};
  const std::vector<analysis::StrokePoint> free = analysis::settled_stroke(unloaded, alphas);
  for (const std::vector<analysis::StrokePoint>* points : {&loaded, &free}) {
    for (std::size_t i = 0; i < alphas.size(); ++i) {
      raise_tensions(loads, i, (*points)[i].rising);
      raise_tensions(loads, i, (*points)[i].falling);
    }
  }
  return loads;
}

// A wrapped tendon sustains any tension between T e^(−μφ) and T e^(μφ) and slides beyond these bounds. The knot's
// tension increases only when T e^(−μφ) exceeds all previous values, so it ends at the stroke's largest T e^(−μφ).
KnotHold worst_knot(transmission::Side side, const StrokeLoads& loads, double mu, double wrap_past_arc) {
  KnotHold worst{side, 0, 0, 0, -1};
  for (const TakeOffLoad& load : loads[index_of(side)]) {
    const double wrap = wrap_past_arc + load.turn;
    const double at_knot = load.tension * elementary::exp(-mu * wrap);
    if (at_knot > worst.at_knot) worst = {side, load.alpha, wrap, load.tension, at_knot};
  }
  return worst;
}

KnotLoads::KnotLoads(const Mechanism& mechanism, const profile::SynthesisResult& synthesis) : mu_(mechanism.pulley.mu) {
  holding_.strength = analysis::tendon_strength(mechanism.tendon);
  if (!holding_.strength) return;
  loads_ = stroke_loads(mechanism, synthesis.stroke, analysis::settled_stroke(mechanism, alphas_of(synthesis.stroke)));
}

int KnotLoads::count_unsafe(const std::vector<PlannedAnchor>& anchors) const {
  if (!holding_.strength) return 0;
  return static_cast<int>(std::count_if(anchors.begin(), anchors.end(), [this](const PlannedAnchor& anchor) {
    return anchor.wound_end &&
           holding_.share(worst_knot(anchor.side, loads_, mu_, anchor.wrap())).value_or(0) > k_safe_knot_share;
  }));
}

std::optional<double> Holding::share(const KnotHold& knot) const {
  if (!strength || strength->at_knot <= 0) return std::nullopt;
  return knot.at_knot / strength->at_knot;
}

Holding tendon_holding(const Mechanism& mechanism, const profile::SynthesisResult& synthesis, const Pulley& pulley) {
  Holding holding;
  holding.loaded = analysis::settled_stroke(mechanism, alphas_of(synthesis.stroke));
  const StrokeLoads loads = stroke_loads(mechanism, synthesis.stroke, holding.loaded);
  holding.strength = analysis::tendon_strength(mechanism.tendon);
  for (const Anchor& anchor : pulley.anchors) {
    if (!anchor.wound_end) continue;
    const profile::Outline& outline = anchor.side == transmission::Side::left ? synthesis.p1 : synthesis.p2;
    const double wrap = wound_arc(outline, outline.anchor_end(), index_at_place(outline, anchor.exit)).turn;
    holding.knots.push_back(worst_knot(anchor.side, loads, mechanism.pulley.mu, wrap));
  }
  if (all_hold(holding)) return holding;
  const std::vector<std::string> changes = helpful_changes(mechanism, synthesis, loads, holding);
  for (const KnotHold& knot : holding.knots) {
    if (*holding.share(knot) > k_safe_knot_share) holding.warnings.push_back(warning_of(knot, holding, changes));
  }
  return holding;
}

}  // namespace fusee::solid
