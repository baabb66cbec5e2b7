#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "fusee/measurement.h"

namespace fusee::measurement {
namespace {

// Worked by hand, three positions, three repeats:
//   i   up           x̄    s     down          x̄    s    B     2s↑+2s↓+|B|  4s↑  4s↓  mean
//   1   1 2 3        2    1     5 5 5         5    0    −3    5            4    0    3.5
//   2   0 0 0        0    0     1 3 5         3    2    −3    7            0    8    1.5
//   3   −1 −1 −1     −1   0     −1 −1 −1      −1   0    0     0            0    0    −1
// B = 3; R = 8; E = 5 − (−1) = 6; M = 3.5 − (−1) = 4.5; A = (3 + 4) − (−1 or 3 − 4 = −1) = 8
TEST(Iso230, MatchesHandCalculation) {
  const Iso230 figures = iso230({{{{1, 2, 3}, {5, 5, 5}}}, {{{0, 0, 0}, {1, 3, 5}}}, {{{-1, -1, -1}, {-1, -1, -1}}}});
  EXPECT_DOUBLE_EQ(figures.B, 3);
  EXPECT_DOUBLE_EQ(figures.R, 8);
  EXPECT_DOUBLE_EQ(figures.E, 6);
  EXPECT_DOUBLE_EQ(figures.M, 4.5);
  EXPECT_DOUBLE_EQ(figures.A, 8);
}

// Worked by hand, two positions, both directions, three repeats, in units of .01°:
//   i   up           x̄    s     down          x̄    s    B     2s↑+2s↓+|B|   4s↑   4s↓   mean
//   1   4 6 8        6    2     −1 0 1        0    1    6     4+2+6 = 12    8     4     3
//   2   −9 −6 −3     −6   3     −8 −8 −8      −8   0    2     6+0+2 = 8     12    0     −7
// B = 6; R = 12, from position 1 by its sum and from position 2 by 4s↑; E = 6 − (−8) = 14; M = 3 − (−7) = 10;
// A = max(6+4, 0+2, −6+6, −8) − min(6−4, 0−2, −6−6, −8) = 10 − (−12) = 22
TEST(Iso230, MatchesHandCalculationOfTwoPositions) {
  const Iso230 figures = iso230({{{{4, 6, 8}, {-1, 0, 1}}}, {{{-9, -6, -3}, {-8, -8, -8}}}});
  EXPECT_DOUBLE_EQ(figures.B, 6);
  EXPECT_DOUBLE_EQ(figures.R, 12);
  EXPECT_DOUBLE_EQ(figures.E, 14);
  EXPECT_DOUBLE_EQ(figures.M, 10);
  EXPECT_DOUBLE_EQ(figures.A, 22);
  // Each position alone: R of the second is 4s↑, which exceeds 2s↑ + 2s↓ + |B|.
  EXPECT_DOUBLE_EQ(iso230({{{{4, 6, 8}, {-1, 0, 1}}}}).R, 12);
  EXPECT_DOUBLE_EQ(iso230({{{{-9, -6, -3}, {-8, -8, -8}}}}).R, 12);
  // For a downward scatter it is 4s↓.
  EXPECT_DOUBLE_EQ(iso230({{{{-8, -8, -8}, {-9, -6, -3}}}}).R, 12);
}

// A compensation table removes reversal and shape, and leaves R at 4s.
TEST(Iso230, RepeatabilityIsBoundedByFourDeviations) {
  const Iso230 figures = iso230({{{{-2, 0, 2}, {-2, 0, 2}}}, {{{-2, 0, 2}, {0, 0, 0}}}});
  EXPECT_DOUBLE_EQ(figures.B, 0);
  EXPECT_DOUBLE_EQ(figures.E, 0);
  EXPECT_DOUBLE_EQ(figures.M, 0);
  EXPECT_DOUBLE_EQ(figures.R, 8);  // s = 2
  EXPECT_DOUBLE_EQ(figures.A, 8);
}

// Neither a constant offset nor a reversed sign changes a figure. A factor of two doubles all of them.
TEST(Iso230, FiguresIgnoreOffsetAndFollowScale) {
  const auto of = [](double factor, double offset) {
    std::vector<std::array<std::vector<double>, 2>> all = {{{{4, 6, 8}, {-1, 0, 1}}}, {{{-9, -6, -3}, {-8, -8, -8}}}};
    for (auto& position : all) {
      for (auto& direction : position) {
        for (double& value : direction) value = factor * value + offset;
      }
    }
    return iso230(all);
  };
  const Iso230 one = of(1, 0);
  for (const auto& [factor, offset] : {std::pair{1.0, 100.0}, std::pair{-1.0, 0.0}, std::pair{2.0, -7.0}}) {
    const Iso230 other = of(factor, offset);
    for (double Iso230::*figure : {&Iso230::A, &Iso230::R, &Iso230::B, &Iso230::E, &Iso230::M}) {
      EXPECT_NEAR(other.*figure, std::abs(factor) * one.*figure, 1e-12);
    }
  }
}

// One position: s = √2 of {1, 3}, and of {6, 10} it is √8. R = 2√2 + 2√8 + 6 = 6√2 + 6, more than 4√8 = 8√2.
TEST(Iso230, RepeatabilityAddsReversalAndBothSpreads) {
  const Iso230 figures = iso230({{{{1, 3}, {6, 10}}}});
  EXPECT_NEAR(figures.R, 6 * std::sqrt(2.0) + 6, 1e-12);
  EXPECT_NEAR(figures.A, (8 + 2 * std::sqrt(8.0)) - (2 - 2 * std::sqrt(2.0)), 1e-12);
  EXPECT_DOUBLE_EQ(figures.E, 6);
  EXPECT_DOUBLE_EQ(figures.M, 0);
}

TEST(Iso230, IsZeroWithoutData) {
  EXPECT_EQ(iso230(std::vector<std::array<std::vector<double>, 2>>{}).A, 0);
  EXPECT_EQ(iso230({{{{1, 2}, {}}}}).R, 0);
}

TEST(Iso230, InterpolatesResidualsAtPositions) {
  Measurement measurement;
  fusee::measurement::Run run;
  std::vector<double> residuals;
  for (int i = 0; i <= 200; ++i) {
    Sample sample;
    sample.alpha = i <= 100 ? 0.01 * i : 0.01 * (200 - i);
    run.samples.push_back(sample);
    residuals.push_back(i <= 100 ? 0.5 : 0.2);
  }
  // Strokes: first and last row, direction, cycle, partial. A partial stroke does not count; its residuals are large
  // here.
  run.strokes = {{0, 100, 1, 0, false}, {101, 200, -1, 0, false}, {201, 250, 1, 1, true}};
  for (int i = 0; i < 50; ++i) {
    Sample sample;
    sample.alpha = 0.02 * i;
    run.samples.push_back(sample);
    residuals.push_back(9);
  }
  measurement.runs.push_back(run);
  // A place without a model does not count.
  residuals[30] = std::numeric_limits<double>::quiet_NaN();
  const Iso230 figures = iso230(measurement, {residuals});
  EXPECT_NEAR(figures.B, 0.3, 1e-12);
  EXPECT_NEAR(figures.E, 0.3, 1e-12);
  EXPECT_NEAR(figures.R, 0.3, 1e-12);
  EXPECT_NEAR(figures.M, 0, 1e-12);
}

}  // namespace
}  // namespace fusee::measurement
