#include <gtest/gtest.h>

#include <cmath>

#include "fusee/profile.h"
#include "support/mechanisms.h"

namespace fusee::profile {
namespace {

TEST(Outline, ActiveArcMayWrapPastEnd) {
  Outline outline;
  outline.points.resize(10);
  outline.active_first = 7;
  outline.active_last = 2;
  EXPECT_TRUE(outline.is_active(8));
  EXPECT_TRUE(outline.is_active(0));
  EXPECT_FALSE(outline.is_active(5));
  outline.side = transmission::Side::right;
  EXPECT_EQ(outline.anchor_end(), 7U);
  outline.side = transmission::Side::left;
  EXPECT_EQ(outline.anchor_end(), 2U);
}

TEST(Outline, ParallelCurvesAddTheirDistance) {
  const SynthesisResult result = synthesise(testing::forearm());
  ASSERT_TRUE(result.made()) << result.brief();
  // Each edge of the parallel polygon grows by distance · 2 tan(turn/2), so that the sum is near 2π · distance.
  const double grown = perimeter(parallel(result.p2, 3.0)) - perimeter(parallel(result.p2, 0.0));
  EXPECT_NEAR(grown, k_two_pi * 3.0, 0.003);
}

TEST(Outline, PulleysShareNormals) {
  const SynthesisResult result = synthesise(testing::unsymmetric());
  ASSERT_TRUE(result.made()) << result.brief();
  ASSERT_EQ(result.p1.points.size(), result.p2.points.size());
  for (std::size_t i = 0; i < result.p1.points.size(); ++i) {
    EXPECT_EQ(result.p1.points[i].psi, result.p2.points[i].psi);
    if (i > 0) {
      EXPECT_GT(result.p1.points[i].psi, result.p1.points[i - 1].psi);
    }
  }
}

TEST(Outline, SagittaIsSmallForBendAtOneEnd) {
  const double radius = 40.0, turn = 0.02;
  const auto on_circle = [&](double psi) -> Vec2 { return radius * unit(psi); };
  EXPECT_NEAR(sagitta(on_circle(1.0), 1.0, on_circle(1.0 + turn), 1.0 + turn), radius * (1.0 - std::cos(0.5 * turn)),
              1e-7);

  // A bridge of 95 mm followed by the bend at its end. Reference: distance of the bend's corner from the chord, by
  // plane geometry.
  const double length = 94.67, bend_radius = 0.36, small_turn = 2.18e-4;
  const Vec2 from(0, 0), corner(length, 0), to = corner + bend_radius * small_turn * unit(0.5 * small_turn);
  const Vec2 along = (to - from).normalized();
  const double height = std::abs(along.x() * (corner - from).y() - along.y() * (corner - from).x());
  const double found = sagitta(from, -0.5 * k_pi, to, -0.5 * k_pi + small_turn);
  EXPECT_GE(found, height);
  EXPECT_LT(found, 2.5 * height + 1e-12);
  EXPECT_LT(found, 1e-4 * length * small_turn / 8.0);
}

}  // namespace
}  // namespace fusee::profile
