#include <gtest/gtest.h>

#include "fusee/transmission.h"
#include "support/mechanisms.h"

namespace fusee::transmission {
namespace {

TEST(PaperForces, VerticalTendonPullsTwiceTheTipForce) {
  // ED = R/2 and θ = 30°: tendon 2 is vertical, sin γ2 = 1/2 [6].
  Mechanism mechanism = testing::reference();
  mechanism.pulley.method = Method::paper;
  mechanism.load.tip_force = 10.0;
  const PaperForces forces = paper_forces(mechanism, Transmission(mechanism).at_theta(radians(30)));
  EXPECT_NEAR(forces.T2, 20.0, 1e-9);
  EXPECT_NEAR(degrees(forces.gamma2), 30.0, 1e-9);
}

TEST(PaperForces, FollowCapstanAndHooke) {
  Mechanism mechanism = testing::forearm();
  mechanism.load.tip_force = 10.0;
  const Transmission transmission(mechanism);
  const TransmissionPoint at = transmission.at_theta(0.2);
  const PaperForces rough = paper_forces(mechanism, at);
  EXPECT_NEAR(rough.Tb, rough.T2 * std::exp(0.12 * at.t2.wrap), 1e-12);  // 0.12: guides.mu of forearm()
  // Without friction one tension stretches the whole length.
  mechanism.guides.mu = 0.0;
  const PaperForces smooth = paper_forces(mechanism, at);
  const double stiffness = k_pi / 4 * 40000.0;
  EXPECT_NEAR(smooth.elongation, smooth.T2 * at.t2.length / stiffness, 1e-12);
  EXPECT_NEAR(smooth.theta_error * at.t2.m, smooth.elongation, 1e-12);
  EXPECT_GT(rough.elongation, smooth.elongation);
}

TEST(PaperForces, PointPinErrorIsThatOfTriangle) {
  // [10],[11] by an independent route: the joint angle at which C–D is longer by Δ.
  Mechanism mechanism = testing::reference();
  mechanism.pulley.method = Method::paper;
  mechanism.tendon.modulus = 500.0;
  mechanism.load.tip_force = 10.0;
  const Transmission transmission(mechanism);
  for (const double theta : {-0.5, 0.0, 0.4}) {
    const TransmissionPoint at = transmission.at_theta(theta);
    const PaperForces forces = paper_forces(mechanism, at);
    const double longer = upper_span(transmission.place(Side::right), theta - forces.theta_error).free;
    EXPECT_NEAR(longer, at.t2.free_upper + forces.elongation, 1e-11);
    EXPECT_NEAR(forces.theta_error, forces.elongation / at.t2.m, 0.05 * forces.theta_error);
    EXPECT_NE(forces.theta_error, forces.elongation / at.t2.m);
  }
}

TEST(PaperForces, Tendon1CarriesLoadTowardsTheta) {
  Mechanism mechanism = testing::forearm();
  mechanism.load.tip_force = 10.0;
  const PaperForces against = paper_forces(mechanism, Transmission(mechanism).at_theta(0.2));
  mechanism.load.tip_force = -10.0;
  const PaperForces along = paper_forces(mechanism, Transmission(mechanism).at_theta(-0.2));
  EXPECT_EQ(along.T2, 0.0);
  EXPECT_NEAR(along.T1, against.T2, 1e-12);
  EXPECT_NEAR(along.Tb, against.Tb, 0.1);  // P1 and P2 have different radii, so that the wraps differ a little
  EXPECT_LT(along.theta_error, 0.0);
  EXPECT_LT(along.motor_torque, 0.0);
  EXPECT_NEAR(along.gamma1, against.gamma2, 1e-12);
}

TEST(PaperForces, TorqueAndWeightActLikeATipForce) {
  Mechanism tip = testing::forearm();
  tip.load.tip_force = 10.0;
  Mechanism torque = testing::forearm();
  torque.load.torque = 1000.0;
  Mechanism weight = testing::forearm();
  weight.load.mass_kg = 1.0;
  weight.load.lever = 1000.0 / 9.80665;
  weight.load.tilt = radians(90.0) + 0.2;  // horizontal at θ = 0.2
  const TransmissionPoint at = Transmission(tip).at_theta(0.2);
  EXPECT_NEAR(paper_forces(torque, at).T2, paper_forces(tip, at).T2, 1e-12);
  EXPECT_NEAR(paper_forces(weight, at).T2, paper_forces(tip, at).T2, 1e-12);
}

TEST(PaperForces, AnglesAtCMatchGeometry) {
  const Mechanism mechanism = testing::reference();
  const TransmissionPoint at = Transmission(mechanism, 0.0).at_theta(-0.5);
  const PaperForces forces = paper_forces(mechanism, at);
  const Vec2 C = 100.0 * Vec2(std::sin(-0.5), std::cos(-0.5));
  const auto angle_to = [&](const Vec2& pin) { return std::acos((-C).normalized().dot((pin - C).normalized())); };
  EXPECT_NEAR(forces.gamma2, angle_to({50.0, 40.0}), 1e-12);
  EXPECT_NEAR(forces.gamma1, angle_to({-50.0, 40.0}), 1e-12);
}

}  // namespace
}  // namespace fusee::transmission
