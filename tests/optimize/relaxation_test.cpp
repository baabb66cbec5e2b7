#include "optimize/relaxation.h"

#include <gmock/gmock.h>

#include "optimize/conditions_at.h"
#include "optimize/random.h"
#include "profile/take_off.h"
#include "support/mechanisms.h"

namespace fusee::optimize {
namespace {

/// min max over two lines and one condition, solved by hand: t = max(x, 1 − x) with x + y <= 0.4 gives x = 0.4, t =
/// 0.6.
TEST(LinearProgram, SolvesSmallExample) {
  LinearProgram program;
  program.variables = 2;
  program.least_t = -5;
  program.rows = {{{1, 0}, 0, 1}, {{-1, 0}, 1, 1}, {{1, 1}, -0.4, 0}};
  const LinearAnswer answer = solve(program, 1e9);
  EXPECT_TRUE(answer.possible);
  EXPECT_NEAR(answer.t, 0.6, 1e-7);
  EXPECT_NEAR(answer.y[0], 0.4, 1e-7);
}

/// Random programs: no random point that satisfies the conditions is below the proven bound, and none exists if the
/// program is infeasible.
TEST(LinesBelow, ProveOnlyValidBounds) {
  Random random(1);
  int empty = 0, bounded = 0;
  for (int trial = 0; trial < 400; ++trial) {
    Box box;
    for (std::size_t i = 0; i < 3; ++i) {
      box.lower[i] = -random.fraction();
      box.upper[i] = 1 + random.fraction();
    }
    std::vector<LineBelow> lines;
    for (int r = 0; r < 6; ++r) {
      LineBelow line;
      line.of_objective = r < 3;
      line.constant = 2 * random.fraction() - (r < 3 ? 0.0 : 0.6);
      for (std::size_t i = 0; i < 3; ++i) {
        line.slope[i] = 4 * random.fraction() - 2;
        line.corner[i] = box.lower[i];
      }
      lines.push_back(line);
    }
    Box left = box;
    const LeastOfLines least = least_of_lines(left, 3, lines, -1e300, 1e300);
    double lowest = 1e300;
    for (int k = 0; k < 3000; ++k) {
      std::array<double, 3> x{};
      for (std::size_t i = 0; i < 3; ++i) x[i] = box.lower[i] + random.fraction() * (box.upper[i] - box.lower[i]);
      double objective = -1e300, worst = -1e300;  // worst: of the conditions, which must be at most 0
      for (const LineBelow& line : lines) {
        double value = line.constant;
        for (std::size_t i = 0; i < 3; ++i) value += line.slope[i] * (x[i] - line.corner[i]);
        double& maximum = line.of_objective ? objective : worst;
        maximum = std::max(maximum, value);
      }
      if (worst <= 0) lowest = std::min(lowest, objective);
      if (worst <= 0) {
        for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(x[i] >= left.lower[i] && x[i] <= left.upper[i]);
      }
    }
    if (lowest < 1e300) {
      EXPECT_TRUE(least.possible);
      EXPECT_LE(least.bound, lowest);
      ++bounded;
    }
    if (!least.possible) ++empty;
  }
  EXPECT_GT(bounded, 100);
  EXPECT_GT(empty, 10);
}

/// The formulas of a proof, for a box that is a design, agree with those that draw a pulley.
TEST(Conditions, AgreeWithDrawing) {
  for (const Mechanism& mechanism : {testing::forearm(), testing::linear_wrist(), testing::unsymmetric()}) {
    const transmission::Transmission transmission(mechanism);
    const auto d = design_numbers(file_numbers(mechanism), mechanism.pulley.law, mechanism.has_point_pins());
    const double range = mechanism.joint.theta_max - mechanism.joint.theta_min;
    for (const double place : {0.0, 0.3, 0.8, 1.0}) {
      ConditionValues<double> values;
      ASSERT_TRUE(conditions_at(d, place, k_max_conditions, values));
      const auto value = [&](DesignCondition which) { return values[static_cast<std::size_t>(which)].value; };
      const double theta = mechanism.joint.theta_min + place * range;
      const profile::TakeOff left = profile::TakeOffs(transmission, transmission::Side::left).at(-theta),
                             right = profile::TakeOffs(transmission, transmission::Side::right).at(theta);
      EXPECT_NEAR(value(DesignCondition::wrap_B), left.stroke.t1.wrap, 1e-9);
      EXPECT_NEAR(value(DesignCondition::wrap_D), right.stroke.t2.wrap, 1e-9);
      EXPECT_NEAR(value(DesignCondition::advance_1), left.dpsi, 1e-9);
      EXPECT_NEAR(value(DesignCondition::advance_2), right.dpsi, 1e-9);
      const double least = d.half + profile::k_least_floor_radius;
      EXPECT_NEAR(value(DesignCondition::floor_1), (left.curve.radius - least) * std::pow(left.dpsi, 3), 1e-7);
      EXPECT_NEAR(value(DesignCondition::floor_2), (right.curve.radius - least) * std::pow(right.dpsi, 3), 1e-7);
    }
  }
}

}  // namespace
}  // namespace fusee::optimize
