#include <gtest/gtest.h>

#include <cmath>

#include "fusee/calibration/measurement.h"

namespace fusee {
namespace {

// By hand, three positions, three repeats:
//   i   up           x̄    s     down          x̄    s    B     2s↑+2s↓+|B|  4s↑  4s↓  mean
//   1   1 2 3        2    1     5 5 5         5    0    −3    5            4    0    3.5
//   2   0 0 0        0    0     1 3 5         3    2    −3    7            0    8    1.5
//   3   −1 −1 −1     −1   0     −1 −1 −1      −1   0    0     0            0    0    −1
// B = 3; R = 8; E = 5 − (−1) = 6; M = 3.5 − (−1) = 4.5; A = (3 + 4) − (−1 or 3 − 4 = −1) = 8
TEST(Iso230, AsWorkedByHand) {
  const Iso230 figures = iso230({{{{1, 2, 3}, {5, 5, 5}}}, {{{0, 0, 0}, {1, 3, 5}}}, {{{-1, -1, -1}, {-1, -1, -1}}}});
  EXPECT_DOUBLE_EQ(figures.B, 3);
  EXPECT_DOUBLE_EQ(figures.R, 8);
  EXPECT_DOUBLE_EQ(figures.E, 6);
  EXPECT_DOUBLE_EQ(figures.M, 4.5);
  EXPECT_DOUBLE_EQ(figures.A, 8);
}

// One position: s = √2 of {1, 3}, and of {6, 10} it is √8. R = 2√2 + 2√8 + 6 = 6√2 + 6, more than 4√8 = 8√2.
TEST(Iso230, RepeatabilityAddsReversalAndBothSpreads) {
  const Iso230 figures = iso230({{{{1, 3}, {6, 10}}}});
  EXPECT_NEAR(figures.R, 6 * std::sqrt(2.0) + 6, 1e-12);
  EXPECT_NEAR(figures.A, (8 + 2 * std::sqrt(8.0)) - (2 - 2 * std::sqrt(2.0)), 1e-12);
  EXPECT_DOUBLE_EQ(figures.E, 6);
  EXPECT_DOUBLE_EQ(figures.M, 0);
}

TEST(Iso230, NothingMeasuredIsNothing) {
  EXPECT_EQ(iso230(std::vector<std::array<std::vector<double>, 2>>{}).A, 0);
  EXPECT_EQ(iso230({{{{1, 2}, {}}}}).R, 0);
}

TEST(Iso230, TakesResidualsWhereStrokesPass) {
  Measurement measurement;
  fusee::Run run;
  std::vector<double> residuals;
  for (int i = 0; i <= 200; ++i) {
    Sample sample;
    sample.alpha = i <= 100 ? 0.01 * i : 0.01 * (200 - i);
    run.samples.push_back(sample);
    residuals.push_back(i <= 100 ? 0.5 : 0.2);
  }
  run.strokes = {{0, 100, 1, 0, false}, {101, 200, -1, 0, false}};
  measurement.runs.push_back(run);
  const Iso230 figures = iso230(measurement, {residuals});
  EXPECT_NEAR(figures.B, 0.3, 1e-12);
  EXPECT_NEAR(figures.E, 0.3, 1e-12);
  EXPECT_NEAR(figures.R, 0.3, 1e-12);
  EXPECT_NEAR(figures.M, 0, 1e-12);
}

}  // namespace
}  // namespace fusee
