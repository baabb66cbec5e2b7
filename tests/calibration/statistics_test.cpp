// What is said of fits, against numbers worked out by hand.
#include <gmock/gmock.h>

#include "calibration/acceptance.h"
#include "calibration/linear_joint.h"
#include "calibration/thresholds.h"

namespace fusee::linear {
namespace {

Evidence two_runs() {
  return evidence_of(measured({0, 5}, [](const Sample&) { return 0.0; }));
}

/// A fit with these held-out errors, and a residual of rms 1 that turns its sign from row to row.
Fit with_errors(const Evidence& evidence, const std::vector<double>& by_block, Eigen::Index numbers = 0) {
  Eigen::VectorXd residual(evidence.theta.size());
  for (Eigen::Index i = 0; i < residual.size(); ++i) residual[i] = i % 2 == 0 ? 1 : -1;
  Fit fit = hand_made(evidence, Eigen::MatrixXd::Zero(residual.size(), numbers), residual);
  fit.by_factor.by_block = by_block;
  fit.by_factor.mean_square = std::accumulate(by_block.begin(), by_block.end(), 0.0) / 8;
  return fit;
}

TEST(Compare, MeanAndStandardErrorAreThoseOfStrokes) {
  const Evidence evidence = two_runs();
  const Fit worse = with_errors(evidence, {3, 5, 3, 5, 3, 5, 3, 5});
  const Fit better = with_errors(evidence, std::vector<double>(8, 1.0));
  const Comparison found = compare(evidence, worse, better);
  const double standard_error = std::sqrt(8.0 / 7.0 / 8.0);  // of 2 4 2 4 …
  EXPECT_DOUBLE_EQ(found.mean, 3);
  EXPECT_DOUBLE_EQ(found.standard_error, standard_error);
  EXPECT_DOUBLE_EQ(found.t, 3 / standard_error);
  EXPECT_NEAR(found.needed_t, 1.895, 0.005);     // t of 7 degrees of freedom
  EXPECT_DOUBLE_EQ(found.t_over_runs, found.t);  // two runs say nothing of runs
}

TEST(Compare, RunsAreTheSampleToo) {
  const Evidence evidence = evidence_of(measured({0, 1, 2}, [](const Sample&) { return 0.0; }));
  const std::vector<double> drops = {1, 1, 1, 1, 2, 2, 2, 2, 6, 6, 6, 6};
  const Comparison found =
      compare(evidence, with_errors(evidence, drops), with_errors(evidence, std::vector<double>(12, 0.0)));
  EXPECT_DOUBLE_EQ(found.t_over_runs, 3 / std::sqrt((4 + 1 + 9) / 2.0 / 3.0));
}

TEST(Compare, BlocksThatNoFoldHoldsDoNotCount) {
  const Evidence evidence = two_runs();
  const double none = std::numeric_limits<double>::quiet_NaN();
  const Fit worse = with_errors(evidence, {3, 5, none, none, none, none, none, none});
  const Comparison found = compare(evidence, worse, with_errors(evidence, std::vector<double>(8, 1.0)));
  EXPECT_DOUBLE_EQ(found.mean, 3);
  EXPECT_DOUBLE_EQ(found.standard_error, 1);
  EXPECT_DOUBLE_EQ(found.needed_t, 6.31);
}

TEST(Bic, OfWhiteResidualsCountsEveryRow) {
  const Evidence evidence = two_runs();
  Fit worse = with_errors(evidence, std::vector<double>(8, 1.0)),
      better = with_errors(evidence, worse.by_factor.by_block, 2);
  worse.mean_square = 2;
  better.mean_square = 1;
  const double n = static_cast<double>(8 * k_rows);
  EXPECT_NEAR(bic_drop(evidence, worse, better), n * std::log(2.0) - 2 * std::log(n), 1e-9);
}

TEST(Bic, OfCorrelatedResidualsCountsFewer) {
  const Evidence evidence = two_runs();
  Fit worse = with_errors(evidence, std::vector<double>(8, 1.0)),
      better = with_errors(evidence, worse.by_factor.by_block, 1);
  better.residual.setOnes();
  worse.mean_square = 2;
  better.mean_square = 1;
  const double r = (k_rows - 1.0) / k_rows;  // of a constant: all neighbours agree
  EXPECT_DOUBLE_EQ(lag_one_correlation(evidence, better), r);
  const double n = std::max(8 * k_rows * (1 - r) / (1 + r), 8.0);  // never fewer than strokes
  EXPECT_NEAR(bic_drop(evidence, worse, better), n * std::log(2.0) - std::log(n), 1e-9);
}

TEST(LagOne, OfAlternatingRowsIsNegative) {
  const Evidence evidence = two_runs();
  EXPECT_DOUBLE_EQ(lag_one_correlation(evidence, with_errors(evidence, std::vector<double>(8, 1.0))),
                   -(k_rows - 1.0) / k_rows);
}

TEST(StrokeScatter, TellsMeansOfStrokesFromRowsWithin) {
  const Evidence evidence = two_runs();
  Fit fit = with_errors(evidence, std::vector<double>(8, 1.0));
  // Strokes 0 and 2 of a run go up, 1 and 3 down: a pair of each stands 2 a apart.
  const double a = 3;
  for (std::size_t b = 0; b < 8; ++b) {
    for (const std::size_t row : evidence.blocks[b].rows)
      fit.residual[static_cast<Eigen::Index>(row)] += b % 4 < 2 ? a : -a;
  }
  const StrokeScatter found = stroke_scatter(evidence, fit);
  EXPECT_NEAR(found.within, 1, 1e-12);
  EXPECT_NEAR(found.between, std::sqrt(2 * a * a - 1.0 / k_rows), 1e-12);
  EXPECT_TRUE(is_walking(found));
  EXPECT_FALSE(is_walking(stroke_scatter(evidence, with_errors(evidence, std::vector<double>(8, 1.0)))));
}

TEST(AsGood, WithinAStandardErrorOrAQuarterOfTheFloor) {
  const Evidence evidence = two_runs();
  const double quarter = 0.25 * k_floor * k_floor;
  const Fit best = with_errors(evidence, std::vector<double>(8, 1.0));
  EXPECT_TRUE(as_good(evidence, with_errors(evidence, std::vector<double>(8, 1.0 + 0.99 * quarter)), best));
  EXPECT_FALSE(as_good(evidence, with_errors(evidence, std::vector<double>(8, 1.0 + 1.01 * quarter)), best));
  EXPECT_TRUE(as_good(evidence, with_errors(evidence, {9, 1, 1, 1, 1, 1, 1, 1}), best));
  Fit contradicted = best;
  contradicted.against_readings = 9.1;
  EXPECT_FALSE(as_good(evidence, contradicted, best));
}

TEST(Floor, OneAnswerForSearchAndVerdict) {
  Fit fit;
  fit.by_run.mean_square = 1.34 * k_floor * k_floor;
  EXPECT_TRUE(is_at_floor(fit, k_floor));
  fit.by_run.mean_square = 1.36 * k_floor * k_floor;
  EXPECT_FALSE(is_at_floor(fit, k_floor));
  fit.price = 0.02 * k_floor * k_floor;  // what play answers for is no rest
  EXPECT_TRUE(is_at_floor(fit, k_floor));
}

// ---- acceptance -----------------------------------------------------------------------------------------------------

std::string refusal(const Evidence& evidence, const Fit& before, const Fit& after) {
  Candidate candidate;
  return accepted(evidence, before, after, candidate) ? "" : candidate.why;
}

TEST(Acceptance, EveryReasonInTurn) {
  const Evidence evidence = two_runs();
  const double floor2 = k_floor * k_floor;
  const auto fit = [&](double error, double mean_square, Eigen::Index numbers) {
    Fit made = with_errors(evidence, std::vector<double>(8, error), numbers);
    for (std::size_t b = 0; b < 8; b += 2) made.by_factor.by_block[b] *= 1.001;  // no two strokes are the same
    made.mean_square = mean_square;
    return made;
  };
  const Fit before = fit(9 * floor2, 9, 0), good = fit(floor2, 1, 1);
  EXPECT_EQ(refusal(evidence, before, good), "");
  EXPECT_THAT(refusal(evidence, before, Fit{}), testing::HasSubstr("could not be simulated"));
  EXPECT_THAT(refusal(evidence, before, fit(8.8 * floor2, 1, 1)), testing::HasSubstr("what the noise would show"));
  Fit lucky = good;
  lucky.by_factor.by_block.assign(8, 9 * floor2);
  lucky.by_factor.by_block[0] = 0;
  EXPECT_THAT(refusal(evidence, before, lucky), testing::HasSubstr("in some strokes and not in others"));
  EXPECT_THAT(refusal(evidence, before, fit(floor2, 8.9, 9)), testing::HasSubstr("too many numbers"));
  EXPECT_THAT(refusal(evidence, before, fit(7 * floor2, 1, 1)), testing::HasSubstr("a small part of what is there"));
}

}  // namespace
}  // namespace fusee::linear
