#include "fusee/analysis.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "analysis/motor.h"
#include "base/text.h"
#include "fusee/mechanism_file.h"
#include "mechanism/catalogue.h"
#include "transmission/alpha_range.h"

namespace fusee::analysis {
namespace {

/// Tension up to which a tendon counts as slack. N
constexpr double k_min_tension = 1e-6;

bool path_exists(const transmission::TransmissionPoint& point) {
  return std::isfinite(point.theta) && std::isfinite(point.t1.length) && std::isfinite(point.t2.length) &&
         point.t1.p > 0 && point.t2.p > 0;
}

/// True if the law and both tendon paths exist at every point of the stroke.
bool law_exists(const profile::SynthesisResult& synthesis) {
  const auto permits_law = [](const profile::Condition& condition) {
    return condition.ok || condition.name != "law_grows";
  };
  return !synthesis.stroke.empty() && std::all_of(synthesis.stroke.begin(), synthesis.stroke.end(), path_exists) &&
         std::all_of(synthesis.conditions.begin(), synthesis.conditions.end(), permits_law);
}

std::vector<AnalysisRow> rows_of(const Mechanism& mechanism,
                                 const std::vector<transmission::TransmissionPoint>& stroke) {
  std::vector<double> alphas;
  for (const transmission::TransmissionPoint& point : stroke) alphas.push_back(point.alpha);
  const std::vector<StrokePoint> full = settled_stroke(mechanism, alphas);
  std::vector<AnalysisRow> rows;
  for (std::size_t i = 0; i < stroke.size(); ++i) {
    rows.push_back({stroke[i], transmission::paper_forces(mechanism, stroke[i]), full[i].rising, full[i].falling});
  }
  return rows;
}

bool has_equilibrium(const joint::EquilibriumPoint& point) {
  return point.status != joint::EquilibriumStatus::no_equilibrium;
}

void enlarge(Extreme& extreme, double value, double alpha) {
  if (value > extreme.value) extreme = {value, alpha};
}

void update_tensions(LargestTensions& largest, const joint::EquilibriumPoint& point, bool rising) {
  if (!has_equilibrium(point)) return;
  enlarge(largest.at_joint, std::max(point.t1.end, point.t2.end), point.alpha);
  for (const transmission::Side side : {transmission::Side::left, transmission::Side::right}) {
    const joint::TendonState& tendon = side == transmission::Side::left ? point.t1 : point.t2;
    for (const bool below : {false, true}) {
      const double tension = below ? tendon.lower : tendon.upper;
      if (tension > largest.anywhere.tension) largest.anywhere = {tension, point.alpha, side, below, rising};
    }
  }
}

template <typename Predicate>
std::vector<AlphaRange> ranges_where(const std::vector<AnalysisRow>& rows, Predicate predicate) {
  std::vector<AlphaRange> ranges;
  bool held_before = false;
  for (const AnalysisRow& row : rows) {
    const bool holds = predicate(row);
    if (holds && !held_before) ranges.push_back({row.declared.alpha, row.declared.alpha});
    if (holds) ranges.back().to = row.declared.alpha;
    held_before = holds;
  }
  return ranges;
}

bool is_slack(const joint::TendonState& tendon) { return tendon.upper <= k_min_tension; }

bool is_slack_in(const AnalysisRow& row, joint::TendonState joint::EquilibriumPoint::*tendon) {
  return (has_equilibrium(row.rising) && is_slack(row.rising.*tendon)) ||
         (has_equilibrium(row.falling) && is_slack(row.falling.*tendon));
}

/// Sets the extremes and the slack ranges from the rows.
void summarise(UnderLoad& result) {
  LargestTensions tensions;
  for (const AnalysisRow& row : result.rows) {
    const double alpha = row.declared.alpha;
    update_tensions(tensions, row.rising, true);
    update_tensions(tensions, row.falling, false);
    const bool both_exist = has_equilibrium(row.rising) && has_equilibrium(row.falling);
    if (!both_exist) {
      if (!result.lost_at) result.lost_at = alpha;
      continue;
    }
    enlarge(result.largest_torque, std::max(std::abs(row.rising.motor_torque), std::abs(row.falling.motor_torque)),
            alpha);
    enlarge(result.hysteresis, std::abs(row.rising.theta - row.falling.theta), alpha);
    const double theta = row.declared.theta;
    enlarge(result.theta_error, std::max(std::abs(row.rising.theta - theta), std::abs(row.falling.theta - theta)),
            alpha);
  }
  result.largest_tension = tensions.anywhere;
  result.largest_at_joint = tensions.at_joint;
  using Point = joint::EquilibriumPoint;
  result.slack1 = ranges_where(result.rows, [](const AnalysisRow& row) { return is_slack_in(row, &Point::t1); });
  result.slack2 = ranges_where(result.rows, [](const AnalysisRow& row) { return is_slack_in(row, &Point::t2); });
  result.untensioned = ranges_where(result.rows, [](const AnalysisRow& row) {
    return has_equilibrium(row.rising) && is_slack(row.rising.t1) && is_slack(row.rising.t2);
  });
}

/// The tendons that rub on a drum, if the drum has friction.
std::vector<DrumHold> drum_holds(const Mechanism& mechanism, const std::vector<AnalysisRow>& rows) {
  std::vector<DrumHold> all;
  if (!(mechanism.joint.drum_mu > 0)) return all;
  for (const transmission::Side side : {transmission::Side::left, transmission::Side::right}) {
    const transmission::PinPlace place = transmission::pin_place(mechanism, side, mechanism.seen_pitch_radius());
    DrumHold hold{side, 0, 1, {}};
    for (const AnalysisRow& row : rows) {
      const double theta = transmission::mirror_sign(side) * row.declared.theta;
      hold.wrap = std::max(hold.wrap, transmission::upper_span(place, theta).on_drum);
      for (const joint::EquilibriumPoint* point : {&row.rising, &row.falling})
        if (has_equilibrium(*point))
          enlarge(hold.at_end, (side == transmission::Side::left ? point->t1 : point->t2).end, row.declared.alpha);
    }
    hold.ratio = elementary::exp(mechanism.joint.drum_mu * hold.wrap);
    if (hold.wrap > 0) all.push_back(hold);
  }
  return all;
}

/// True if this pretension keeps both tendons taut at these α, in both directions.
bool stays_taut(Mechanism mechanism, double pretension, const std::vector<double>& alphas) {
  mechanism.tendon.pretension = pretension;
  const std::vector<StrokePoint> stroke = settled_stroke(mechanism, alphas);
  return std::all_of(stroke.begin(), stroke.end(), [](const StrokePoint& point) {
    const auto is_taut = [](const joint::EquilibriumPoint& state) {
      return has_equilibrium(state) && !is_slack(state.t1) && !is_slack(state.t2);
    };
    return is_taut(point.rising) && is_taut(point.falling);
  });
}

/// `value` > 0 rounded up to three digits, as it is printed.
double three_digits_up(double value) {
  const double unit = elementary::pow(10.0, std::floor(elementary::log10(value)) - 2.0);
  return number_of(rounded(std::ceil(value / unit) * unit, 3));
}

/// UnderLoad::taut_pretension within 1 % or 0.01 N, rounded up: doubled until the tendons stay taut, then bisected.
std::optional<double> taut_pretension(const Mechanism& mechanism, const std::vector<AnalysisRow>& rows) {
  constexpr double k_first = 1.0, k_least = 0.01;  // N
  constexpr double k_tolerance = 1.01;             // largest ratio of the taut pretension to the slack one
  std::vector<double> alphas;
  for (const AnalysisRow& row : rows) alphas.push_back(row.declared.alpha);
  double slack = mechanism.tendon.pretension;
  double taut = std::max(k_first, slack);
  while (!stays_taut(mechanism, taut, alphas)) {
    slack = taut;
    taut *= 2.0;
    if (taut > find_field("tendon.pretension_N")->most) return std::nullopt;
  }
  while (taut > k_tolerance * slack && taut > k_least) {
    const double middle = 0.5 * (slack + taut);
    (stays_taut(mechanism, middle, alphas) ? taut : slack) = middle;
  }
  return three_digits_up(taut);
}

Strength with_knots(double tension, const Tendon& tendon, const std::string& source) {
  return {tension, tension * tendon.knot_efficiency, source};
}

/// UnderLoad::breaks_at. At C every tendon ends in an unrelieved knot. On the pulley the wrap relieves the knot
/// (fusee/solid.h).
std::optional<double> breaking_place(const UnderLoad& result) {
  if (!result.strength) return std::nullopt;
  if (result.largest_at_joint.value > result.strength->at_knot) return result.largest_at_joint.alpha;
  if (result.largest_tension.tension > result.strength->tension) return result.largest_tension.alpha;
  return std::nullopt;
}

}  // namespace

std::string place_words(const TensionExtreme& extreme, const Mechanism& mechanism) {
  const bool left = extreme.tendon == transmission::Side::left;
  const std::string tendon = left ? "tendon 1 " : "tendon 2 ";
  if (extreme.below_pin && mechanism.sheath.is_there()) return tendon + "between sheath and pulley";
  const std::string pin = mechanism.guides.kind == GuideKind::idler ? "idler " : "pin ";
  return tendon + (extreme.below_pin ? "below " : "above ") + pin + (left ? "B" : "D");
}

LargestTensions largest_tensions(const Mechanism& mechanism, const std::vector<double>& alphas) {
  LargestTensions largest;
  for (const StrokePoint& point : settled_stroke(mechanism, alphas)) {
    update_tensions(largest, point.rising, true);
    update_tensions(largest, point.falling, false);
  }
  return largest;
}

std::optional<Strength> tendon_strength(const Tendon& tendon) {
  if (tendon.strength > 0) return with_knots(tendon.strength, tendon, "tendon.strength_N");
  for (const TendonType& type : tendon_types()) {
    constexpr double k_diameter_tolerance = 0.005;  // mm
    constexpr double k_modulus_tolerance = 0.01;    // relative
    const bool is_same = std::abs(type.diameter - tendon.diameter) < k_diameter_tolerance &&
                         std::abs(type.modulus / tendon.modulus - 1.0) < k_modulus_tolerance;
    if (is_same) return with_knots(type.breaking_strength, tendon, type.name);
  }
  return std::nullopt;
}

std::optional<Strength> likely_strength(const Tendon& tendon) {
  if (const auto known = tendon_strength(tendon)) return known;
  // Fibre and lay affect modulus and strength alike: within a factor of two in modulus the tendon may be of the same
  // kind, with a strength proportional to its cross-section. Braids of one kind differ by 1.4
  // (profiles/catalogue/tendons.toml).
  constexpr double k_alike = 2.0;
  const auto factor_between = [](double one, double other) { return std::max(one / other, other / one); };
  const TendonType* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const TendonType& type : tendon_types()) {
    const double modulus_factor = factor_between(type.modulus, tendon.modulus);
    const double factor = modulus_factor * factor_between(type.diameter, tendon.diameter);
    if (modulus_factor > k_alike || factor >= least) continue;
    nearest = &type;
    least = factor;
  }
  if (nearest == nullptr) return std::nullopt;
  return with_knots(
      strength_by_section(*nearest, tendon.diameter), tendon,
      "an estimate from " + nearest->name + " of the catalogue by its section; tendon.strength_N is not set");
}

std::optional<Diagnostic> tendon_breaks(const LargestTensions& largest, const Strength& strength) {
  const auto at = [](double alpha) { return "the tendon breaks at alpha = " + fixed(degrees(alpha), 1) + " deg: "; };
  Diagnostic breaks;
  if (largest.at_joint.value > strength.at_knot)
    breaks.message = at(largest.at_joint.alpha) + rounded(largest.at_joint.value) +
                     " N at its knot at C exceeds its strength of " + rounded(strength.at_knot) + " N there (" +
                     strength.source + ", tendon.knot_efficiency)";
  else if (largest.anywhere.tension > strength.tension)
    breaks.message = at(largest.anywhere.alpha) + rounded(largest.anywhere.tension) + " N exceeds its strength of " +
                     rounded(strength.tension) + " N (" + strength.source + ")";
  else
    return std::nullopt;
  breaks.hint =
      "reduce [load] or friction, use a thicker tendon, or lengthen the lever (joint.length_mm, guides.ED_mm)";
  return breaks;
}

std::optional<Diagnostic> no_equilibrium(const UnderLoad& load) {
  if (!load.lost_at) return std::nullopt;
  Diagnostic lost;
  lost.message = "the load pulls the joint past its dead centre at alpha = " + fixed(degrees(*load.lost_at), 1) +
                 " deg: there is no equilibrium";
  lost.hint = "reduce [load], or use stiffer tendons (tendon.diameter_mm, tendon.modulus_MPa)";
  return lost;
}

std::optional<double> UnderLoad::safety_factor() const {
  if (!strength || !(largest_tension.tension > k_min_tension)) return std::nullopt;
  const double of_tendon = strength->tension / largest_tension.tension;
  return largest_at_joint.value > 0 ? std::min(of_tendon, strength->at_knot / largest_at_joint.value) : of_tendon;
}

std::optional<Extreme> UnderLoad::least_tension() const {
  if (rows.empty() || lost_at || !slack1.empty() || !slack2.empty()) return std::nullopt;
  Extreme least{std::numeric_limits<double>::infinity(), 0};
  for (const AnalysisRow& row : rows) {
    for (const joint::EquilibriumPoint* point : {&row.rising, &row.falling}) {
      const double tension = std::min({point->t1.upper, point->t1.lower, point->t2.upper, point->t2.lower});
      if (tension < least.value) least = {tension, row.declared.alpha};
    }
  }
  return least;
}

bool UnderLoad::is_whole_range(const std::vector<AlphaRange>& ranges) const {
  return ranges.size() == 1 && ranges.front().from == rows.front().declared.alpha &&
         ranges.front().to == rows.back().declared.alpha;
}

namespace {

UnderLoad over_stroke(const Mechanism& mechanism, const std::vector<transmission::TransmissionPoint>& stroke) {
  UnderLoad result;
  result.rows = rows_of(mechanism, stroke);
  summarise(result);
  if (!result.slack1.empty() || !result.slack2.empty())
    result.taut_pretension = taut_pretension(mechanism, result.rows);
  result.strength = tendon_strength(mechanism.tendon);
  result.breaks_at = breaking_place(result);
  if (mechanism.motor.is_there()) result.motor = motor_check(mechanism, result);
  return result;
}

}  // namespace

UnderLoad under_load(const Mechanism& mechanism, int steps) {
  return over_stroke(mechanism, transmission::stroke_over_range(transmission::Transmission(mechanism), steps));
}

std::vector<profile::Condition> motor_obstacles(const Mechanism& mechanism) {
  if (!mechanism.motor.is_there()) return {};
  const transmission::Transmission law(mechanism);
  const std::vector<profile::Condition> travel =
      profile::failed_of(travel_check(mechanism, law.alpha_max() - law.alpha_min()).conditions);
  if (!travel.empty()) return travel;
  UnderLoad load;
  load.rows = rows_of(mechanism, transmission::stroke_over_range(law, AnalysisOptions{}.steps));
  summarise(load);
  return profile::failed_of(motor_check(mechanism, load).conditions);
}

AnalysisResult analyse(const Mechanism& mechanism, const AnalysisOptions& options, const RunContext& context) {
  AnalysisResult result;
  profile::SynthesisOptions synthesis_options;
  synthesis_options.stroke_steps = options.steps;
  synthesis_options.advice = false;
  profile::SynthesisResult synthesis = profile::synthesise(mechanism, synthesis_options);
  result.obstacles = profile::failed_of(synthesis.conditions);
  result.exists = law_exists(synthesis);
  if (!result.exists) {
    synthesis_options.advice = true;
    result.advice = profile::synthesise(mechanism, synthesis_options).advice;
    return result;
  }
  static_cast<UnderLoad&>(result) = over_stroke(mechanism, synthesis.stroke);
  for (const AnalysisRow& row : result.rows) enlarge(result.largest_paper_tension, row.paper.Tb, row.declared.alpha);
  result.on_drum = drum_holds(mechanism, result.rows);
  result.sources = error_sources(mechanism);
  result.tolerances = tolerance_effects(mechanism, options, context);
  result.synthesis = std::move(synthesis);
  return result;
}

}  // namespace fusee::analysis
