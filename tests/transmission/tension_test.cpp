#include "fusee/transmission/tension.h"

#include <gtest/gtest.h>

#include "support/mechanisms.h"

namespace fusee {
namespace {

TEST(PaperForces, TendonHangingStraightDownPullsTwiceTheTipForce) {
  // ED = R/2 and θ = 30°: tendon 2 is vertical, sin γ2 = 1/2 [6].
  Mechanism mechanism = testing::reference();
  mechanism.pulley.method = Method::paper;
  mechanism.load.tip_force = 10.0;
  const PaperForces forces = paper_forces(mechanism, Transmission(mechanism).at_theta(radians(30)));
  EXPECT_NEAR(forces.T2, 20.0, 1e-9);
  EXPECT_NEAR(degrees(forces.gamma2), 30.0, 1e-9);
}

TEST(PaperForces, CapstanAndElongation) {
  Mechanism mechanism = testing::forearm();
  mechanism.load.tip_force = 10.0;
  const Transmission transmission(mechanism);
  const TransmissionPoint at = transmission.at_theta(0.2);
  const PaperForces rough = paper_forces(mechanism, at);
  EXPECT_NEAR(rough.Tb, rough.T2 * std::exp(0.12 * at.t2.wrap), 1e-12);
  // Without friction one tension stretches the whole length.
  mechanism.guides.mu = 0.0;
  const PaperForces smooth = paper_forces(mechanism, at);
  const double stiffness = k_pi / 4 * 40000.0;
  EXPECT_NEAR(smooth.elongation, smooth.T2 * at.t2.length / stiffness, 1e-12);
  EXPECT_NEAR(smooth.theta_error * at.t2.m, smooth.elongation, 1e-12);
  EXPECT_GT(rough.elongation, smooth.elongation);
}

}  // namespace
}  // namespace fusee
