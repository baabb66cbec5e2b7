// Measures of sharpness, on answers whose values are known.
#include "rig/sharpness.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

#include "fusee/base.h"

namespace fusee::rig {
namespace {

TEST(Sharpness, AreaCountsEqualScoresHalf) {
  EXPECT_DOUBLE_EQ(area_under_roc({3, 4}, {1, 2}), 1.0);
  EXPECT_DOUBLE_EQ(area_under_roc({1, 3}, {1, 2}), 0.625);
  EXPECT_TRUE(std::isnan(area_under_roc({}, {1})));
}

TEST(Sharpness, LogOddsFollowBestAlternative) {
  calibration::Calibration found;
  EXPECT_EQ(unmodelled_log_odds(found), -1000);
  found.effects.resize(2);
  found.effects[0].unmodelled.log_odds = 20;
  found.effects[1].unmodelled.log_odds = 5;
  EXPECT_EQ(unmodelled_log_odds(found), -5);
  found.discrepancy.resize(1);
  found.discrepancy[0].evidence = 12;
  EXPECT_EQ(unmodelled_log_odds(found), 12);
  found.verdict = calibration::CalibrationVerdict::not_repeatable;
  EXPECT_EQ(unmodelled_log_odds(found), 1000);
}

/// The Cramér-Rao bound of a constant offset in n rows is the noise over the root of n.
TEST(Sharpness, OffsetBoundIsNoiseOverRootOfRows) {
  const Case made = make_case(truth_of("zero_offset"), 980501);
  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "sharpness_of_offset";
  write_case(made, folder);
  const CaseInput input = read_case(made, folder);
  std::filesystem::remove_all(folder);
  std::size_t rows = 0;
  for (const auto& run : input.measurement.runs) rows += run.samples.size();
  const double variance = made.sensors.noise * made.sensors.noise + made.sensors.quantum * made.sensors.quantum / 12;
  const double fewer = (1 - made.sensors.colour) / (1 + made.sensors.colour);
  const double bound = degrees(std::sqrt(variance / (fewer * static_cast<double>(rows))));
  calibration::Calibration found;
  calibration::FoundEffect effect;
  effect.name = "zero_offset";
  effect.group = {"zero_offset", "motor_offset"};
  calibration::FittedParameter number;
  number.name = "offset_deg";
  number.low = -3 * bound;
  number.high = 3 * bound;
  number.low_if_only = -1.959964 * bound;
  number.high_if_only = 1.959964 * bound;
  effect.parameters = {number};
  found.effects = {effect};
  const Sharpness one = sharpness_of(made, input, {found, judge(made, found)});
  EXPECT_FALSE(one.has_unmodelled);
  EXPECT_THAT(one.group_sizes, ::testing::ElementsAre(2u));
  ASSERT_EQ(one.widths.size(), 1u);
  EXPECT_NEAR(one.widths[0], 6 / (2 * 1.959964), 1e-4);
  EXPECT_NEAR(one.widths_if_only[0], 1, 1e-4);
}

}  // namespace
}  // namespace fusee::rig
