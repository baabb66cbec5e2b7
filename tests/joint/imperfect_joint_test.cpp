// Effects of imperfections of a joint with tendons on its sensor readings.
#include <gtest/gtest.h>

#include "fusee/joint.h"
#include "joint/creep_memory.h"
#include "joint/forward.h"
#include "support/mechanisms.h"

namespace fusee::joint {
namespace {

/// A cycle over 90 % of the range, with a row each second. `load` in N.
BenchRun swept(const Mechanism& mechanism, double load) {
  const transmission::Transmission law(mechanism);
  BenchRun run;
  run.has_load = true;
  for (int i = 0; i <= 240; ++i) {
    const double share = std::sin(k_two_pi * i / 240.0);
    run.rows.push_back({1.0 * i, share * 0.9 * (share > 0 ? law.alpha_max() : -law.alpha_min()), load, 20});
  }
  return run;
}

/// The mirrored log.
BenchLog mirrored(BenchLog log) {
  for (BenchRun& run : log) {
    for (BenchRow& row : run.rows) {
      row.alpha = -row.alpha;
      row.load = -row.load;
    }
  }
  return log;
}

double rms(const std::vector<double>& one, const std::vector<double>& other) {
  double squares = 0;
  for (std::size_t i = 0; i < one.size(); ++i) squares += (one[i] - other[i]) * (one[i] - other[i]);
  return std::sqrt(squares / static_cast<double>(one.size()));
}

TEST(Pins, MirroredJointHasMirroredPins) {
  Mechanism mechanism = testing::linear_wrist();
  mechanism.guides.EB = 44;
  mechanism.tendon.pretension = 0;
  const BenchLog log{swept(mechanism, 6)};
  Imperfections left, right;
  left.pins.left = {1.2, -0.7};
  right.pins.right = left.pins.left;
  Mechanism other = testing::mirrored(mechanism);
  const std::vector<double> readings = predict(mechanism, left, log)[0],
                            mirrored_readings = predict(other, right, mirrored(log))[0];
  EXPECT_GT(rms(readings, predict(mechanism, {}, log)[0]), radians(0.05));
  for (std::size_t i = 0; i < readings.size(); ++i) EXPECT_NEAR(readings[i], -mirrored_readings[i], 1e-7) << i;
}

TEST(Pins, MovedPinsEqualOtherDeclaration) {
  // A pulley of the declared mechanism between pins that another file declares: unloaded, with taut tendons only.
  Mechanism mechanism = testing::linear_wrist();
  const BenchLog log{swept(mechanism, 6)};
  Imperfections both;
  both.pins.left = {0.8, 0.5};
  both.pins.right = {0.3, 0.5};
  Mechanism moved = mechanism;
  moved.guides.EB += 0.8;
  moved.guides.ED += 0.3;
  moved.guides.OE += 0.5;
  moved.pulley.EF -= 0.5;
  Forward forward(moved, log, mechanism);
  EXPECT_LT(rms(predict(mechanism, both, log)[0], forward({})[0]), 1e-9);
}

/// A path error, for example due to a moving joint centre.
Imperfections wandering() {
  Imperfections errors;
  errors.joint.path1 = {-0.1, 2.5, -0.8};
  errors.joint.path2 = {0.2, -1.5, 0.6};
  return errors;
}

TEST(Paths, MirroredJointHasMirroredPaths) {
  const Mechanism mechanism = testing::linear_wrist();
  const BenchLog log{swept(mechanism, 6)};
  const Imperfections errors = wandering();
  Imperfections other = errors;
  std::swap(other.joint.path1, other.joint.path2);
  const std::vector<double> readings = predict(mechanism, errors, log)[0];
  const std::vector<double> mirrored_readings = predict(testing::mirrored(mechanism), other, mirrored(log))[0];
  EXPECT_GT(rms(readings, predict(mechanism, {}, log)[0]), radians(0.05));
  for (std::size_t i = 0; i < readings.size(); ++i) EXPECT_NEAR(readings[i], -mirrored_readings[i], 1e-7) << i;
}

// Virtual work of both tensions over a small rotation, with lengths by differences.
TEST(Paths, SatisfyVirtualWork) {
  Mechanism mechanism = testing::linear_wrist();
  mechanism.tendon.pretension = 40;
  const Imperfections errors = wandering();
  const auto length = [&](transmission::Side side, double theta) {
    const double image = side == transmission::Side::left ? -theta : theta;
    const PathError& longer = side == transmission::Side::left ? errors.joint.path1 : errors.joint.path2;
    return transmission::upper_span(transmission::pin_place(mechanism, side, mechanism.seen_pitch_radius()), image)
               .length +
           longer.slope * image + longer.square * std::pow(image, 2) + longer.cube * std::pow(image, 3);
  };
  constexpr double step = 1e-5;
  double most = 0;
  const auto states = joint::simulate(mechanism, errors, {swept(mechanism, 0)});
  for (const JointState& state : states.front()) {
    const auto work = [&](transmission::Side side, double tension) {
      return tension * (length(side, state.theta + step) - length(side, state.theta - step)) / (2 * step);
    };
    const double left = work(transmission::Side::left, state.t1.upper),
                 right = work(transmission::Side::right, state.t2.upper);
    EXPECT_NEAR(left + right, 0.0, 1e-6 * std::abs(left)) << state.theta;
    most = std::max(most, std::abs(state.t1.upper - state.t2.upper));
  }
  EXPECT_GT(most, 1.0) << "the tensions differ, N";
}

// Virtual work of both tensions and the load over a small rotation, with lengths by differences.
TEST(Rubbing, FollowsFrictionLaws) {
  Mechanism mechanism = testing::linear_wrist();
  mechanism.tendon.pretension = 40;
  mechanism.tendon.modulus = 2000;
  constexpr double step = 1e-5;
  const auto arm = [&](transmission::Side side, double theta) {
    const auto length = [&](double at) {
      return transmission::upper_span(transmission::pin_place(mechanism, side, mechanism.seen_pitch_radius()),
                                      side == transmission::Side::left ? -at : at)
          .length;
    };
    return std::abs(length(theta + step) - length(theta - step)) / (2 * step);
  };
  const BenchLog log{swept(mechanism, 6)};
  for (const RubbingError& rubbing : {RubbingError{200, 0}, {0, 200}, {100, 100}}) {
    Imperfections errors;
    errors.joint.rubbing = rubbing;
    const std::vector<JointState> states = joint::simulate(mechanism, errors, log).front();
    int moved = 0, rested = 0;
    double least = 1e9, most = 0;  // of the dry friction, N·mm
    for (std::size_t i = 1; i < states.size(); ++i) {
      const auto& [t1, t2] = std::pair(states[i].t1.upper, states[i].t2.upper);
      const double theta = states[i].theta, turned = theta - states[i - 1].theta;
      const double pull = t2 * arm(transmission::Side::right, theta) - t1 * arm(transmission::Side::left, theta) -
                          6 * mechanism.joint.R;
      // k_usual_pull is 10 N: (T/10 N)^(2/3) = ∛T²/∛100.
      const double dry = rubbing.by_area * (std::cbrt(t1 * t1) + std::cbrt(t2 * t2)) / (2 * std::cbrt(100.0)) +
                         rubbing.by_lesser * std::min(t1, t2) / 10;
      if (std::abs(turned) > 1e-9) {
        EXPECT_NEAR(pull, std::copysign(dry, turned), 2e-3 * dry) << i;
        ++moved;
      } else {
        EXPECT_LE(std::abs(pull), (1 + 1e-3) * dry) << i;
        ++rested;
      }
      least = std::min(least, dry);
      most = std::max(most, dry);
    }
    EXPECT_GT(moved, 100);
    EXPECT_GT(rested, 5) << "behind its reversals";
    EXPECT_GT(most, 1.02 * least) << "friction grows with the tensions";
  }
}

TEST(Sheath, ErrorsEqualOtherDeclaration) {
  const Mechanism mechanism = testing::sheathed_wrist();
  const BenchLog log{swept(mechanism, 6)};
  Imperfections errors;
  errors.sheath = {0.1, 0.004};
  Mechanism rougher = mechanism, bent = mechanism;
  rougher.sheath.stiffness = bent.sheath.stiffness = 1.0 / (1.0 / mechanism.sheath.stiffness + 0.004);
  rougher.sheath.mu += 0.1 / mechanism.sheath.bend;
  bent.sheath.bend += 0.1 / mechanism.sheath.mu;
  const std::vector<double> readings = predict(mechanism, errors, log)[0];
  EXPECT_GT(rms(readings, predict(mechanism, {}, log)[0]), radians(0.02));
  // Only the product of friction and bends matters.
  for (const Mechanism& other : {rougher, bent}) EXPECT_LT(rms(readings, predict(other, {}, log)[0]), 1e-9);
}

TEST(Sheath, RigidStraightSheathTakesIdentifiedValues) {
  Mechanism straight = testing::sheathed_wrist();
  straight.sheath.bend = 0;
  straight.sheath.stiffness = 0;
  const Mechanism usual = testing::sheathed_wrist();
  Imperfections errors;
  errors.sheath = {usual.sheath.mu * usual.sheath.bend, 1.0 / usual.sheath.stiffness};
  const BenchLog log{swept(straight, 6)};
  EXPECT_LT(rms(predict(straight, errors, log)[0], predict(usual, {}, log)[0]), 1e-9);
  // Values below zero count as zero.
  errors.sheath = {-1, -1};
  EXPECT_EQ(predict(straight, errors, log), predict(straight, {}, log));
}

TEST(Creep, ActsAsGrowingStretch) {
  // Without pretension only the load strains the tendons: a long dwell equals a softer tendon.
  Mechanism mechanism = testing::linear_wrist();
  mechanism.tendon.pretension = 0;
  mechanism.guides.mu = 0;
  BenchRun dwell;
  dwell.has_load = true;
  for (int i = 0; i < 600; ++i) dwell.rows.push_back({1.0 * i, 0.2, 8, 20});
  Imperfections creeping, softer;
  creeping.tendon.creep = 0.1;
  CreepMemory memory;
  memory.hold(0.1, 599);
  softer.tendon.stretch = memory.crept();
  const double stiff = predict(mechanism, {}, {dwell})[0].back();
  const double crept = predict(mechanism, creeping, {dwell})[0].back() - stiff;
  EXPECT_NEAR(crept, predict(mechanism, softer, {dwell})[0].back() - stiff,
              0.04 * std::abs(crept));  // the wound tendon slides
  EXPECT_LT(crept, -radians(0.01));
}

TEST(Creep, PersistsBetweenRuns) {
  const Mechanism mechanism = testing::linear_wrist();
  const BenchLog log{swept(mechanism, 20), swept(mechanism, 0)}, alone{swept(mechanism, 0)};
  Imperfections creeping;
  creeping.tendon.creep = 0.1;
  const std::vector<double> after = predict(mechanism, creeping, log)[1],
                            fresh = predict(mechanism, creeping, alone)[0];
  EXPECT_GT(std::abs(after[0] - fresh[0]), 5 * std::abs(after.back() - fresh.back()));
  EXPECT_GT(std::abs(after[0] - fresh[0]), radians(0.002));
}

}  // namespace
}  // namespace fusee::joint
