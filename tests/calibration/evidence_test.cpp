// Thinning of runs, their blocks, and the folds that are held out together.
#include "calibration/evidence.h"

#include <gmock/gmock.h>

#include <array>
#include <cmath>

#include "calibration/linear_joint.h"
#include "calibration/model.h"

namespace fusee::calibration::linear {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

measurement::Measurement quiet(const std::vector<double>& loads) {
  return measured(loads, [](const measurement::Sample&) { return 0.0; });
}

std::vector<std::size_t> strokes_of(const calibration::Evidence& evidence, std::size_t run) {
  std::vector<std::size_t> strokes;
  for (const calibration::Block& block : evidence.blocks) {
    if (block.run == run) strokes.push_back(block.stroke);
  }
  return strokes;
}

TEST(Gather, FirstStrokeSettlesPlay) {
  measurement::Measurement measurement = quiet({0, 5});
  measurement.runs[1].strokes.resize(2);  // too few strokes to omit the first
  const calibration::Evidence evidence = calibration::gather(joint(), measurement, k_floor);
  EXPECT_THAT(strokes_of(evidence, 0), ElementsAre(1, 2, 3));
  EXPECT_THAT(strokes_of(evidence, 1), ElementsAre(0, 1));
  EXPECT_EQ(evidence.rows_used(), 5 * k_rows);
  EXPECT_EQ(evidence.rows().size(), evidence.rows_used());
  EXPECT_EQ(evidence.theta.size(), static_cast<Eigen::Index>(8 * k_rows));
}

TEST(Gather, OmitsPartialStrokes) {
  measurement::Measurement measurement = quiet({0});
  measurement.runs[0].strokes[2].partial = true;
  EXPECT_THAT(strokes_of(calibration::gather(joint(), measurement, k_floor), 0), ElementsAre(1, 3));
}

TEST(Gather, DropsRowThatJumps) {
  measurement::Measurement measurement = quiet({0});
  const std::size_t wild = 2 * k_rows + 7;
  measurement.runs[0].samples[wild].theta += 20 * k_floor;
  const calibration::Evidence evidence = calibration::gather(joint(), measurement, k_floor);
  EXPECT_EQ(evidence.rows_used(), 3 * k_rows - 1);
  for (const calibration::Block& block : evidence.blocks)
    EXPECT_EQ(std::count(block.rows.begin(), block.rows.end(), wild), 0);
  EXPECT_NEAR(evidence.theta[wild], measurement.runs[0].samples[wild].theta, 1e-15) << "it stays as history";
}

TEST(Gather, ThinsLongRunsAndKeepsStrokeEnds) {
  measurement::Measurement measurement = quiet({0});
  fusee::measurement::Run& run = measurement.runs[0];
  const fusee::measurement::Run pattern = run;
  run.samples.clear();
  constexpr std::size_t finer = 200;
  for (const measurement::Sample& sample : pattern.samples) run.samples.insert(run.samples.end(), finer, sample);
  for (measurement::Stroke& stroke : run.strokes)
    stroke = {stroke.first * finer, stroke.last * finer + finer - 1, stroke.direction};
  const calibration::Evidence evidence = calibration::gather(joint(), measurement, k_floor);
  const fusee::measurement::Run& thin = evidence.measurement.runs[0];
  EXPECT_LE(evidence.rows_used(), 850u);
  EXPECT_GE(evidence.rows_used(), 500u);
  ASSERT_EQ(thin.strokes.size(), 4u);
  for (std::size_t s = 0; s < 4; ++s) {
    EXPECT_EQ(thin.samples[thin.strokes[s].first].alpha, pattern.samples[pattern.strokes[s].first].alpha);
    EXPECT_EQ(thin.samples[thin.strokes[s].last].alpha, pattern.samples[pattern.strokes[s].last].alpha);
  }
}

TEST(Folds, FoldsOfSingleRunAreStrokes) {
  const calibration::Evidence evidence = calibration::gather(joint(), quiet({0}), k_floor);
  EXPECT_THAT(evidence.run_folds, ElementsAre(ElementsAre(0), ElementsAre(1), ElementsAre(2)));
  EXPECT_EQ(evidence.factor_folds, evidence.run_folds);
  EXPECT_THAT(evidence.factors, IsEmpty());
}

TEST(Folds, FoldsOfAlikeRunsAreRuns) {
  const calibration::Evidence evidence = calibration::gather(joint(), quiet({0, 0}), k_floor);
  EXPECT_THAT(evidence.run_folds, ElementsAre(ElementsAre(0, 1, 2), ElementsAre(3, 4, 5)));
  EXPECT_EQ(evidence.factor_folds, evidence.run_folds);
}

TEST(Folds, HoldWholeLevelsOfLoadOut) {
  const calibration::Evidence evidence = calibration::gather(joint(), quiet({0, 5, 0.1, 5}), k_floor);
  EXPECT_THAT(evidence.factors, ElementsAre("load"));
  EXPECT_THAT(evidence.factor_folds, ElementsAre(ElementsAre(0, 1, 2, 6, 7, 8), ElementsAre(3, 4, 5, 9, 10, 11)));
}

TEST(Folds, SplitsLevelOfMostBlocksByRun) {
  const calibration::Evidence evidence = calibration::gather(joint(), quiet({0, 0, 5}), k_floor);
  EXPECT_THAT(evidence.factors, ElementsAre("load"));
  EXPECT_THAT(evidence.factor_folds, ElementsAre(ElementsAre(6, 7, 8), ElementsAre(0, 1, 2), ElementsAre(3, 4, 5)));
}

TEST(Folds, SpeedIsAFactorToo) {
  measurement::Measurement measurement = quiet({0, 0});
  measurement.runs[1].speed *= 5;
  EXPECT_THAT(calibration::gather(joint(), measurement, k_floor).factors, ElementsAre("speed"));
}

// ---- dwells and load levels -----------------------------------------------------------------------------------------

/// The number of each block's kind: blocks of a run that repeat one another share it.
std::vector<std::size_t> repeats_in(const calibration::Evidence& evidence) {
  std::vector<std::size_t> alike;
  for (const calibration::Block& block : evidence.blocks) alike.push_back(block.alike);
  return alike;
}

/// Dwells at both ends in turn, of `rows` rows each, under these loads.
measurement::Measurement dwells_at_ends(const std::vector<double>& loads, std::size_t rows) {
  measurement::Measurement measurement;
  fusee::measurement::Run& run = measurement.runs.emplace_back();
  run.name = "run_1";
  run.has_time = run.has_load = true;
  for (std::size_t visit = 0; visit < loads.size(); ++visit) {
    const int direction = visit % 2 == 0 ? -1 : 1;
    const std::size_t first = run.samples.size();
    for (std::size_t i = 0; i < rows; ++i) {
      measurement::Sample sample;
      sample.time = static_cast<double>(run.samples.size());
      sample.alpha = direction;
      sample.theta = sample.alpha / k_ratio;
      sample.load = loads[visit];
      run.samples.push_back(sample);
    }
    run.strokes.push_back({first, first + rows - 1, direction, static_cast<int>(visit / 2), false});
    run.segments.push_back({first, first + rows - 1, visit, true, 0});
  }
  return measurement;
}

/// Five strokes of 60 rows, there and back. The thirds of each stroke have the loads `levels`.
measurement::Measurement in_thirds(const std::array<double, 3>& levels) {
  measurement::Measurement measurement;
  fusee::measurement::Run& run = measurement.runs.emplace_back();
  run.name = "run_1";
  run.has_time = run.has_load = true;
  for (std::size_t stroke = 0; stroke < 5; ++stroke) {
    const int direction = stroke % 2 == 0 ? 1 : -1;
    const std::size_t first = run.samples.size();
    for (std::size_t i = 0; i < 60; ++i) {
      measurement::Sample sample;
      sample.time = static_cast<double>(run.samples.size());
      sample.alpha = direction * (static_cast<double>(i) / 59 - 0.5);
      sample.theta = sample.alpha / k_ratio;
      sample.load = levels[i / 20];
      run.samples.push_back(sample);
    }
    run.strokes.push_back({first, first + 59, direction, static_cast<int>(stroke / 2), false});
    for (const std::size_t third : {0, 1, 2})
      run.segments.push_back({first + 20 * third, first + 20 * third + 19, stroke, false, 0});
  }
  return measurement;
}

TEST(Gather, SegmentsAtTwoPlacesAreNoRepeats) {
  const calibration::Evidence evidence = calibration::gather(joint(), in_thirds({5, 0, 5}), k_floor);
  EXPECT_THAT(repeats_in(evidence), ElementsAre(0, 1, 2, 3, 4, 5, 0, 1, 2, 3, 4, 5));
}

TEST(Gather, DwellsAreBlocks) {
  const calibration::Evidence evidence =
      calibration::gather(joint(), dwells_at_ends({0, 0, 0, 0, 5, 5, 5, 5}, 10), k_floor);
  // The first dwell is omitted: the side from which the motor came is unknown.
  EXPECT_THAT(strokes_of(evidence, 0), ElementsAre(1, 2, 3, 4, 5, 6, 7));
  EXPECT_THAT(repeats_in(evidence), ElementsAre(0, 1, 0, 2, 3, 2, 3));
  EXPECT_THAT(evidence.factors, ElementsAre("load"));
  EXPECT_THAT(evidence.factor_folds, ElementsAre(ElementsAre(0, 1, 2), ElementsAre(3, 4, 5, 6)));
}

TEST(Gather, ShortDwellsOfOneKindAreJoined) {
  const calibration::Evidence evidence =
      calibration::gather(joint(), dwells_at_ends(std::vector<double>(49, 0.0), 1), k_floor);
  EXPECT_EQ(evidence.rows_used(), 48u);
  ASSERT_EQ(evidence.blocks.size(), 8u);
  for (const calibration::Block& block : evidence.blocks) {
    const int direction = evidence.measurement.runs[0].strokes[block.stroke].direction;
    for (const std::size_t row : block.rows) EXPECT_EQ(evidence.measurement.runs[0].samples[row].alpha, direction);
  }
}

TEST(Gather, ThinsLongDwells) {
  const calibration::Evidence evidence =
      calibration::gather(joint(), dwells_at_ends(std::vector<double>(40, 0.0), 2000), k_floor);
  EXPECT_EQ(evidence.blocks.size(), 39u);
  EXPECT_LE(evidence.rows_used(), 850u);
  EXPECT_GE(evidence.rows_used(), 39 * 6u);
}

TEST(Gather, HistoryOfManyDwellsPrecedesSelectedOnes) {
  const calibration::Evidence evidence =
      calibration::gather(joint(), dwells_at_ends(std::vector<double>(100'000, 0.0), 3), k_floor);
  EXPECT_GE(evidence.rows_used(), 500u);
  EXPECT_LE(evidence.theta.size(), 12'000);
  for (const measurement::Stroke& stroke : evidence.measurement.runs[0].strokes)
    EXPECT_EQ(evidence.measurement.runs[0].samples[stroke.first].alpha, stroke.direction);
}

TEST(Folds, HoldLevelsOfLoadWithinARunOut) {
  measurement::Measurement measurement;
  measurement.runs.push_back(run_of("run_1", 0, 6));
  for (std::size_t i = 0; i < 6 * k_rows; ++i) measurement.runs[0].samples[i].load = i < 4 * k_rows ? 0 : 5;
  const calibration::Evidence evidence = calibration::gather(joint(), measurement, k_floor);
  EXPECT_THAT(evidence.factors, ElementsAre("load"));
  EXPECT_THAT(evidence.factor_folds, ElementsAre(ElementsAre(0, 1, 2), ElementsAre(3, 4)));
}

TEST(Folds, LoadThatFollowsMotionIsOneLevel) {
  measurement::Measurement measurement;
  measurement.runs.push_back(run_of("run_1", 0, 6));
  for (std::size_t i = 0; i < 6 * k_rows; ++i) measurement.runs[0].samples[i].load = i / k_rows % 2 == 0 ? 5 : -5;
  EXPECT_THAT(calibration::gather(joint(), measurement, k_floor).factors, IsEmpty());
}

/// Half the weighted squares of the rows, plus the cost of their play, nats.
double cost_of_rows(const Eigen::VectorXd& residuals, double loose, double floor) {
  const Eigen::VectorXd weighted = residuals * floor / std::hypot(floor, loose / 3.0);
  const Eigen::VectorXd plays = Eigen::VectorXd::Constant(residuals.size(), loose);
  return 0.5 * weighted.squaredNorm() / (floor * floor) + calibration::loose_rows(weighted, plays, floor).nats;
}

TEST(Play, LooseRowsRestPushedOrAnywhere) {
  constexpr double floor = 0.01, loose = 0.3;
  constexpr Eigen::Index count = 400;
  const double fitted = 0.5 * std::log(count);  // cost of the share that is fitted
  EXPECT_EQ(calibration::loose_rows(Eigen::VectorXd::Constant(9, 0.02), Eigen::VectorXd::Zero(9), floor).nats,
            0);  // no play
  // Rest at the pushed position, with noise: the cost of taut rows.
  const Eigen::VectorXd noise = floor * Eigen::VectorXd::LinSpaced(count, -1.7, 1.7);
  EXPECT_NEAR(cost_of_rows(noise, loose, floor), 0.5 * noise.squaredNorm() / (floor * floor) + fitted, 0.5);
  // Rest anywhere: a normal density √(1 + 10²) = 10.05 times as wide as the noise costs ln 10.05 = 2.3076, and half the
  // square of 0.1 rad in its standard deviations, 0.4950.
  const Eigen::VectorXd far = Eigen::VectorXd::Constant(count, 0.1);
  EXPECT_NEAR(cost_of_rows(far, loose, floor), count * (2.3076 + 0.4950) + fitted, 0.5);
  // Half of each: the sum of both, and ln 2 per row because its kind is unknown.
  Eigen::VectorXd mixed = noise;
  mixed.tail(count / 2) = far.tail(count / 2);
  const double separate = 0.5 * noise.head(count / 2).squaredNorm() / (floor * floor) + count / 2 * (2.3076 + 0.4950);
  EXPECT_NEAR(cost_of_rows(mixed, loose, floor), separate + count * std::log(2.0) + fitted, 0.15 * count);
}

TEST(Play, DensityIntegratesToOne) {
  // Integral over the value of one more row, beside 200 rows that determine where such rows rest.
  constexpr double floor = 0.01, loose = 0.3, step = 0.2 * floor;
  for (const double others : {0.0, 0.12}) {
    Eigen::VectorXd rows = Eigen::VectorXd::Constant(201, others);
    const double rest = cost_of_rows(rows.head(200), loose, floor);
    double sum = 0;
    for (int i = -500; i <= 500; ++i) {
      rows[200] = i * step;
      sum += std::exp(rest - cost_of_rows(rows, loose, floor)) * step;
    }
    EXPECT_NEAR(sum / (floor * std::sqrt(k_two_pi)), 1.0, 0.03) << others;
  }
}

}  // namespace
}  // namespace fusee::calibration::linear
