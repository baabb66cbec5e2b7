#include "profile/closing_arc.h"

#include <gtest/gtest.h>

namespace fusee::profile {
namespace {

TEST(ClosingArc, ReproducesCircle) {
  const auto arc = ClosingArc::between({0.4, 10.0, 0.0, 10.0}, {2.9, 10.0, 0.0, 10.0}, 1.0);
  ASSERT_TRUE(arc.has_value());
  for (double psi = 0.4; psi <= 2.9; psi += 0.1) {
    EXPECT_NEAR(arc->at(psi).h, 10.0, 1e-12);
    EXPECT_NEAR(arc->at(psi).radius, 10.0, 1e-12);
  }
  EXPECT_NEAR(arc->length(), 10.0 * (2.9 - 0.4), 1e-12);
}

TEST(ClosingArc, JoinsEndsWithContinuousCurvature) {
  const CurvePoint begin{1.0, 14.0, -6.0, 5.0};
  const CurvePoint end{3.5, 18.0, -8.0, 30.0};
  const auto arc = ClosingArc::between(begin, end, 2.0);
  ASSERT_TRUE(arc.has_value());
  for (const CurvePoint& expected : {begin, end}) {
    const CurvePoint found = arc->at(expected.psi);
    EXPECT_NEAR((found.position() - expected.position()).norm(), 0.0, 1e-8);
    EXPECT_NEAR(found.radius, expected.radius, 1e-12);
  }
}

TEST(ClosingArc, IsConvexWithConsistentDerivatives) {
  const auto arc = ClosingArc::between({1.0, 14.0, -6.0, 5.0}, {3.5, 18.0, -8.0, 30.0}, 2.0);
  ASSERT_TRUE(arc.has_value());
  constexpr double step = 1e-4;
  for (double psi = 1.1; psi < 3.4; psi += 0.07) {
    const CurvePoint at = arc->at(psi);
    EXPECT_GE(at.radius, 2.0 - 1e-12);
    EXPECT_EQ(arc->radius(psi), at.radius);
    EXPECT_NEAR((arc->at(psi + step).h - arc->at(psi - step).h) / (2 * step), at.dh, 1e-6);
    EXPECT_NEAR((arc->at(psi + step).dh - arc->at(psi - step).dh) / (2 * step), at.radius - at.h, 1e-4);
  }
}

TEST(ClosingArc, IsNullWithoutConvexArc) {
  // The end lies behind the beginning: no convex arc of a sixth of a turn joins them.
  EXPECT_FALSE(ClosingArc::between({0.0, 10.0, 8.0, 5.0}, {1.0, 10.0, 8.0 - 25.0, 5.0}, 0.1).has_value());
  EXPECT_FALSE(ClosingArc::between({1.0, 10.0, 0.0, 5.0}, {1.0, 10.0, 0.0, 5.0}, 0.1).has_value());
}

}  // namespace
}  // namespace fusee::profile
