#include "fusee/profile/outline.h"

#include <gtest/gtest.h>

#include "fusee/profile/synthesis.h"
#include "support/mechanisms.h"

namespace fusee {
namespace {

TEST(Outline, ActiveArcMayWrapPastTheEnd) {
  Outline outline;
  outline.points.resize(10);
  outline.active_first = 7;
  outline.active_last = 2;
  EXPECT_TRUE(outline.is_active(8));
  EXPECT_TRUE(outline.is_active(0));
  EXPECT_FALSE(outline.is_active(5));
  outline.side = Side::right;
  EXPECT_EQ(outline.anchor_end(), 7U);
  outline.side = Side::left;
  EXPECT_EQ(outline.anchor_end(), 2U);
}

TEST(Outline, ParallelCurvesAddATurnOfTheirDistance) {
  const SynthesisResult result = synthesise(testing::forearm());
  ASSERT_TRUE(result.made()) << result.brief();
  // The polygon's parallel polygon: each edge grows by distance · 2 tan(turn/2) in the limit; the sum is near 2π · distance.
  const double grown = perimeter(parallel(result.p2, 3.0)) - perimeter(parallel(result.p2, 0.0));
  EXPECT_NEAR(grown, k_two_pi * 3.0, 0.003);
}

TEST(Outline, BothPulleysShareTheirNormals) {
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

}  // namespace
}  // namespace fusee
