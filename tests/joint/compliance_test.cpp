// Compliance and friction other than the tendons': pins, the joint's bearing, a loose joint.
#include <gtest/gtest.h>

#include "fusee/joint.h"
#include "fusee/transmission.h"
#include "joint/creep_memory.h"
#include "support/mechanisms.h"

namespace fusee::joint {
namespace {

using testing::forearm;
using testing::unsymmetric;

// ---- pins -----------------------------------------------------------------------------------------------------------

/// The joint at α = 0 without friction, with pins moved to their exact positions: no linearization, no equivalent
/// springs.
struct ExactFrame {
  MadePulleys made;
  std::array<transmission::PinPlace, 2> pins;
  double EA = 0;
  double per_newton = 0;
  std::array<double, 2> material{};
  std::array<Vec2, 2> home_push, moved;

  ExactFrame(const Mechanism& mechanism, double compliance) : made(mechanism), per_newton(compliance) {
    const JointModel model = joint_model(mechanism);
    pins = model.pins;
    EA = model.EA;
    moved.fill(Vec2(0, 0));
    std::array<double, 2> tension{model.pretension, 0};
    tension[1] = tension[0] * arm(0, 0) / arm(1, 0);
    for (std::size_t i = 0; i < 2; ++i) {
      material[i] = length(i, 0) / (1 + tension[i] / EA);
      home_push[i] = push(i, 0, tension[i]);
    }
  }

  transmission::PinPlace place(std::size_t i) const {
    transmission::PinPlace place = pins[i];
    place.e += moved[i].x();
    place.oe -= moved[i].y();
    place.ef += moved[i].y();
    return place;
  }
  transmission::UpperSpan upper(std::size_t i, double theta) const {
    return transmission::upper_span(place(i), (i == 0 ? -1 : 1) * theta);
  }
  LowerPath lower(std::size_t i) const { return made.paths({place(0), place(1)}, 0)[i]; }
  double arm(std::size_t i, double theta) const { return upper(i, theta).m; }
  double length(std::size_t i, double theta) const {
    const LowerPath below = lower(i);
    // All lengths above the knot, up to a constant; the wound part counts as path.
    return upper(i, theta).length - pins[i].rho * below.normal + below.reach + below.wound - made_constant(i);
  }
  /// Length for the undisturbed pulley, so that only the spans are strained.
  double made_constant(std::size_t i) const { return made.paths(pins, 0)[i].wound; }
  double tension(std::size_t i, double theta) const { return std::max(0.0, EA * (length(i, theta) / material[i] - 1)); }
  Vec2 push(std::size_t i, double theta, double tension) const {
    const double up = upper(i, theta).normal, down = lower(i).normal;
    return tension * Vec2(std::sin(down) - std::sin(up), std::cos(up) - std::cos(down));
  }
  double theta_under(double tip_force) {
    double theta = 0;
    for (int round = 0; round < 200; ++round) {
      double low = -0.5, high = 0.5;
      while (high - low > 1e-14) {
        theta = 0.5 * (low + high);
        const double torque =
            tension(1, theta) * arm(1, theta) - tension(0, theta) * arm(0, theta) - tip_force * pins[0].R;
        (torque > 0 ? low : high) = theta;
      }
      for (std::size_t i = 0; i < 2; ++i) moved[i] = per_newton * (push(i, theta, tension(i, theta)) - home_push[i]);
    }
    return theta;
  }
};

double theta_under(const Mechanism& mechanism, double compliance, double tip_force) {
  JointModel model = joint_model(mechanism);
  model.pin_compliance = compliance;
  JointMotion motion(model);
  EquilibriumPoint point;
  for (int i = 1; i <= 20; ++i) point = motion.to({0, tip_force * i / 20, 0});
  return point.theta;
}

/// Without friction at the pins, and with infinite friction in the grooves.
Mechanism frictionless(Mechanism mechanism) {
  mechanism.guides.mu = 0;
  mechanism.pulley.mu = 1e12;
  return mechanism;
}

TEST(PinCompliance, AgreesWithMovedPins) {
  const Mechanism mechanism = frictionless(unsymmetric());
  for (const double force : {-10.0, 10.0}) {
    const double stiff = ExactFrame(mechanism, 0).theta_under(force);
    EXPECT_NEAR(stiff, theta_under(mechanism, 0, force), 1e-3 * std::abs(stiff));
    // Linearization is exact to first order: the relative error falls with the compliance.
    double last_error = 0;
    for (const double compliance : {2e-3, 1e-3, 5e-4}) {
      const double exact = ExactFrame(mechanism, compliance).theta_under(force) - stiff;
      const double found = theta_under(mechanism, compliance, force) - theta_under(mechanism, 0, force);
      const double error = std::abs(found / exact - 1);
      EXPECT_LT(error, 0.02) << compliance;
      EXPECT_GT(std::abs(exact), 0.03 * std::abs(stiff)) << compliance;
      last_error = error;
    }
    EXPECT_LT(last_error, 0.01);
  }
}

TEST(PinCompliance, IsZeroAtHome) {
  for (const double compliance : {1e-3, 0.1}) EXPECT_NEAR(theta_under(unsymmetric(), compliance, 0), 0, 1e-12);
}

/// Up and down once under a force, after loading.
std::vector<EquilibriumPoint> stroke(const JointModel& model, double tip_force, int steps, double reach = 1.0) {
  std::vector<JointStep> path;
  for (int i = 0; i <= steps; ++i) path.push_back({0, tip_force * i / steps, 0});
  for (const double end : {reach, -reach, 0.0}) {
    const double from = path.back().alpha;
    for (int i = 1; i <= steps; ++i) path.push_back({from + (end - from) * i / steps, tip_force, 0});
  }
  return follow(model, path);
}

/// Work of the motor that is neither done on the load, nor stored, nor lost to friction. N·mm
double work_missing(const std::vector<EquilibriumPoint>& points) {
  double motor = 0, load = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    motor += 0.5 * (points[i].motor_torque + points[i - 1].motor_torque) * (points[i].alpha - points[i - 1].alpha);
    load += 0.5 * (points[i].load_torque + points[i - 1].load_torque) * (points[i].theta - points[i - 1].theta);
  }
  return motor - load - points.back().stored - points.back().friction - points.back().groove_friction;
}

TEST(PinCompliance, ConservesEnergy) {
  // First-order lengths and moment arms of fixed pins cause an energy error, which is small compared with the stored
  // energy.
  JointModel model = joint_model(frictionless(forearm()));
  const double without = work_missing(stroke(model, 8, 1000));
  model.pin_compliance = 2e-3;
  const std::vector<EquilibriumPoint> points = stroke(model, 8, 1000);
  const double stored = 0.5 * model.pin_compliance * std::pow(points.back().t2.upper, 2);
  EXPECT_LT(std::abs(work_missing(points) - without), 0.1 * stored);
}

// ---- bearing --------------------------------------------------------------------------------------------------------

TEST(Bearing, HoldsJointUpToLimit) {
  constexpr double friction = 40;
  JointModel model = joint_model(unsymmetric());
  model.bearing_friction = friction;
  JointMotion motion(model);
  const auto pulled_by = [&](const EquilibriumPoint& point) {
    const double m1 = transmission::upper_span(model.pins[0], -point.theta).m,
                 m2 = transmission::upper_span(model.pins[1], point.theta).m;
    return point.t2.upper * m2 - point.t1.upper * m1 - point.load_torque;
  };
  for (int i = 1; i <= 40; ++i) {
    const EquilibriumPoint point = motion.to({0.01 * i, 0, 0});
    if (i > 5) {
      EXPECT_NEAR(pulled_by(point), friction, 1e-7) << i;
    }
  }
  const double theta = motion.to({0.4, 0, 0}).theta;
  EXPECT_EQ(motion.to({0.4, 0.3, 0}).theta, theta);   // 30 N·mm towards −θ: from +40 to +10
  EXPECT_EQ(motion.to({0.4, 0.79, 0}).theta, theta);  // to −39
  const EquilibriumPoint moved = motion.to({0.4, 1.2, 0});
  EXPECT_LT(moved.theta, theta);
  EXPECT_NEAR(pulled_by(moved), -friction, 1e-7);
  EXPECT_EQ(motion.to({0.4, 0.5, 0}).theta, moved.theta);
}

TEST(Bearing, HysteresisIsTwiceTorqueOverStiffness) {
  JointModel model = joint_model(frictionless(forearm()));
  model.bearing_friction = 25;
  // Short enough that the wound tendon does not matter.
  const std::vector<EquilibriumPoint> points = stroke(model, 5, 200, 0.01);
  const EquilibriumPoint& up = points[200 + 100];
  const EquilibriumPoint& down = points[400 + 50];
  ASSERT_NEAR(up.alpha, 0.005, 1e-12);
  ASSERT_NEAR(down.alpha, 0.005, 1e-12);
  EXPECT_NEAR((down.theta - up.theta) * 0.5 * (up.stiffness + down.stiffness), 2 * model.bearing_friction, 0.5);
}

TEST(Bearing, ConservesEnergy) {
  JointModel model = joint_model(frictionless(forearm()));
  model.bearing_friction = 25;
  const std::vector<EquilibriumPoint> points = stroke(model, 5, 2000);
  EXPECT_GT(points.back().friction, 15);
  EXPECT_NEAR(work_missing(points), 0, 1e-3 * points.back().friction);
}

// ---- loose joints -----------------------------------------------------------------------------------------------------

TEST(Loose, RestsWhereLastPushed) {
  Mechanism mechanism = forearm();
  mechanism.tendon.pretension = 0;
  JointModel model = joint_model(mechanism);
  model.slack = 0.6;  // of each tendon
  const transmission::Transmission law(mechanism);
  JointMotion motion(model);
  const auto play = [&](double theta) {  // of each tendon, at the joint
    return std::array{0.6 / transmission::upper_span(model.pins[0], -theta).m,
                      0.6 / transmission::upper_span(model.pins[1], theta).m};
  };
  for (int i = 1; i <= 60; ++i) motion.to({0.01 * i, 0, 0});
  const EquilibriumPoint up = motion.to({0.6, 0, 0});
  EXPECT_EQ(up.status, EquilibriumStatus::loose);
  EXPECT_NEAR(up.theta, law.theta(0.6) - play(law.theta(0.6))[1], 2e-4);  // tendon 2 pushed it here
  EXPECT_NEAR(up.loose_below, 0, 1e-6);
  EXPECT_NEAR(up.loose_above, play(up.theta)[0] + play(up.theta)[1], 2e-4);
  const double back = 0.5 * up.loose_above / law.at_alpha(0.6).g;  // half the play
  EXPECT_EQ(motion.to({0.6 - back, 0, 0}).theta, up.theta);
  EXPECT_EQ(motion.to({0.6 - 0.2 * back, 0, 0}).theta, up.theta);
  for (int i = 1; i <= 60; ++i) motion.to({0.6 - 0.01 * i, 0, 0});
  const EquilibriumPoint down = motion.to({0, 0, 0});
  EXPECT_NEAR(down.theta, play(0)[0], 2e-4);  // tendon 1 pushed it here
}

// ---- creep ----------------------------------------------------------------------------------------------------------

TEST(CreepMemory, IsLogarithmicInTime) {
  for (const double time : {0.1, 1.0, 3.0, 10.0, 60.0, 600.0, 3600.0}) {
    CreepMemory memory;
    for (int i = 0; i < 7; ++i) memory.hold(2.5, time / 7);
    EXPECT_NEAR(memory.crept() / 2.5, std::log10(1 + 1.78 * time), time < 10 ? 0.15 : 0.05) << time;
  }
}

TEST(CreepMemory, SuperposesLoads) {
  // Superposition (Boltzmann): a removed load equals a constant load plus its opposite from the removal on.
  const auto under = [](double first, double second) {
    CreepMemory memory;
    memory.hold(first, 100);
    memory.hold(second, 30);
    return memory.crept();
  };
  EXPECT_NEAR(under(1, 0), under(1, 1) - under(0, 1), 1e-12);
  EXPECT_GT(under(1, 0), 0.2);
  EXPECT_LT(under(1, 0), under(1, 1));
}

}  // namespace
}  // namespace fusee::joint
