// Statistics of fits against numbers worked out by hand.
#include "calibration/statistics.h"

#include <gmock/gmock.h>

#include <limits>
#include <random>
#include <utility>

#include "calibration/linear_joint.h"
#include "calibration/thresholds.h"

namespace fusee::calibration::linear {
namespace {

calibration::Evidence two_runs() {
  return evidence_of(measured({0, 5}, [](const measurement::Sample&) { return 0.0; }));
}

/// A fit with these held-out errors, and a residual of rms 1 whose sign alternates from row to row.
calibration::Fit with_errors(const calibration::Evidence& evidence, const std::vector<double>& by_block,
                             Eigen::Index numbers = 0) {
  Eigen::VectorXd residual(evidence.theta.size());
  for (Eigen::Index i = 0; i < residual.size(); ++i) residual[i] = i % 2 == 0 ? 1 : -1;
  calibration::Fit fit = hand_made(evidence, Eigen::MatrixXd::Zero(residual.size(), numbers), residual);
  fit.by_factor.by_block = by_block;
  fit.by_factor.mean_square = std::accumulate(by_block.begin(), by_block.end(), 0.0) / 8;
  return fit;
}

TEST(LagOne, IsNegativeForAlternatingRows) {
  const calibration::Evidence evidence = two_runs();
  const calibration::Fit fit = with_errors(evidence, std::vector<double>(8, 1.0));
  EXPECT_DOUBLE_EQ(calibration::lag_one_correlation(evidence, fit.residual(evidence.rows())), -(k_rows - 1.0) / k_rows);
}

TEST(StrokeScatter, DistinguishesStrokeMeansFromRowNoise) {
  const calibration::Evidence evidence = two_runs();
  calibration::Fit fit = with_errors(evidence, std::vector<double>(8, 1.0));
  // Strokes 0 and 2 of a run go up, 1 and 3 down. The means of each pair differ by 2a.
  const double a = 3;
  for (std::size_t b = 0; b < 8; ++b) {
    for (const std::size_t row : evidence.blocks[b].rows)
      fit.residual[static_cast<Eigen::Index>(row)] += b % 4 < 2 ? a : -a;
  }
  const calibration::StrokeScatter found = calibration::stroke_scatter(evidence, fit);
  // Each mean uses one degree of freedom.
  EXPECT_NEAR(found.within, std::sqrt(k_rows / (k_rows - 1.0)), 1e-12);
  EXPECT_NEAR(found.between, std::sqrt(2 * a * a - 1.0 / (k_rows - 1.0)), 1e-12);
  EXPECT_TRUE(calibration::is_walking(found));
  EXPECT_FALSE(calibration::is_walking(
      calibration::stroke_scatter(evidence, with_errors(evidence, std::vector<double>(8, 1.0)))));
}

// A gain that changes at each reversal does not change the means of strokes.
TEST(StrokeScatter, DistinguishesStrokeTiltsFromRowNoise) {
  const calibration::Evidence evidence = two_runs();
  calibration::Fit fit = with_errors(evidence, std::vector<double>(8, 1.0));
  const double a = 3;
  for (std::size_t b = 0; b < 8; ++b) {
    const std::vector<std::size_t>& rows = evidence.blocks[b].rows;
    const double half = 0.5 * (static_cast<double>(rows.size()) - 1.0);
    const double rms = std::sqrt((static_cast<double>(rows.size() * rows.size()) - 1.0) / 12.0);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double along = (static_cast<double>(i) - half) / rms;
      fit.residual[static_cast<Eigen::Index>(rows[i])] += b % 4 < 2 ? a * along : -a * along;
    }
  }
  const calibration::StrokeScatter found = calibration::stroke_scatter(evidence, fit);
  EXPECT_EQ(found.between, 0);
  EXPECT_NEAR(found.about_tilts, std::sqrt(k_rows / (k_rows - 2.0)), 0.01);
  EXPECT_NEAR(found.tilts, std::sqrt(2) * a, 0.05);
  EXPECT_TRUE(calibration::is_walking(found));
}

// Strokes are sampled differently. A stroke that is cut short has the slope of the others.
TEST(StrokeScatter, StrokesOfOneSlopeAreAlike) {
  calibration::Evidence evidence = two_runs();
  calibration::Fit fit = with_errors(evidence, std::vector<double>(8, 1.0));
  fit.residual += 100 * calibration::alphas(evidence.measurement);
  for (const std::size_t b : {2, 3, 6, 7}) {
    std::vector<std::size_t>& rows = evidence.blocks[b].rows;
    rows = {rows.begin() + 2, rows.end() - 2};
  }
  const calibration::StrokeScatter found = calibration::stroke_scatter(evidence, fit);
  EXPECT_EQ(found.tilts, 0);
  EXPECT_FALSE(calibration::is_walking(found));
}

TEST(RarestRatio, IsExceededAsSeldomAsThreeStandardDeviations) {
  std::mt19937 random(7);
  for (const auto& [upper, lower] : {std::pair{1.0, 40.0}, {3.0, 20.0}, {5.0, 200.0}, {40.0, 15.0}, {200.0, 8.0}}) {
    std::chi_squared_distribution<double> above(upper), below(lower);
    const double ratio = calibration::rarest_ratio(upper, lower);
    constexpr int draws = 200000;
    int beyond = 0;
    for (int i = 0; i < draws; ++i) beyond += above(random) / upper > ratio * below(random) / lower ? 1 : 0;
    EXPECT_NEAR(static_cast<double>(beyond) / draws, 0.00135, 0.0005) << upper << " " << lower;
  }
  EXPECT_EQ(calibration::rarest_ratio(10, 1), std::numeric_limits<double>::infinity());
}

TEST(AsGood, EndsAtThreshold) {
  calibration::Fit best, rival;
  best.log_evidence = 100;
  rival.log_evidence = 100 - 0.99 * calibration::equally_likely();
  EXPECT_TRUE(calibration::is_as_good(rival, best));
  rival.log_evidence = 100 - 1.01 * calibration::equally_likely();
  EXPECT_FALSE(calibration::is_as_good(rival, best));
}

}  // namespace
}  // namespace fusee::calibration::linear
