#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "fusee/transmission.h"
#include "support/mechanisms.h"
#include "transmission/load.h"
#include "transmission/torque.h"

namespace fusee::transmission {
namespace {

/// A weight on a lever, horizontal at home, on a joint with drum: a constant motor torque holds it.
Mechanism balanced_arm() {
  Mechanism mechanism = testing::ankle();
  mechanism.pulley.law = Law::torque;
  mechanism.pulley.motor_torque = 900.0;
  mechanism.load = {0.0, 0.0, 1.2, 150.0, radians(80.0)};
  return mechanism;
}

/// A target torque that varies over the angle, against a weight, a force and a spring.
Mechanism arm_with_torque_table() {
  Mechanism mechanism = balanced_arm();
  mechanism.load.tip_force = 4.0;
  mechanism.spring = {400.0, 300.0, radians(-40.0)};
  mechanism.pulley.motor_torque = 0;
  mechanism.pulley.torque_table = "torque.csv";
  for (int degree = -30; degree <= 25; degree += 5)
    mechanism.pulley.torque_rows.push_back({radians(degree), 1000.0 + 200.0 * std::sin(0.05 * degree)});
  return mechanism;
}

/// The target torque of the table between its rows. A quintic spline approximates the sine with a small error.
double target_torque(double theta) { return 1000.0 + 200.0 * std::sin(0.05 * degrees(theta)); }
constexpr double k_spline = 1e-3;

// Closed form of a pulley that balances a weight: the motor's work equals the gain in potential energy.
TEST(TorqueLaw, ConstantTorqueBalancesWeight) {
  const Mechanism arm = balanced_arm();
  const Transmission law(arm);
  ASSERT_FALSE(law.dead_centre());
  const double W = weight_moment(arm.load), M = arm.pulley.motor_torque, tilt = arm.load.tilt;
  for (int degree = -30; degree <= 25; ++degree) {
    const double theta = radians(degree);
    const TransmissionPoint at = law.at_theta(theta);
    EXPECT_NEAR(at.alpha, W / M * (std::cos(tilt - theta) - std::cos(tilt)), 3e-15) << degree;
    EXPECT_NEAR(at.t1.p, at.t1.m * M / (W * std::sin(tilt - theta)), 1e-13) << degree;
    EXPECT_NEAR(at.t2.p, at.t2.m * M / (W * std::sin(tilt - theta)), 1e-13) << degree;
    EXPECT_NEAR(law.theta(at.alpha), theta, 1e-14) << degree;
  }
  EXPECT_EQ(law.alpha(0.0), 0.0);
}

// A spring alone: α = (preload θ + k ((θ − free)² − free²)/2) / M.
TEST(TorqueLaw, ConstantTorqueHoldsSpring) {
  Mechanism arm = balanced_arm();
  arm.load = {};
  arm.spring = {800.0, 100.0, radians(-50.0)};
  const Transmission law(arm);
  const auto [k, preload, free] = std::array{arm.spring.stiffness, arm.spring.preload, arm.spring.free};
  for (const double theta : {-0.5, -0.2, 0.1, 0.4}) {
    const double work = preload * theta + 0.5 * k * ((theta - free) * (theta - free) - free * free);
    EXPECT_NEAR(law.alpha(theta), work / arm.pulley.motor_torque, 1e-15);
  }
}

// Work by Simpson's rule over α, with a torque that is not given to the law as a spline.
TEST(TorqueLaw, MotorWorkEqualsLoadWork) {
  const Mechanism arm = arm_with_torque_table();
  const Transmission law(arm);
  ASSERT_FALSE(law.dead_centre());
  const double W = weight_moment(arm.load), tilt = arm.load.tilt;
  for (const double theta : {-0.5, -0.21, 0.17, 0.43}) {
    const double alpha = law.alpha(theta);
    constexpr int steps = 400;
    double work = 0;
    for (int i = 0; i <= steps; ++i) {
      const int weight_inside = i % 2 == 1 ? 4 : 2;
      const int weight = i == 0 || i == steps ? 1 : weight_inside;
      work += weight * target_torque(law.theta(alpha * i / steps)) * alpha / (3.0 * steps);
    }
    // Tip force 4 N; spring with a preload of 300 N·mm and half a stiffness of 400 N·mm/rad.
    const double raised = W * (std::cos(tilt - theta) - std::cos(tilt)), pushed = 4.0 * arm.joint.R * theta,
                 wound = 300.0 * theta + 200.0 * (std::pow(theta - arm.spring.free, 2) - std::pow(arm.spring.free, 2));
    EXPECT_NEAR(work, raised + pushed + wound, k_spline) << theta;
  }
}

TEST(TorqueLaw, DerivativesAgreeWithDifferences) {
  constexpr double step = 1e-5;
  for (const Mechanism& arm : {balanced_arm(), arm_with_torque_table()}) {
    const Transmission law(arm);
    for (const double u : {0.02, 0.35, 0.71, 0.98}) {
      const double alpha = law.alpha_min() + u * (law.alpha_max() - law.alpha_min());
      const TransmissionPoint before = law.at_alpha(alpha - step), at = law.at_alpha(alpha),
                              after = law.at_alpha(alpha + step);
      EXPECT_NEAR((after.theta - before.theta) / (2 * step), at.g, 1e-8);
      EXPECT_NEAR((after.g - before.g) / (2 * step), at.dg, 1e-7);
      EXPECT_NEAR((after.dg - before.dg) / (2 * step), at.d2g, 1e-5);
      const bool is_constant = arm.pulley.motor_torque != 0;
      const double target = is_constant ? 900.0 : target_torque(at.theta);
      EXPECT_NEAR(at.g * load_torque(arm, at.theta), target, is_constant ? 1e-9 : k_spline);
    }
  }
}

// The motor angle is inversely proportional to the target torque.
TEST(TorqueLaw, AnglesAreInverseToTorque) {
  Mechanism twice = balanced_arm();
  twice.pulley.motor_torque *= 2;
  const Transmission once_law(balanced_arm()), twice_law(twice);
  for (const double theta : {-0.5, 0.2, 0.4}) EXPECT_NEAR(once_law.alpha(theta), 2 * twice_law.alpha(theta), 1e-14);
}

TEST(TorqueLaw, ReportsWhereItFails) {
  Mechanism arm = balanced_arm();
  arm.pulley.motor_torque *= -1;
  EXPECT_EQ(Transmission(arm).dead_centre(), 0.0);
  EXPECT_LT(tightest_torque(arm).slope(), 0);
  // The weight is straight above the axis at 20 deg, within the range, where there is no load to hold.
  arm = balanced_arm();
  arm.load.tilt = radians(20.0);
  const auto end = Transmission(arm).dead_centre();
  ASSERT_TRUE(end);
  EXPECT_NEAR(*end, radians(20.0), radians(1.0));
  const TorqueMatch worst = tightest_torque(arm);
  EXPECT_NEAR(worst.theta, arm.joint.theta_max, 1e-12);
  EXPECT_LT(worst.load, 0);
  EXPECT_EQ(worst.motor, 900.0);
  // Without any load.
  arm.load = {};
  EXPECT_FALSE(tightest_torque(arm).slope() > 0);
  EXPECT_TRUE(Transmission(arm).dead_centre());
}

TEST(TorqueLaw, ExtrapolatesBeyondRange) {
  const Mechanism arm = balanced_arm();
  const Transmission law(arm);
  const double W = weight_moment(arm.load), tilt = arm.load.tilt, theta = arm.joint.theta_max + radians(2.0);
  EXPECT_NEAR(law.alpha(theta), W / 900.0 * (std::cos(tilt - theta) - std::cos(tilt)), 1e-14);
  // The law cannot continue to where the lever of the weight vanishes: it keeps its slope there.
  EXPECT_GT(law.alpha(arm.joint.theta_max + 1.5), law.alpha(arm.joint.theta_max + 1.0));
}

TEST(TorqueLaw, IgnoresOtherCarriedLoads) {
  Mechanism arm = balanced_arm();
  const double alpha = Transmission(arm).alpha(0.3);
  keep_law(arm);
  arm.load = {};
  arm.joint.R += 5.0;
  EXPECT_EQ(Transmission(arm).alpha(0.3), alpha);
  EXPECT_EQ(load_torque(arm, 0.3), 0.0);
}

TEST(TorqueLaw, AddsSpringToLoad) {
  Mechanism arm = balanced_arm();
  const double without = load_torque(arm, 0.2);
  arm.spring = {400.0, 300.0, radians(-40.0)};
  EXPECT_NEAR(load_torque(arm, 0.2) - without, 300.0 + 400.0 * (0.2 + radians(40.0)), 1e-12);
}

}  // namespace
}  // namespace fusee::transmission
