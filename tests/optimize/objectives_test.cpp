#include <gmock/gmock.h>

#include "fusee/base.h"
#include "fusee/mechanism_file.h"
#include "fusee/optimize.h"
#include "fusee/transmission.h"
#include "optimize/objective_at.h"
#include "optimize/problem_text.h"
#include "support/mechanisms.h"
#include "transmission/interval.h"

namespace fusee::optimize {
namespace {

using testing::paper_problem;

/// Maximum of a value of the paper's formulas over a fine stroke, by Transmission: an independent route.
template <typename Value>
double largest(const Mechanism& mechanism, Value value) {
  const transmission::Transmission transmission(mechanism);
  Mechanism loaded = mechanism;
  loaded.load.tip_force = 1.0;
  double most = -1e300;
  for (int i = 0; i <= 2000; ++i) {
    const double theta = mechanism.joint.theta_min + (mechanism.joint.theta_max - mechanism.joint.theta_min) * i / 2000;
    const transmission::TransmissionPoint point = transmission.at_theta(theta);
    most = std::max(most, value(point, transmission::paper_forces(loaded, point)));
  }
  return most;
}

TEST(Objectives, AgreeWithPaperForces) {
  for (Mechanism mechanism : {testing::forearm(), testing::linear_wrist(), testing::unsymmetric()}) {
    for (const Method method : {Method::exact, Method::paper}) {
      mechanism.pulley.method = method;
      const auto value = [&mechanism](Objective objective) { return evaluate(objective, mechanism).value; };
      EXPECT_NEAR(value(Objective::max_tension), largest(mechanism, [](const auto&, const auto& f) { return f.Tb; }),
                  1e-6);
      EXPECT_NEAR(value(Objective::motor_torque),
                  largest(mechanism, [](const auto& p, const auto& f) { return f.Tb * p.t2.p; }), 1e-4);
      EXPECT_NEAR(value(Objective::max_error),
                  largest(mechanism, [](const auto& p, const auto& f) { return degrees(f.elongation / p.t2.m); }),
                  1e-9);
    }
  }
}

TEST(Objectives, ScaleWithTheirUnits) {
  const Mechanism small = testing::forearm(), large = testing::scaled(small, 3.0);
  const auto ratio = [&](Objective objective) {
    return evaluate(objective, large).value / evaluate(objective, small).value;
  };
  EXPECT_NEAR(ratio(Objective::max_tension), 1.0, 1e-9);
  EXPECT_NEAR(ratio(Objective::footprint), 9.0, 1e-8);
  EXPECT_NEAR(ratio(Objective::motor_torque), 3.0, 1e-8);
  EXPECT_NEAR(ratio(Objective::min_bend), 3.0, 1e-8);
}

/// All derivatives used by the proof, compared with finite differences.
TEST(Formulas, DerivativesAgreeWithDifferences) {
  const FileNumbers<double> at = file_numbers(testing::forearm());
  using Member = std::pair<double FileNumbers<double>::*, transmission::Jet FileNumbers<transmission::Jet>::*>;
  const std::vector<Member> members = {{&FileNumbers<double>::R, &FileNumbers<transmission::Jet>::R},
                                       {&FileNumbers<double>::EB, &FileNumbers<transmission::Jet>::EB},
                                       {&FileNumbers<double>::ED, &FileNumbers<transmission::Jet>::ED},
                                       {&FileNumbers<double>::OE, &FileNumbers<transmission::Jet>::OE},
                                       {&FileNumbers<double>::EF, &FileNumbers<transmission::Jet>::EF},
                                       {&FileNumbers<double>::r1, &FileNumbers<transmission::Jet>::r1},
                                       {&FileNumbers<double>::mu, &FileNumbers<transmission::Jet>::mu},
                                       {&FileNumbers<double>::radius, &FileNumbers<transmission::Jet>::radius},
                                       {&FileNumbers<double>::diameter, &FileNumbers<transmission::Jet>::diameter},
                                       {&FileNumbers<double>::theta_min, &FileNumbers<transmission::Jet>::theta_min}};
  for (const ObjectiveInfo& info : objectives()) {
    if (!info.certifiable) continue;
    for (const bool point_pins : {false, true}) {
      for (const auto& [number, jet] : members) {
        const auto value = [&, number = number](double shift) {
          FileNumbers<double> shifted = at;
          shifted.*number += shift;
          transmission::Domain domain;
          return objective_at(info.objective, design_numbers(shifted, Law::compensate, point_pins), 0.1, domain);
        };
        const double step = 1e-5;
        const double difference = (value(step) - value(-step)) / (2 * step);
        const transmission::RoundingUp rounding;
        FileNumbers<transmission::Jet> jets{at.R,       at.EB,        at.ED,       at.OE,     at.EF,
                                            at.r1,      at.ratio,     at.mu,       at.radius, at.diameter,
                                            at.modulus, at.theta_min, at.theta_max};
        jets.*jet = transmission::Jet::variable(at.*number, 0, 1);
        transmission::Domain domain;
        const transmission::Jet result = objective_at(info.objective, design_numbers(jets, Law::compensate, point_pins),
                                                      transmission::Jet(0.1), domain);
        const double slope = result.count == 0 ? 0.0 : result.slope[0].lower();
        EXPECT_NEAR(slope, difference, 1e-6 * (1 + std::abs(difference))) << info.name;
      }
    }
  }
}

TEST(Objectives, HaveNamesOfFile) {
  const Field* field = find_field("optimize.objective");
  ASSERT_NE(field, nullptr);
  ASSERT_EQ(field->choices.size(), objectives().size());
  for (std::size_t i = 0; i < field->choices.size(); ++i) {
    EXPECT_EQ(objectives()[i].name, field->choices[i]);
    EXPECT_EQ(info(find_objective(field->choices[i])).objective, objectives()[i].objective);
  }
}

TEST(Objectives, ReportMissingValues) {
  Mechanism dead = testing::reference();
  dead.joint.theta_max = radians(60.0);
  EXPECT_FALSE(evaluate(Objective::max_tension, dead).possible);
  EXPECT_THAT(evaluate(Objective::max_tension, dead).reason, ::testing::HasSubstr("moment arm"));
  EXPECT_FALSE(evaluate(Objective::min_bend, dead).possible);
  Mechanism large = testing::reference();
  large.pulley.r1 = 200.0;
  EXPECT_THAT(evaluate(Objective::max_tension, large).reason, ::testing::HasSubstr("lies inside pulley"));
  EXPECT_EQ(evaluate(Objective::max_tension, large).cost(Objective::max_tension), 1e300);
}

// The pulley of a torque law keeps its law when evaluated with a newton of tip force: [6] and virtual work.
TEST(Objectives, TorqueLawKeepsItsLoad) {
  Mechanism arm = testing::ankle();
  arm.guides.mu = 0;
  arm.pulley.law = Law::torque;
  arm.pulley.motor_torque = 900.0;
  arm.load.torque = 500.0;
  arm.spring = {400.0, 700.0, radians(-40.0)};
  const Evaluation evaluation = evaluate(Objective::motor_torque, arm);
  ASSERT_TRUE(evaluation.possible) << evaluation.reason;
  // Largest where the load is smallest, at the lower end: M/τ of a newton at the length R. There τ is the load of 500
  // and the spring with 700 + 400 (θ + 40°), N·mm.
  EXPECT_NEAR(evaluation.value, 900.0 / (1200.0 + 400.0 * radians(10.0)) * arm.joint.R, 1e-9);
  arm.pulley.motor_torque = -900.0;
  EXPECT_NE(evaluate(Objective::motor_torque, arm).reason.find("does not hold the load"), std::string::npos);
}

TEST(Problem, AppliesTiesAndConstraints) {
  const Problem problem = paper_problem();
  EXPECT_EQ(mechanism_at(problem, {200, 80, 10}).guides.EB, 80.0);
  EXPECT_EQ(constraint_violation(problem, {200, 100, 10}), 0.0);
  EXPECT_GT(constraint_violation(problem, {200, 100.001, 10}), 0.0);
  EXPECT_FALSE(evaluate_design(problem, Objective::max_tension, {200, 110, 10}).possible);
}

// An optimum at the bound of a constraint was written as EB_mm = 49.99999999999999.
TEST(Problem, MovesNumbersToBoundsWithinRounding) {
  const Problem problem = paper_problem();
  EXPECT_EQ(moved_to_bounds(problem, {100.00000000000001, 49.99999999999999, -39.99999999999999}),
            (Design{100, 50, -40}));
  EXPECT_EQ(moved_to_bounds(problem, {200, 99.99999999999999, 10}), (Design{200, 100, 10}));
  EXPECT_EQ(moved_to_bounds(problem, {200, 99.9999, 10.000001}), (Design{200, 99.9999, 10.000001}));
}

TEST(Problem, RejectsVariableWithoutEffect) {
  const auto message = [](const std::vector<Setting>& settings) {
    try {
      paper_problem(settings);
    } catch (const InputError& error) {
      return error.diagnostics().front().message;
    }
    return std::string("accepted");
  };
  EXPECT_THAT(message({{"optimize.variables", R"(["joint.length_mm", "guides.ED_mm", "body.min_wall_mm"])"},
                       {"optimize.lower", "[100, 30, 1]"},
                       {"optimize.upper", "[300, 150, 2]"}}),
              ::testing::HasSubstr("body.min_wall_mm has no effect on max_tension"));
  EXPECT_THAT(message({{"optimize.variables", R"(["pulley.EF_mm"])"},
                       {"optimize.lower", "[50]"},
                       {"optimize.upper", "[90]"},
                       {"optimize.tied", "[]"},
                       {"optimize.constraints", "[]"},
                       {"guides.friction", "0"}}),
              ::testing::HasSubstr("pulley.EF_mm has no effect"));
  EXPECT_EQ(message({}), "accepted");
}

}  // namespace
}  // namespace fusee::optimize
