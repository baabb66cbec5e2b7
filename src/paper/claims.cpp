#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "fusee/optimize.h"
#include "fusee/profile.h"
#include "paper/steps.h"
#include "paper/windows.h"

namespace fusee::paper {
namespace {

using Holds = std::function<bool(const PaperAssumptions&)>;

/// Relative difference up to which two values of an objective count as equal.
constexpr double k_same_value = 1e-6;
/// Difference up to which two positions in a range count as equal, as a fraction of the range.
constexpr double k_same_place = 1e-3;
/// Deviation of θ(α) from a straight line up to which a joint counts as linear, deg.
constexpr double k_linear = 0.1;

// ---- predicates -----------------------------------------------------------------------------------------------------

/// Position of the largest value in the stroke, 0 … 1.
template <typename Value>
double place_of_largest(const std::vector<StrokePlace>& stroke, Value value) {
  const auto most = std::max_element(stroke.begin(), stroke.end(),
                                     [&](const StrokePlace& a, const StrokePlace& b) { return value(a) < value(b); });
  return static_cast<double>(most - stroke.begin()) / static_cast<double>(stroke.size() - 1);
}

/// The predicate that the largest value lies at the negative limit of α.
template <typename Value>
Holds largest_at_negative_limit(Value value) {
  return [value](const PaperAssumptions& assumptions) {
    const std::vector<StrokePlace> stroke = paper_stroke(table_4_mechanism(assumptions));
    return !stroke.empty() && std::isfinite(value(stroke.front())) && place_of_largest(stroke, value) < k_same_place;
  };
}

double tension(const StrokePlace& place) { return place.forces.Tb; }
double elongation(const StrokePlace& place) { return place.forces.elongation; }
double joint_error(const StrokePlace& place) { return degrees(place.forces.theta_error); }

/// The certified optimum of the paper's problem with this objective. `gap`: relative distance of the proven bound from
/// the optimum. The search ends early when it finds a value below `sufficient`.
optimize::CertifiedResult optimum_of(const PaperAssumptions& assumptions, optimize::Objective objective, double gap,
                                     std::optional<double> sufficient = std::nullopt) {
  MechanismFile file = paper_problem_file(assumptions);
  file.mechanism.optimize.objectives = {std::string(optimize::info(objective).name)};
  const optimize::Problem problem = optimize::make_problem(file);
  optimize::CertifiedOptions options;
  options.gap = gap;
  options.most_tie_boxes = 1;  // ties are not needed
  options.most_boxes = 60000;  // limits the time; an optimum that is not proven by then does not count
  options.sufficient = sufficient;
  options.first_tries = {{file.mechanism.joint.R, file.mechanism.guides.ED, file.mechanism.guides.OE}};
  return optimize::certified_optimum(problem, objective, options);
}

/// R, EB = ED and OE, mm.
struct Lengths {
  double R, ED, OE;
};

Lengths table_4_lengths(const PaperAssumptions& assumptions) {
  const Mechanism mechanism = table_4_mechanism(assumptions);
  return {mechanism.joint.R, mechanism.guides.ED, mechanism.guides.OE};
}

/// True if it is proven that no design within the bounds is better in this objective than these lengths by more than
/// two millionths: a millionth for equal values, another for the gap of the proof.
bool is_optimal(const PaperAssumptions& assumptions, optimize::Objective objective, const Lengths& lengths) {
  const optimize::Evaluation evaluation =
      optimize::evaluate(objective, paper_mechanism(assumptions, lengths.R, lengths.ED, lengths.OE));
  if (!evaluation.possible) return false;
  const double better_below = evaluation.value * (1.0 - k_same_value);
  // A better neighbour makes the search unnecessary, and any better design ends it. Table 4 is at the upper bound of ED
  // and at the lower bound of OE, so its neighbours inside have a smaller ED or a larger OE.
  const Optimization box = paper_problem_file(assumptions).mechanism.optimize;
  const double step = 1e-3 * assumptions.unit;
  for (const auto& [ED_step, OE_step] : {std::pair{-step, 0.0}, {0.0, step}, {-step, step}}) {
    const Lengths neighbour{lengths.R, std::max(lengths.ED + ED_step, box.lower[1]),
                            std::min(lengths.OE + OE_step, box.upper[2])};
    const optimize::Evaluation other =
        optimize::evaluate(objective, paper_mechanism(assumptions, neighbour.R, neighbour.ED, neighbour.OE));
    if (other.possible && other.value < better_below) return false;
  }
  return optimum_of(assumptions, objective, k_same_value, better_below).lower_bound >=
         evaluation.value * (1.0 - 2.0 * k_same_value);
}

// ---- windows --------------------------------------------------------------------------------------------------------

std::vector<ParameterWindows> windows_of(const PaperAssumptions& assumptions, const Holds& holds) {
  struct SearchedParameter {
    const char* parameter;
    const char* unit;
    double PaperAssumptions::*member;
    double low, high;
  };
  // μ = 0 is excluded, because whole surfaces of designs are equally good there. EF begins where a pulley of the
  // assumed r1 touches the line of the pins.
  constexpr int k_steps = 40;
  constexpr SearchedParameter searched[] = {{"mu", "", &PaperAssumptions::mu, 0.01, 0.51},
                                            {"r1", "mm", &PaperAssumptions::r1, 2.0, 42.0},
                                            {"EF", "mm", &PaperAssumptions::EF, 20.0, 220.0}};
  std::vector<ParameterWindows> all;
  for (const auto& [parameter, unit, member, low, high] : searched) {
    PaperAssumptions changed = assumptions;
    const auto holds_at = [&, number = member](double value) {
      changed.*number = value;
      return holds(changed);
    };
    all.push_back({parameter, unit, low, high, windows_where(holds_at, low, high, k_steps)});
  }
  return all;
}

bool is_everywhere(const ParameterWindows& parameter) {
  return parameter.windows.size() == 1 && parameter.windows[0].open_low && parameter.windows[0].open_high;
}

/// The claim with its windows and the verdict that follows from them.
Claim with_verdict(Claim claim, const PaperAssumptions& assumptions, const Holds& holds) {
  claim.windows = windows_of(assumptions, holds);
  const bool here = holds(assumptions);
  const bool everywhere = here && std::all_of(claim.windows.begin(), claim.windows.end(), is_everywhere);
  const bool somewhere =
      here || std::any_of(claim.windows.begin(), claim.windows.end(),
                          [](const ParameterWindows& parameter) { return !parameter.windows.empty(); });
  if (everywhere)
    claim.verdict = Verdict::holds;
  else
    claim.verdict = somewhere ? Verdict::holds_only_if : Verdict::does_not_hold;
  return claim;
}

// ---- the claims -----------------------------------------------------------------------------------------------------

std::string in_mm(double value) { return rounded(value, 5); }

Claim optimum_claim(const Reproduction& so_far) {
  Claim claim;
  claim.name = "optimum_of_table_4";
  const auto& rows = so_far.table_4;
  claim.paper_says = "the best joint has R " + in_mm(rows[0].paper) + ", EB = ED " + in_mm(rows[1].paper) + ", OE " +
                     in_mm(rows[2].paper) + " mm";
  claim.equations_give = "R " + in_mm(rows[0].computed) + ", EB = ED " + in_mm(rows[1].computed) + ", OE " +
                         in_mm(rows[2].computed) + " mm with max T_b/F_c " + fixed(so_far.optimum, 4) +
                         ", proven to a millionth";
  return with_verdict(std::move(claim), so_far.assumptions, table_4_is_optimal);
}

/// True if the best of the few designs with all three lengths at bounds is the optimum. ED is also bounded by EB <=
/// R/2.
bool all_at_bounds(const PaperAssumptions& assumptions) {
  const Optimization table = paper_problem_file(assumptions).mechanism.optimize;
  Lengths best = table_4_lengths(assumptions);
  double least = 1e300;
  for (const double R : {table.lower[0], table.upper[0]}) {
    for (const double ED : {table.lower[1], std::min(0.5 * R, table.upper[1])}) {
      for (const double OE : {table.lower[2], table.upper[2]}) {
        const optimize::Evaluation corner =
            optimize::evaluate(optimize::Objective::max_tension, paper_mechanism(assumptions, R, ED, OE));
        if (!corner.possible || corner.value >= least) continue;
        least = corner.value;
        best = {R, ED, OE};
      }
    }
  }
  return is_optimal(assumptions, optimize::Objective::max_tension, best);
}

Claim bounds_claim(const Reproduction& so_far) {
  Claim claim;
  claim.name = "all_three_at_their_bounds";
  claim.paper_says = "R, EB = ED and OE of the optimum all lie at bounds";
  for (const OptimumRow& row : so_far.table_4) {
    const double range = row.upper - row.lower;
    const bool is_at_bound = std::min(row.computed - row.lower, row.upper - row.computed) < k_same_place * range;
    const bool is_EB = &row == &so_far.table_4[1];
    const bool is_at_half_R = is_EB && std::abs(row.computed - 0.5 * so_far.table_4[0].computed) < k_same_place * range;
    claim.equations_give += (claim.equations_give.empty() ? "" : ", ") + row.symbol;
    if (is_at_half_R)
      claim.equations_give += " at EB <= R/2";
    else
      claim.equations_give += is_at_bound ? " at its bound" : " inside";
  }
  return with_verdict(std::move(claim), so_far.assumptions, all_at_bounds);
}

template <typename Value>
Claim place_claim(const Reproduction& so_far, const std::string& name, const std::string& quantity,
                  const std::string& unit, Value value) {
  Claim claim;
  claim.name = name;
  claim.paper_says = "the largest " + quantity + " is at the negative limit of α";
  const auto stroke = paper_stroke(table_4_mechanism(so_far.assumptions));
  const double place = place_of_largest(stroke, value);
  const auto& worst = stroke[static_cast<std::size_t>(std::lround(place * static_cast<double>(stroke.size() - 1)))];
  claim.equations_give = "largest " + rounded(value(worst), 4) + " " + unit +
                         " at θ = " + rounded(degrees(worst.point.theta), 3) + "°; at the limits " +
                         rounded(value(stroke.front()), 4) + " and " + rounded(value(stroke.back()), 4) + " " + unit;
  return with_verdict(std::move(claim), so_far.assumptions, largest_at_negative_limit(value));
}

Claim same_optimum_claim(const Reproduction& so_far) {
  Claim claim;
  claim.name = "least_tension_is_least_error";
  claim.paper_says = "the joint with the least tension also has the least error";
  const optimize::CertifiedResult least = optimum_of(so_far.assumptions, optimize::Objective::max_error, k_same_value);
  const double of_table_4 =
      optimize::evaluate(optimize::Objective::max_error, table_4_mechanism(so_far.assumptions)).value;
  // The objective is an error per newton of tip force.
  const double force = so_far.assumptions.tip_force;
  claim.equations_give = "largest error " + rounded(of_table_4 * force, 5) + "° at Table 4; the least is " +
                         rounded(least.value * force, 5) + "° at R " + in_mm(least.best[0]) + ", ED " +
                         in_mm(least.best[1]) + ", OE " + in_mm(least.best[2]) + " mm, " +
                         rounded(100.0 * (1.0 - least.value / of_table_4), 2) + " % less";
  return with_verdict(std::move(claim), so_far.assumptions, [](const PaperAssumptions& assumptions) {
    const Lengths lengths = table_4_lengths(assumptions);
    return is_optimal(assumptions, optimize::Objective::max_error, lengths) &&
           is_optimal(assumptions, optimize::Objective::max_tension, lengths);
  });
}

Claim linear_claim(const Reproduction& so_far) {
  Claim claim;
  claim.name = "the_pulley_linearizes";
  claim.paper_says = "the non-circular P2 linearizes the joint";
  constexpr int k_steps = 2000;
  const auto table_4_stroke = paper_stroke(table_4_mechanism(so_far.assumptions), k_steps);
  claim.equations_give = "θ(α) deviates from the best line by ±" + fixed(nonlinearity(table_4_stroke), 2) +
                         "°, and from the least-squares line over α by up to " +
                         fixed(least_squares_nonlinearity(table_4_stroke), 2) +
                         "°: a round P1 alone determines θ(α), and P2 only keeps tendon 2 taut";
  return with_verdict(std::move(claim), so_far.assumptions, [](const PaperAssumptions& assumptions) {
    const auto stroke = paper_stroke(table_4_mechanism(assumptions));
    return !stroke.empty() && nonlinearity(stroke) < k_linear;
  });
}

Claim drawing_claim(const Reproduction& so_far) {
  Claim claim;
  claim.name = "profile_by_drawing_r2_against_alpha";
  claim.paper_says = "P2's profile is r2 drawn against α in polar coordinates";
  Mechanism mechanism = table_4_mechanism(so_far.assumptions);
  mechanism.tendon.diameter = 0.01;  // mm: nearly none, because the paper draws the tendon as a line
  profile::SynthesisOptions options;
  options.advice = false;
  const profile::SynthesisResult drawn = profile::synthesise(mechanism, options);
  claim.verdict = Verdict::does_not_hold;
  if (!drawn.made()) {
    claim.equations_give = "with these numbers it cannot be drawn: " + drawn.brief();
    return claim;
  }
  const double to_floor = -0.5 * mechanism.tendon.diameter;  // from the tendon's centre line to the groove floor
  const profile::RewindResult wound =
      profile::rewind(mechanism, profile::parallel(drawn.p1, to_floor), profile::parallel(drawn.p2, to_floor));
  const auto [low, high] = std::minmax_element(wound.points.begin(), wound.points.end(),
                                               [](const auto& a, const auto& b) { return a.excess < b.excess; });
  claim.equations_give = "a string wound on that drawing is off by " + rounded(low->excess, 2) + " to " +
                         rounded(high->excess, 2) +
                         " mm of tendon 2: r2 is the distance of the tendon's line from the axis, and the profile is "
                         "the envelope of those lines";
  return claim;
}

}  // namespace

bool table_4_is_optimal(const PaperAssumptions& assumptions) {
  return is_optimal(assumptions, optimize::Objective::max_tension, table_4_lengths(assumptions));
}

std::vector<Claim> paper_claims(const Reproduction& so_far, const RunContext& context) {
  std::vector<Claim> claims;
  context.begin_step("claims: the optimum");
  claims.push_back(optimum_claim(so_far));
  context.begin_step("claims: its bounds");
  claims.push_back(bounds_claim(so_far));
  context.begin_step("claims: where in the stroke");
  claims.push_back(place_claim(so_far, "largest_tension_at_negative_limit", "tension T_b", "N", tension));
  claims.push_back(place_claim(so_far, "largest_elongation_at_negative_limit", "elongation", "mm", elongation));
  claims.push_back(place_claim(so_far, "largest_error_at_negative_limit", "joint error", "°", joint_error));
  context.begin_step("claims: tension and error");
  claims.push_back(same_optimum_claim(so_far));
  context.begin_step("claims: the pulley");
  claims.push_back(linear_claim(so_far));
  claims.push_back(drawing_claim(so_far));
  return claims;
}

}  // namespace fusee::paper
