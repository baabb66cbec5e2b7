#include "fusee/transmission.h"

#include <gtest/gtest.h>

#include "support/mechanisms.h"

namespace fusee::transmission {
namespace {

using testing::forearm;
using testing::linear_wrist;
using testing::mirrored;
using testing::reference;
using testing::scaled;
using testing::unsymmetric;

std::vector<Mechanism> every_law() {
  Mechanism table = forearm();
  const Transmission source(table);
  table.pulley.law = Law::table;
  for (int i = -2; i <= 42; ++i) {
    const double theta = table.joint.theta_min + (table.joint.theta_max - table.joint.theta_min) * i / 40;
    table.pulley.rows.push_back({source.alpha(theta), theta});
  }
  return {reference(), forearm(), linear_wrist(), unsymmetric(), table};
}

TEST(Transmission, ReproducesPaper) {
  const Transmission transmission(reference(), 0.0);
  EXPECT_NEAR(degrees(transmission.alpha_min()), -90.24, 0.005);
  EXPECT_NEAR(degrees(transmission.alpha_max()), 92.31, 0.005);
  EXPECT_NEAR(transmission.at_theta(radians(30)).t2.p, 17.429, 0.0005);
  EXPECT_NEAR(transmission.at_theta(radians(-30)).t2.p, 22.951, 0.0005);
  EXPECT_DOUBLE_EQ(transmission.at_theta(0).t2.p, 20.0);
}

TEST(Transmission, PaperMethodUsesPointPins) {
  Mechanism mechanism = forearm();
  mechanism.pulley.method = Method::paper;
  EXPECT_EQ(Transmission(mechanism).alpha_max(), Transmission(mechanism, 0.0).alpha_max());
  EXPECT_NE(Transmission(mechanism).alpha_max(), Transmission(forearm()).alpha_max());
}

// Independent physics: the pulley winds the length that the path above it loses.
TEST(Transmission, MomentArmsSatisfyVirtualWork) {
  constexpr double step = 1e-5;
  for (const Mechanism& mechanism : every_law()) {
    const Transmission transmission(mechanism);
    for (const double u : {0.02, 0.3, 0.5, 0.7, 0.98}) {
      const double alpha = transmission.alpha_min() + u * (transmission.alpha_max() - transmission.alpha_min());
      const TransmissionPoint at = transmission.at_alpha(alpha);
      const double before = transmission.theta(alpha - step);
      const double after = transmission.theta(alpha + step);
      const auto length = [&](Side side, double theta) {
        return upper_span(transmission.place(side), mirror_sign(side) * theta).length;
      };
      EXPECT_NEAR((length(Side::left, after) - length(Side::left, before)) / (2 * step), at.t1.p, 1e-6);
      EXPECT_NEAR((length(Side::right, after) - length(Side::right, before)) / (2 * step), -at.t2.p, 1e-6);
    }
  }
}

TEST(Transmission, DerivativesAgreeWithDifferences) {
  constexpr double step = 2e-4;
  for (const Mechanism& mechanism : every_law()) {
    const Transmission transmission(mechanism);
    for (const double u : {0.05, 0.4, 0.61, 0.95}) {
      const double alpha = transmission.alpha_min() + u * (transmission.alpha_max() - transmission.alpha_min());
      const TransmissionPoint before = transmission.at_alpha(alpha - step);
      const TransmissionPoint at = transmission.at_alpha(alpha);
      const TransmissionPoint after = transmission.at_alpha(alpha + step);
      EXPECT_NEAR((after.theta - before.theta) / (2 * step), at.g, 1e-7);
      EXPECT_NEAR((after.g - before.g) / (2 * step), at.dg, 1e-6);
      EXPECT_NEAR((after.dg - before.dg) / (2 * step), at.d2g, 1e-5);
      for (const auto tendon : {&TransmissionPoint::t1, &TransmissionPoint::t2}) {
        EXPECT_NEAR(((after.*tendon).p - (before.*tendon).p) / (2 * step), (at.*tendon).dp, 1e-5);
        EXPECT_NEAR(((after.*tendon).dp - (before.*tendon).dp) / (2 * step), (at.*tendon).d2p, 1e-3);
      }
    }
  }
}

TEST(Transmission, AlphaAndThetaAreInverses) {
  for (const Mechanism& mechanism : every_law()) {
    const Transmission transmission(mechanism);
    for (double u = 0; u <= 1.0; u += 0.125) {
      const double theta = mechanism.joint.theta_min + u * (mechanism.joint.theta_max - mechanism.joint.theta_min);
      EXPECT_NEAR(transmission.theta(transmission.alpha(theta)), theta, 1e-13);
    }
    EXPECT_NEAR(transmission.alpha(0.0), 0.0, 1e-9);
  }
}

TEST(Transmission, LinearLawIsLinear) {
  const Transmission transmission(linear_wrist());
  EXPECT_DOUBLE_EQ(transmission.theta(radians(32.0)), radians(10.0));
  EXPECT_DOUBLE_EQ(transmission.alpha_max(), radians(80.0));
  const TransmissionPoint at = transmission.at_theta(0.2);
  EXPECT_DOUBLE_EQ(at.t1.p, at.t1.m / 3.2);
  EXPECT_DOUBLE_EQ(at.t2.p, at.t2.m / 3.2);
}

TEST(Transmission, TableReproducesLaw) {
  const Mechanism table = every_law().back();
  const Transmission from_table(table);
  const Transmission exact(forearm());
  for (double theta = -0.5; theta <= 0.5; theta += 0.05) {
    EXPECT_NEAR(from_table.alpha(theta), exact.alpha(theta), 5e-8);
    EXPECT_NEAR(from_table.at_theta(theta).t2.p, exact.at_theta(theta).t2.p, 5e-5);
    EXPECT_NEAR(from_table.at_theta(theta).t2.d2p, exact.at_theta(theta).t2.d2p, 0.05);
  }
}

TEST(Transmission, StopsAtDeadCentre) {
  Mechanism mechanism = reference();
  mechanism.joint.theta_max = radians(60);
  const auto dead = Transmission(mechanism, 0.0).dead_centre();
  ASSERT_TRUE(dead.has_value());
  // The tendon's line passes through O where C, O and D are collinear.
  EXPECT_NEAR(std::tan(*dead), -mechanism.guides.ED / mechanism.guides.OE, 1e-9);
  EXPECT_FALSE(Transmission(reference()).dead_centre().has_value());
}

TEST(Transmission, MirroredJointHasMirroredLaw) {
  Mechanism mechanism = unsymmetric();
  mechanism.pulley.law = Law::linear;
  mechanism.pulley.ratio = 3.0;
  const Transmission left_handed(mirrored(mechanism));
  const Transmission transmission(mechanism);
  for (const double theta : {-0.3, -0.1, 0.2, 0.5}) {
    const TransmissionPoint at = transmission.at_theta(theta);
    const TransmissionPoint image = left_handed.at_theta(-theta);
    EXPECT_NEAR(at.t1.p, image.t2.p, 1e-12);
    EXPECT_NEAR(at.t2.dp, -image.t1.dp, 1e-12);
    EXPECT_NEAR(at.t2.d2p, image.t1.d2p, 1e-10);
    EXPECT_NEAR(at.t2.lower_normal, k_pi - image.t1.lower_normal, 1e-12);
  }
}

TEST(Transmission, ScalesWithLengths) {
  const Transmission transmission(unsymmetric());
  const Transmission twice(scaled(unsymmetric(), 2.0));
  for (const double theta : {-0.3, 0.0, 0.5}) {
    EXPECT_NEAR(twice.at_theta(theta).alpha, transmission.at_theta(theta).alpha, 1e-13);
    EXPECT_NEAR(twice.at_theta(theta).t2.p, 2.0 * transmission.at_theta(theta).t2.p, 1e-12);
  }
}

TEST(Transmission, TendonLengthsAddUp) {
  const TransmissionPoint at = Transmission(forearm()).at_theta(0.3);
  EXPECT_GT(at.t2.wrap, 0.0);
  EXPECT_NEAR(at.t2.length, at.t2.free_upper + forearm().guide_pitch_radius() * at.t2.wrap + at.t2.lower_reach, 1e-12);
}

}  // namespace
}  // namespace fusee::transmission
