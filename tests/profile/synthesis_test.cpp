#include <gtest/gtest.h>

#include "fusee/profile.h"
#include "support/mechanisms.h"

namespace fusee::profile {
namespace {

using testing::forearm;
using testing::linear_wrist;
using testing::mirrored;
using testing::reference;
using testing::scaled;
using testing::unsymmetric;

/// Direction of the tendon's normal in the frame of the pulley turned by α.
double body_normal(const transmission::TransmissionPoint& at, const transmission::TendonPoint& tendon) {
  return tendon.lower_normal + at.alpha;
}

/// Support of the outline: its furthest extent in the direction ψ, mm.
double support_of(const Outline& outline, double psi) {
  double support = -1e9;
  for (const OutlinePoint& point : outline.points) support = std::max(support, point.position.dot(unit(psi)));
  return support;
}

TEST(Synthesis, CompensatingP1IsRound) {
  const SynthesisResult result = synthesise(forearm());
  ASSERT_TRUE(result.made()) << result.brief();
  for (const OutlinePoint& point : result.p1.points) {
    EXPECT_NEAR(point.position.norm(), 16.0, 1e-10);
    EXPECT_NEAR(point.curvature_radius, 16.0, 1e-9);
  }
}

// Envelope property: at every point of the stroke the tendon's line touches the outline and has all of it inside.
TEST(Synthesis, TendonLinesTouchOutline) {
  for (const Mechanism& mechanism : {forearm(), linear_wrist(), unsymmetric()}) {
    const SynthesisResult result = synthesise(mechanism, {.chord_error_mm = 1e-4});
    ASSERT_TRUE(result.made()) << result.brief();
    for (const transmission::TransmissionPoint& at : result.stroke) {
      const double support1 = support_of(result.p1, body_normal(at, at.t1));
      const double support2 = support_of(result.p2, body_normal(at, at.t2));
      EXPECT_LE(support1, at.t1.p + 1e-9);
      EXPECT_LE(support2, at.t2.p + 1e-9);
      EXPECT_GE(support1, at.t1.p - 1e-4);
      EXPECT_GE(support2, at.t2.p - 1e-4);
    }
  }
}

TEST(Synthesis, ChordsAreWithinTolerance) {
  const Mechanism mechanism = forearm();
  const SynthesisResult fine = synthesise(mechanism, {.chord_error_mm = 1e-6});
  for (const double tolerance : {0.02, 0.002}) {
    const SynthesisResult result = synthesise(mechanism, {.chord_error_mm = tolerance});
    ASSERT_TRUE(result.made());
    for (const OutlinePoint& point : fine.p2.points) {
      EXPECT_LE(point.position.dot(point.normal) - support_of(result.p2, point.psi), tolerance);
    }
  }
}

TEST(Synthesis, CurvatureAgreesWithPoints) {
  const SynthesisResult result = synthesise(unsymmetric(), {.chord_error_mm = 1e-5});
  ASSERT_TRUE(result.made());
  const auto& points = result.p2.points;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const double mean =
        (points[i + 1].position - points[i - 1].position).norm() / (points[i + 1].psi - points[i - 1].psi);
    EXPECT_NEAR(mean, points[i].curvature_radius, 0.02 * points[i].curvature_radius);
  }
}

TEST(Synthesis, ActiveArcsEndWithStroke) {
  const SynthesisResult result = synthesise(forearm());
  ASSERT_TRUE(result.made());
  const transmission::TransmissionPoint& first = result.stroke.front();
  const transmission::TransmissionPoint& last = result.stroke.back();
  // An end may share the point of another end within 0.1° (Outline).
  const auto at_normal = [](const Outline& outline, std::size_t i, double psi) {
    return std::abs(std::remainder(outline.points[i].psi - psi, k_two_pi)) < radians(0.11);
  };
  EXPECT_TRUE(at_normal(result.p2, result.p2.active_first, body_normal(first, first.t2)));
  EXPECT_TRUE(at_normal(result.p2, result.p2.active_last, body_normal(last, last.t2)));
  EXPECT_TRUE(at_normal(result.p1, result.p1.active_first, body_normal(first, first.t1)));
  EXPECT_TRUE(at_normal(result.p1, result.p1.active_last, body_normal(last, last.t1)));
}

TEST(Synthesis, StrokeIncludesHomeAndEnds) {
  const SynthesisResult result = synthesise(unsymmetric());
  EXPECT_DOUBLE_EQ(result.stroke.front().theta, radians(-20));
  EXPECT_NEAR(result.stroke.back().theta, radians(32), 1e-12);
  const auto home =
      std::count_if(result.stroke.begin(), result.stroke.end(), [](const auto& at) { return at.alpha == 0.0; });
  EXPECT_EQ(home, 1);
}

TEST(Synthesis, MirroredJointHasMirroredPulley) {
  Mechanism mechanism = linear_wrist();
  mechanism.guides.EB = 44.0;
  mechanism.guides.ED = 52.0;
  mechanism.joint.theta_max = radians(30);
  const SynthesisResult result = synthesise(mechanism, {.chord_error_mm = 1e-5});
  const SynthesisResult image = synthesise(mirrored(mechanism), {.chord_error_mm = 1e-5});
  ASSERT_TRUE(result.made()) << result.brief();
  ASSERT_TRUE(image.made()) << image.brief();
  for (const OutlinePoint& point : result.p2.points) {
    const Vec2 mirrored_normal(-point.normal.x(), point.normal.y());
    EXPECT_NEAR(support_of(image.p1, std::atan2(mirrored_normal.y(), mirrored_normal.x())),
                point.position.dot(point.normal), 1e-4);
  }
}

TEST(Synthesis, ScalesWithLengths) {
  const SynthesisResult result = synthesise(unsymmetric());
  const SynthesisResult half = synthesise(scaled(unsymmetric(), 0.5), {.chord_error_mm = 0.005});
  ASSERT_TRUE(half.made());
  ASSERT_EQ(result.p2.points.size(), half.p2.points.size());
  for (std::size_t i = 0; i < result.p2.points.size(); ++i) {
    EXPECT_NEAR((result.p2.points[i].position - 2.0 * half.p2.points[i].position).norm(), 0.0, 1e-9);
  }
}

TEST(Synthesis, ReproducesSlackOfPolarDrawing) {
  Mechanism mechanism = reference();
  mechanism.tendon.diameter = 0.01;  // the groove floor lies 0.005 mm inside the pitch curve
  mechanism.pulley.method = Method::paper;
  const SynthesisResult result = synthesise(mechanism, {.chord_error_mm = 1e-4});
  ASSERT_TRUE(result.made()) << result.brief();
  EXPECT_TRUE(result.warnings.empty());
  const RewindResult wound = rewind(mechanism, parallel(result.p1, -0.005), parallel(result.p2, -0.005));
  EXPECT_NEAR(wound.max_excess, 0.30, 0.01);  // known value: −0.30 … +0.20 mm
}

TEST(Synthesis, BridgesAndReportsHollowPolarDrawing) {
  Mechanism mechanism = reference();
  mechanism.tendon.diameter = 0.01;
  mechanism.pulley.method = Method::paper;
  mechanism.guides.OE = 20.0;
  mechanism.joint.theta_min = radians(-32);
  mechanism.joint.theta_max = radians(32);
  const SynthesisResult result = synthesise(mechanism);
  ASSERT_TRUE(result.made()) << result.brief();
  ASSERT_FALSE(result.warnings.empty());
  EXPECT_NE(result.warnings.front().find("hollow"), std::string::npos);
  const RewindResult wound = rewind(mechanism, parallel(result.p1, -0.005), parallel(result.p2, -0.005));
  EXPECT_GT(wound.max_excess, 5.0);  // known value: −6 … +17 mm at ±35°, where a tendon would leave its pin
}

TEST(Synthesis, BriefReportsStrokeAndRadii) {
  Mechanism mechanism = reference();
  mechanism.pulley.method = Method::paper;
  EXPECT_EQ(synthesise(mechanism).brief(), "α -90.24° … 92.31°, r2 17.429 … 22.951 mm");
}

}  // namespace
}  // namespace fusee::profile
