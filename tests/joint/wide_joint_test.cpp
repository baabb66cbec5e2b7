// Drums, attachments and idlers under tension, compared with joints and formulas with known results.
#include <gtest/gtest.h>

#include <cmath>

#include "fusee/joint.h"
#include "fusee/transmission.h"
#include "joint/upper_span_table.h"
#include "support/mechanisms.h"

namespace fusee::joint {
namespace {

/// Up, down and home again under a tip force, `count` times; the load is applied at home, in the first 40 steps.
std::vector<JointStep> loaded_cycles(const Mechanism& mechanism, double tip_force, int count = 1) {
  const transmission::Transmission law(mechanism);
  std::vector<JointStep> steps;
  for (int i = 0; i <= 40; ++i) steps.push_back({0.0, tip_force * i / 40, 0.0});
  const auto run = [&](double from, double to) {
    for (int i = 1; i <= 120; ++i) steps.push_back({from + (to - from) * i / 120, tip_force, 0.0});
  };
  for (int cycle = 0; cycle < count; ++cycle) {
    run(0.0, law.alpha_max());
    run(law.alpha_max(), law.alpha_min());
    run(law.alpha_min(), 0.0);
  }
  return steps;
}

TEST(WideJoint, FollowsLawWithoutTension) {
  for (Mechanism mechanism : {testing::finger(), testing::ankle()}) {
    mechanism.tendon.pretension = 0;
    mechanism.guides.mu = 0;
    const transmission::Transmission law(mechanism);
    ASSERT_FALSE(law.dead_centre());
    for (const EquilibriumPoint& point : follow(joint_model(mechanism), loaded_cycles(mechanism, 0)))
      EXPECT_NEAR(point.theta, law.theta(point.alpha), 1e-11) << mechanism.name;
  }
}

TEST(WideJoint, SpanTableKeepsKink) {
  const Mechanism mechanism = testing::ankle();
  const transmission::PinPlace place =
      transmission::pin_place(mechanism, transmission::Side::left, mechanism.seen_pitch_radius());
  const double leaves = *transmission::lift_off(place);
  const UpperSpanTable table(place, -0.9, 0.9);
  ASSERT_GT(leaves, -0.5);
  ASSERT_LT(leaves, 0.5);
  for (double theta = -0.9; theta < 0.9; theta += 0.0071) {
    const transmission::UpperSpan span = transmission::upper_span(place, theta);
    const UpperSpanTable::Values interpolated = table.at(theta);
    EXPECT_NEAR(interpolated.length, span.length, 1e-8);
    EXPECT_NEAR(interpolated.m, span.m, 1e-7);
    EXPECT_NEAR(interpolated.dm, span.dm, 1e-4);
    EXPECT_NEAR(interpolated.normal, span.normal, 1e-9);
  }
}

TEST(WideJoint, DrumTensionIsTorqueOverRadius) {
  Mechanism mechanism = testing::finger();
  mechanism.tendon.pretension = 0;
  mechanism.guides.mu = 0;
  for (const EquilibriumPoint& point : follow(joint_model(mechanism), loaded_cycles(mechanism, 20.0))) {
    if (point.load_torque < 20.0 * mechanism.joint.R) continue;  // still loading
    EXPECT_NEAR(point.t2.upper, 20.0 * mechanism.joint.R / mechanism.drum_pitch_radius(), 1e-9);
    EXPECT_NEAR(point.motor_torque, 20.0 * mechanism.pulley.r1, 1e-7);
  }
}

/// Independent model of the drum: a string of a thousand links, each pressed on the drum and rubbing up to the capstan
/// limit, with its knot, all fixed to the link. Together they apply the span's tension times the span's arm, for any
/// friction.
TEST(WideJoint, DrumFrictionKeepsTorque) {
  const Mechanism mechanism = testing::finger();
  const transmission::PinPlace place =
      transmission::pin_place(mechanism, transmission::Side::right, mechanism.seen_pitch_radius());
  for (const double theta : {-0.3, 0.0, 1.2}) {
    const transmission::UpperSpan span = transmission::upper_span(place, theta);
    ASSERT_GT(span.on_drum, 0);
    for (const double friction : {0.0, 0.2, -0.2}) {
      constexpr int links = 1000;
      const double tension = 20.0, step = span.on_drum / links;
      double torque = 0, here = tension;
      for (int i = 0; i < links; ++i) {
        const double next = tension * std::exp(-friction * step * (i + 1));
        const Vec2 at = place.drum * unit(span.normal + step * (i + 0.5));
        const Vec2 from(-std::sin(span.normal + step * i), std::cos(span.normal + step * i)),
            to(-std::sin(span.normal + step * (i + 1)), std::cos(span.normal + step * (i + 1)));
        // A link is pulled towards the span and back from the knot; the drum carries the difference.
        torque += cross(at, next * to - here * from);
        here = next;
      }
      const double end = span.normal + span.on_drum;
      const Vec2 tangent(-std::sin(end), std::cos(end));
      torque += cross(place.drum * unit(end), -here * tangent);
      EXPECT_NEAR(-torque, tension * span.m, 1e-5 * tension * span.m) << theta << " " << friction;
    }
  }
}

/// With a drum the wrap on the guide is constant, so that an idler equals a pin of some friction.
TEST(WideJoint, IdlerEqualsPinAtConstantWrap) {
  Mechanism idler = testing::finger();
  idler.guides.kind = GuideKind::idler;
  idler.guides.bearing_radius = 1.0;
  idler.guides.bearing_friction = 0.3;
  const double wrap = transmission::Transmission(idler).at_theta(0.2).t2.wrap;
  const double epsilon = 0.3 * 1.0 / 1.3 * std::sin(0.5 * wrap);
  Mechanism pin = testing::finger();
  pin.guides.mu = std::log((1 + epsilon) / (1 - epsilon)) / wrap;
  const auto of_idler = follow(joint_model(idler), loaded_cycles(idler, 10.0, 2));
  const auto of_pin = follow(joint_model(pin), loaded_cycles(pin, 10.0, 2));
  ASSERT_EQ(of_idler.size(), of_pin.size());
  double hysteresis = 0;
  for (std::size_t i = 0; i < of_pin.size(); ++i) {
    EXPECT_NEAR(of_idler[i].theta, of_pin[i].theta, 1e-9);
    EXPECT_NEAR(of_idler[i].t2.lower, of_pin[i].t2.lower, 1e-6);
    hysteresis = std::max(hysteresis, of_pin[i].t2.lower / of_pin[i].t2.upper - 1);
  }
  EXPECT_GT(hysteresis, 0.05);
}

TEST(WideJoint, IdlerLossBalancesMoments) {
  // Both tensions press the bearing as vectors; solved by bisection. The formula neglects the square of their
  // difference.
  for (const double wrap : {0.3, 1.0, 2.2}) {
    for (const double turning : {0.001, 0.02}) {
      double low = 1.0, high = 2.0;
      for (int i = 0; i < 60; ++i) {
        const double T2 = 0.5 * (low + high);
        const double pressed = std::hypot(1.0 - T2 * std::cos(wrap), T2 * std::sin(wrap));
        (T2 - 1.0 < turning * pressed ? low : high) = T2;
      }
      const transmission::GuideFriction guide{0, turning, true};
      EXPECT_NEAR(std::exp(guide.log_ratio(wrap)) - 1.0, low - 1.0, 0.03 * turning * (low - 1.0) + 1e-14);
      constexpr double step = 1e-5;
      EXPECT_NEAR(guide.slope(wrap), (guide.log_ratio(wrap + step) - guide.log_ratio(wrap - step)) / (2 * step), 1e-8);
    }
  }
  EXPECT_EQ(transmission::GuideFriction({0, 0.02, true}).log_ratio(-0.1), 0.0);
}

/// A finger whose tendons stay on its drum, so that elongation is proportional to the angle; the motor is elsewhere.
Mechanism finger_with_sheath(const Sheath& sheath) {
  Mechanism mechanism = testing::finger();
  mechanism.tendon.pretension = 0;
  mechanism.guides.mu = 0;
  mechanism.sheath = sheath;
  return mechanism;
}

TEST(WideJoint, FollowsLawWithSheath) {
  Mechanism mechanism = testing::sheathed_wrist();
  mechanism.tendon.pretension = mechanism.guides.mu = mechanism.sheath.mu = 0;
  const transmission::Transmission law(mechanism);
  for (const EquilibriumPoint& point : follow(joint_model(mechanism), loaded_cycles(mechanism, 0)))
    EXPECT_NEAR(point.theta, law.theta(point.alpha), 1e-11);
}

TEST(WideJoint, SheathFrictionEqualsPinFriction) {
  // Sliding throughout: a weight is lifted and lowered.
  const Sheath sheath{300.0, radians(200.0), 0.1, 0.0, 15.0, 60.0};
  const Mechanism mechanism = finger_with_sheath(sheath);
  const auto points = follow(joint_model(mechanism), loaded_cycles(mechanism, 20.0));
  const double lost = std::exp(0.1 * radians(200.0));
  int up = 0, down = 0;
  for (const EquilibriumPoint& point : points) {
    if (point.t2.contact == PinContact::slip_down && point.load_torque > 160) {  // of 166 N·mm: loaded
      EXPECT_NEAR(point.t2.lower, point.t2.upper * lost, 1e-9 * point.t2.lower);
      ++up;
    }
    if (point.t2.contact == PinContact::slip_up) {
      EXPECT_NEAR(point.t2.lower, point.t2.upper / lost, 1e-9 * point.t2.lower);
      ++down;
    }
  }
  EXPECT_GT(up, 50);
  EXPECT_GT(down, 50);
}

TEST(WideJoint, SheathActsAsSpring) {
  const Sheath rigid{300.0, radians(200.0), 0.0, 0.0, 15.0, 60.0};
  Sheath soft = rigid, longer = rigid;
  soft.stiffness = 50.0;
  longer.length += 250.0;
  const auto of = [](const Sheath& sheath) {
    const Mechanism mechanism = finger_with_sheath(sheath);
    return follow(joint_model(mechanism), loaded_cycles(mechanism, 20.0));
  };
  const auto with_rigid = of(rigid), with_soft = of(soft), with_longer = of(longer);
  // OC and the drum's pitch radius are equal, so the tension is the tip force.
  const double tension = 20.0, arm = 8.3, EA = section_stiffness(testing::finger().tendon);
  // Fully loaded, still at home. Later a part of the stretched tendon is wound onto the pulley.
  constexpr std::size_t k_loaded = 40;
  const EquilibriumPoint &stiff_point = with_rigid[k_loaded], &soft_point = with_soft[k_loaded];
  EXPECT_NEAR(stiff_point.theta - soft_point.theta, tension / 50.0 / arm, 1e-10);
  EXPECT_NEAR(stiff_point.theta - with_longer[k_loaded].theta, tension * 250.0 / EA / arm, 1e-10);
  EXPECT_NEAR(1 / soft_point.stiffness - 1 / stiff_point.stiffness, 1 / (50.0 * arm * arm), 2e-3 / (50.0 * arm * arm));
}

TEST(WideJoint, PaperForcesIncludeSheaths) {
  Mechanism mechanism = testing::sheathed_wrist();
  mechanism.load.tip_force = 10;
  const transmission::TransmissionPoint at = transmission::Transmission(mechanism).at_theta(0.2);
  const transmission::PaperForces forces = transmission::paper_forces(mechanism, at);
  const double off_pin = forces.T2 * std::exp(0.12 * at.t2.wrap), lost = std::exp(0.08 * radians(150.0));
  EXPECT_NEAR(forces.Tb, off_pin * lost, 1e-12 * forces.Tb);
  // Each part under its own tension, pin and sheath under the mean of theirs.
  const double EA = section_stiffness(mechanism.tendon), on_pin = 2.5 * at.t2.wrap, mean = 0.5 * (off_pin + forces.Tb);
  EXPECT_NEAR(at.t2.length, at.t2.free_upper + on_pin + 450.0 + at.t2.lower_reach, 1e-12 * at.t2.length);
  EXPECT_NEAR(forces.elongation,
              (forces.T2 * at.t2.free_upper + 0.5 * (forces.T2 + off_pin) * on_pin + mean * 450.0 +
               forces.Tb * at.t2.lower_reach) /
                      EA +
                  mean / 200.0,
              1e-12);
  EXPECT_NEAR(1 / forces.stiffness, (at.t2.length / EA + 1 / 200.0) / (at.t2.m * at.t2.m), 1e-15);
}

TEST(WideJoint, PaperForcesIncludeIdlers) {
  Mechanism mechanism = testing::forearm();
  mechanism.load.tip_force = 10;
  mechanism.guides.kind = GuideKind::idler;
  mechanism.guides.bearing_radius = 1.5;
  mechanism.guides.bearing_friction = 0.1;
  const transmission::TransmissionPoint at = transmission::Transmission(mechanism).at_theta(0.2);
  const transmission::PaperForces forces = transmission::paper_forces(mechanism, at);
  const double epsilon = 0.1 * 1.5 / 2.5 * std::sin(0.5 * at.t2.wrap);
  EXPECT_NEAR(forces.Tb, forces.T2 * (1 + epsilon) / (1 - epsilon), 1e-12 * forces.Tb);
}

}  // namespace
}  // namespace fusee::joint
