#include "paper/reproduction.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "fusee/optimize.h"
#include "paper/steps.h"
#include "paper/windows.h"
#include "profile/take_off.h"
#include "transmission/alpha_range.h"

namespace fusee::paper {
namespace {

// The paper's optimum and its bounds: R, EB = ED and OE, in its unit of length.
constexpr double k_table_4[] = {1.0, 0.5, -0.4};
constexpr double k_lower[] = {1.0, 0.3, -0.4};
constexpr double k_upper[] = {3.0, 1.5, 0.5};

/// Ratio dα/dθ of the linear law with the same motor stroke.
double same_stroke_ratio(const Mechanism& mechanism) {
  const transmission::Transmission transmission(mechanism);
  return (transmission.alpha_max() - transmission.alpha_min()) /
         (mechanism.joint.theta_max - mechanism.joint.theta_min);
}

LawCost law_cost(const Mechanism& mechanism, const std::string& name) {
  LawCost cost;
  cost.law = name;
  constexpr int k_steps = 180;
  const std::vector<StrokePlace> stroke = paper_stroke(mechanism, k_steps);
  cost.nonlinearity = nonlinearity(stroke);
  cost.r1_least = cost.r1_most = stroke.front().point.t1.p;
  cost.r2_least = cost.r2_most = stroke.front().point.t2.p;
  double least_torque = 1e300, most_torque = 0;
  for (const StrokePlace& place : stroke) {
    cost.r1_least = std::min(cost.r1_least, place.point.t1.p);
    cost.r1_most = std::max(cost.r1_most, place.point.t1.p);
    cost.r2_least = std::min(cost.r2_least, place.point.t2.p);
    cost.r2_most = std::max(cost.r2_most, place.point.t2.p);
    const double torque = place.forces.Tb * place.point.t2.p / mechanism.load.tip_force;
    least_torque = std::min(least_torque, torque);
    most_torque = std::max(most_torque, torque);
  }
  cost.bend_radius = optimize::evaluate(optimize::Objective::min_bend, mechanism).value;
  cost.tension = optimize::evaluate(optimize::Objective::max_tension, mechanism).value;
  cost.torque = most_torque;
  cost.torque_ripple = most_torque / least_torque;
  return cost;
}

std::vector<MuWindow> mu_windows(const PaperAssumptions& assumptions) {
  constexpr double k_lowest = 0.01, k_highest = 0.51;
  constexpr int k_steps = 20;
  std::vector<MuWindow> all;
  for (const double r1 : {10.0, 15.0, 20.0}) {            // mm
    for (const double EF : {40.0, 60.0, 100.0, 150.0}) {  // mm
      PaperAssumptions changed = assumptions;
      changed.r1 = r1;
      changed.EF = EF;
      const auto holds = [&changed](double mu) {
        changed.mu = mu;
        return table_4_is_optimal(changed);
      };
      all.push_back({r1, EF, windows_where(holds, k_lowest, k_highest, k_steps)});
    }
  }
  return all;
}

}  // namespace

std::string_view verdict_text(Verdict verdict) {
  switch (verdict) {
    case Verdict::holds:
      return "holds";
    case Verdict::holds_only_if:
      return "holds only if";
    case Verdict::does_not_hold:
      return "does not hold";
  }
  return "";
}

Mechanism paper_mechanism(const PaperAssumptions& assumptions, double R, double ED, double OE) {
  Mechanism mechanism = default_mechanism();
  mechanism.name = "the paper's joint";
  mechanism.joint = {R, radians(-30.0), radians(30.0)};
  mechanism.guides = {ED, ED, OE, 0.0, assumptions.mu};
  mechanism.pulley.EF = assumptions.EF;
  mechanism.pulley.r1 = assumptions.r1;
  mechanism.pulley.method = Method::paper;
  mechanism.tendon.diameter = assumptions.diameter;
  mechanism.tendon.modulus = assumptions.modulus;
  mechanism.load.tip_force = assumptions.tip_force;
  return mechanism;
}

Mechanism table_4_mechanism(const PaperAssumptions& assumptions) {
  const double unit = assumptions.unit;
  return paper_mechanism(assumptions, k_table_4[0] * unit, k_table_4[1] * unit, k_table_4[2] * unit);
}

MechanismFile paper_problem_file(const PaperAssumptions& assumptions) {
  MechanismFile file;
  file.path = "the paper's problem";
  file.mechanism = DeclaredMechanism(table_4_mechanism(assumptions));
  Optimization& table = file.mechanism.optimize;
  table.objectives = {"max_tension"};
  table.variables = {"joint.length_mm", "guides.ED_mm", "guides.OE_mm"};
  for (int i = 0; i < 3; ++i) {
    table.lower.push_back(k_lower[i] * assumptions.unit);
    table.upper.push_back(k_upper[i] * assumptions.unit);
  }
  table.tied = {"guides.EB_mm = guides.ED_mm"};
  table.constraints = {"guides.EB_mm <= 0.5 * joint.length_mm"};
  return file;
}

std::vector<StrokePlace> paper_stroke(const Mechanism& mechanism, int steps) {
  std::vector<StrokePlace> stroke;
  const transmission::Transmission transmission(mechanism);
  if (transmission.dead_centre()) return stroke;
  for (const double alpha : transmission::alphas_over_range(transmission, steps)) {
    const transmission::TransmissionPoint point = transmission.at_alpha(alpha);
    stroke.push_back({point, transmission::paper_forces(mechanism, point)});
  }
  return stroke;
}

/// The best line minimises the largest distance (Chebyshev). That distance is convex in the line's slope, so ternary
/// search finds the minimum.
double nonlinearity(const std::vector<StrokePlace>& stroke) {
  const auto deviation = [&stroke](double slope) {
    double low = 1e300, high = -1e300;
    for (const StrokePlace& place : stroke) {
      const double residual = place.point.theta - slope * place.point.alpha;
      low = std::min(low, residual);
      high = std::max(high, residual);
    }
    return 0.5 * (high - low);
  };
  const double mean = (stroke.back().point.theta - stroke.front().point.theta) /
                      (stroke.back().point.alpha - stroke.front().point.alpha);
  constexpr int k_steps = 100;  // (2/3)^100 of the interval is below the rounding of its ends
  double low = 0.5 * mean, high = 1.5 * mean;
  for (int i = 0; i < k_steps; ++i) {
    const double lower_third = low + (high - low) / 3, upper_third = high - (high - low) / 3;
    if (deviation(lower_third) < deviation(upper_third))
      high = upper_third;
    else
      low = lower_third;
  }
  return degrees(deviation(0.5 * (low + high)));
}

double least_squares_nonlinearity(const std::vector<StrokePlace>& stroke) {
  double n = 0, sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0;
  for (const StrokePlace& place : stroke) {
    const double x = place.point.alpha, y = place.point.theta;
    n += 1;
    sum_x += x;
    sum_y += y;
    sum_xx += x * x;
    sum_xy += x * y;
  }
  const double slope = (n * sum_xy - sum_x * sum_y) / (n * sum_xx - sum_x * sum_x);
  const double offset = (sum_y - slope * sum_x) / n;
  double most = 0;
  for (const StrokePlace& place : stroke)
    most = std::max(most, std::abs(place.point.theta - offset - slope * place.point.alpha));
  return degrees(most);
}

std::vector<LawCost> law_costs(const PaperAssumptions& assumptions) {
  const Mechanism compensate = table_4_mechanism(assumptions);
  Mechanism linear = compensate;
  linear.pulley.law = Law::linear;
  linear.pulley.ratio = same_stroke_ratio(compensate);
  return {law_cost(compensate, "compensate"), law_cost(linear, "linear")};
}

Reproduction reproduce_paper(const PaperAssumptions& assumptions, const RunContext& context) {
  Reproduction all;
  all.assumptions = assumptions;
  context.begin_step("Table 4: the certified optimum");
  const optimize::Problem problem = optimize::make_problem(paper_problem_file(assumptions));
  const optimize::CertifiedResult optimum = optimize::certified_optimum(problem, optimize::Objective::max_tension);
  all.optimum = optimum.value;
  all.relative_gap = optimum.relative_gap;
  for (std::size_t i = 0; i < 3; ++i) {
    const optimize::Variable& variable = problem.variables[i];
    all.table_4.push_back({i == 1 ? "EB = ED" : variable.symbol, variable.lower, variable.upper,
                           k_table_4[i] * assumptions.unit, optimum.best[i]});
  }
  context.begin_step("Fig. 7: the genetic algorithm");
  all.figures = paper_figures(assumptions, optimize::genetic_optimum(problem, optimize::Objective::max_tension));
  all.claims = paper_claims(all, context);
  context.begin_step("both laws beside each other");
  all.laws = law_costs(assumptions);
  context.begin_step("where in mu Table 4 is the optimum, for other r1 and EF");
  all.mu_windows = mu_windows(assumptions);
  return all;
}

}  // namespace fusee::paper
