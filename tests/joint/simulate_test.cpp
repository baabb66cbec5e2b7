// Simulation along a log: agreement with predict(), and the other results.
#include <gmock/gmock.h>

#include <cmath>

#include "fusee/joint.h"
#include "fusee/transmission.h"
#include "mechanism/effect.h"
#include "support/mechanisms.h"

namespace fusee::joint {
namespace {

/// A cycle over most of the range.
BenchLog swept(double load) {
  BenchRun run;
  run.has_load = true;
  for (int i = 0; i <= 160; ++i) {
    const double share = i <= 80 ? i / 80.0 : 2.0 - i / 80.0;
    run.rows.push_back({0.25 * i, std::lerp(-1.6, 1.6, share), load, 0});
  }
  return {run};
}

Imperfections several_imperfections() {
  Imperfections errors;
  errors.shaft.backlash = 0.02;
  errors.tendon.stretch = 0.5;
  errors.sensor.gain = 0.01;
  errors.sensor.zero = -0.003;
  return errors;
}

TEST(Simulate, AgreesWithPrediction) {
  const DeclaredMechanism joint = testing::forearm();
  for (const Imperfections& errors : {Imperfections{}, several_imperfections()}) {
    for (const double load : {0.0, 12.0}) {
      const Readings predicted = predict(joint, errors, swept(load));
      const auto states = joint::simulate(joint, errors, swept(load));
      ASSERT_EQ(states.front().size(), predicted.front().size());
      for (std::size_t i = 0; i < states.front().size(); ++i) EXPECT_EQ(states[0][i].shown, predicted[0][i]);
    }
  }
}

TEST(Simulate, DistinguishesAngleAndReading) {
  const Imperfections errors = several_imperfections();
  const auto states = joint::simulate(testing::forearm(), errors, swept(5));
  for (const JointState& state : states.front())
    EXPECT_NEAR(state.shown, errors.sensor.zero + (1 + errors.sensor.gain) * state.theta, 1e-14);
}

/// Dwells of `rows` rows at several angles, with unlogged motion between them.
BenchLog dwells_at_angles(int rows) {
  BenchRun run;
  double time = 0;
  for (const double alpha : {-1.2, -0.4, 0.4, 1.2, 0.4, -0.4}) {
    time += 1.0;
    for (int k = 0; k < rows; ++k) run.rows.push_back({time += 0.1, alpha, 0, 0});
  }
  return {run};
}

// A point-to-point log is read after settling: the first row of a dwell is not part of the motion.
TEST(Simulate, DelayEndsAtDwells) {
  for (const double first_order : {0.0, 1.0}) {
    Imperfections late;
    late.sensor.lag = 0.3;
    late.sensor.first_order = first_order;
    const Readings still = predict(testing::forearm(), {}, dwells_at_angles(4));
    const Readings shown = predict(testing::forearm(), late, dwells_at_angles(4));
    for (std::size_t i = 0; i < still.front().size(); ++i) EXPECT_NEAR(shown[0][i], still[0][i], 1e-8) << i;
    // With logged motion the same sensor is delayed.
    const double delay =
        predict(testing::forearm(), late, swept(0))[0][40] - predict(testing::forearm(), {}, swept(0))[0][40];
    EXPECT_LT(delay, -1e-3);
  }
}

// Virtual work: motor torque times dα equals load torque times dθ, up to friction.
TEST(Simulate, MotorWorkEqualsLoadWork) {
  DeclaredMechanism joint = testing::forearm();
  joint.guides.mu = 0;
  joint.pulley.mu = 0;
  joint.tendon.modulus = 4e6;
  const transmission::Transmission law(joint);
  const double force = 15;
  const BenchLog log = swept(force);
  const std::vector<JointState> states = joint::simulate(joint, {}, log).front();
  for (std::size_t i = 20; i < states.size(); i += 20) {
    const transmission::TransmissionPoint point = law.at_alpha(log[0].rows[i].alpha);
    EXPECT_NEAR(states[i].motor_torque, force * joint.joint.R * point.g, 0.01 * force * joint.joint.R * point.g);
    EXPECT_NEAR(states[i].motor_torque, states[i].t2.lower * point.t2.p - states[i].t1.lower * point.t1.p, 0.2);
  }
}

TEST(Simulate, ReportsLooseJoint) {
  Imperfections errors;
  errors.tendon.slack = 3;
  DeclaredMechanism joint = testing::forearm();
  bool loose = false;
  const auto states = joint::simulate(joint, errors, swept(0));
  for (const JointState& state : states.front()) {
    if (state.status != EquilibriumStatus::loose) continue;
    loose = true;
    EXPECT_GT(state.loose, 0);
    EXPECT_LT(state.t1.lower, 1e-6);  // N: less tension holds nothing
  }
  EXPECT_TRUE(loose);
}

// Slack is the length beyond that taken up by pretension. With slack there is no pretension, so that no second
// parameter has the effect of the first.
TEST(Simulate, SlackExcludesPretension) {
  Imperfections errors;
  errors.tendon.slack = 0.3;
  const DeclaredMechanism joint = testing::forearm();
  const Readings loose = predict(joint, errors, swept(10));
  for (const double more : {-joint.tendon.pretension, 7.0}) {
    errors.tendon.pretension = more;
    EXPECT_EQ(predict(joint, errors, swept(10)), loose) << more;
  }
  errors.tendon.slack = 0;
  EXPECT_NE(predict(joint, errors, swept(10)), predict(joint, {}, swept(10))) << "taut, 7 N more";
}

// A fit may end between a taut and a slack tendon, where a share of the pretension remains. As numbers of the joint these
// are a smaller pretension and no slack.
TEST(Simulate, SettledSlackIsSmallerPretension) {
  const Effect& slack = *find_effect("slack", JointKind::tendons);
  const DeclaredMechanism joint = testing::forearm();
  Imperfections errors;
  errors.tendon.slack = 0.75e-3;
  errors.tendon.pretension = 2;
  Imperfections settled = errors;
  slack.settle(settled, joint);
  EXPECT_EQ(settled.tendon.slack, 0);
  EXPECT_NEAR(joint.tendon.pretension + settled.tendon.pretension, 0.25 * (joint.tendon.pretension + 2), 1e-12);
  const Readings of_fit = predict(joint, errors, swept(10)), of_settled = predict(joint, settled, swept(10));
  for (std::size_t i = 0; i < of_fit[0].size(); ++i) EXPECT_NEAR(of_fit[0][i], of_settled[0][i], 2e-5) << i;
  for (const double length : {0.0, 0.3}) {
    errors.tendon.slack = length;
    settled = errors;
    slack.settle(settled, joint);
    EXPECT_EQ(settled, errors);
  }
}

DeclaredMechanism geared(double ratio) {
  DeclaredMechanism joint;
  joint.transmission = RatioTransmission{ratio};
  return joint;
}

TEST(Simulate, RatioJointHasAnglesOnly) {
  const auto states = joint::simulate(geared(4), {}, swept(0));
  for (const JointState& state : states.front()) {
    EXPECT_TRUE(std::isfinite(state.theta));
    EXPECT_TRUE(std::isnan(state.motor_torque));
  }
}

TEST(Simulate, RatioCurveIsSeriesOfAngleAndLoad) {
  Imperfections errors;
  errors.ratio_joint.compliance = 0.004;
  errors.ratio_joint.curve = {
      .linear = 0.01, .square = 0.03, .cube = -0.02, .compliance_slope = 0.002, .compliance_square = -0.001};
  const BenchLog log = swept(5);
  const Readings shown = predict(geared(2), errors, log);
  for (std::size_t i = 0; i < log[0].rows.size(); ++i) {
    const double u = log[0].rows[i].alpha / 2;
    const double compliance = 0.004 + 0.002 * u - 0.001 * u * u;
    EXPECT_NEAR(shown[0][i], 1.01 * u + 0.03 * u * u - 0.02 * u * u * u - compliance * 5, 1e-14);
  }
}

/// A cycle at constant load, during which the joint warms up.
BenchLog swept_while_warming() {
  BenchLog log = swept(5);
  log[0].has_temperature = true;
  for (BenchRow& row : log[0].rows) row.temperature_C = 20 + row.time;
  return log;
}

TEST(Simulate, EveryRatioJointEffectMovesJoint) {
  const Readings declared = predict(geared(2), {}, swept_while_warming());
  for (const Effect& effect : effects(JointKind::ratio)) {
    Imperfections errors;
    for (std::size_t k = 0; k < effect.parameters.size(); ++k) {
      const EffectParameter& parameter = effect.parameters[k];
      const double searched = effect.starts.empty() ? 1.0 : effect.starts[0][k];
      set_value(errors, parameter, parameter.searched ? searched : std::min(0.1, parameter.most));
    }
    EXPECT_NE(predict(geared(2), errors, swept_while_warming()), declared) << effect.name;
  }
}

// The error of a rotated encoder is shifted in phase; the simulated joint is the same.
TEST(Simulate, AccountsForEncoderRotation) {
  Imperfections errors;
  errors.sensor.eccentricity_sin = 0.02;
  BenchLog log = swept(0);
  log[0].mounting.joint_sensor_turned = 0.5;
  const double phase = 0.5;
  const auto states = joint::simulate(testing::forearm(), errors, log);
  for (const JointState& state : states.front())
    EXPECT_NEAR(state.shown - state.theta, 0.02 * (std::sin(state.theta + phase) - std::sin(phase)), 1e-14);
}

}  // namespace
}  // namespace fusee::joint
