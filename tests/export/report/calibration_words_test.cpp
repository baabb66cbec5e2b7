// Texts of identified parameters.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "base/text.h"
#include "export/report/calibration_plots.h"
#include "export/report/svg.h"
#include "fusee/base.h"
#include "fusee/export.h"

namespace fusee::formats {
namespace {

using ::testing::StartsWith;

// Fields of a parameter: name, value, 95 % interval with other effects marginalised, 95 % interval if its effect is the
// only cause, and its sign in words.
TEST(ParameterWords, DescribeSign) {
  EXPECT_EQ(parameter_words({"scale_percent", -1.2, -1.3, -1.1, -1.3, -1.1, "both pulleys are too small"}, ""),
            "scale = −1.2 %: both pulleys are too small (95 %: −1.3 … −1.1)");
  EXPECT_EQ(parameter_words({"EA_N", 4500, 4400, 4600, 4400, 4600}, ""), "EA = 4500 N (95 %: 4400 … 4600)");
}

TEST(ParameterWords, GiveTheNarrowerIntervalFirst) {
  EXPECT_EQ(parameter_words({"scale_percent", -1.2, -3.2, 0.8, -1.3, -1.1}, ""),
            "scale = −1.2 % (95 %: −1.3 … −1.1 if this is the only cause, else −3.2 … 0.8)");
}

TEST(ParameterWords, DistinguishTheEndsOfAnInterval) {
  EXPECT_EQ(interval_words(12.1812, 12.2241, 3), "12.18 … 12.22");
  EXPECT_EQ(interval_words(12.1, 12.9, 3), "12.1 … 12.9");
  EXPECT_EQ(interval_words(5, 5, 3), "5 … 5");
}

/// A joint with one stroke up and one down, and these errors of its angle, deg.
CalibrationProduct joint_with_errors(double (*error)(double theta)) {
  CalibrationProduct product;
  measurement::Run run;
  std::vector<double> residuals;
  for (const int direction : {1, -1}) {
    const std::size_t first = run.samples.size();
    for (int i = 0; i <= 80; ++i) {
      const double theta = direction > 0 ? i : 80 - i;
      measurement::Sample sample;
      sample.theta = radians(theta + error(theta));
      run.samples.push_back(sample);
      residuals.push_back(radians(error(theta)));
    }
    measurement::Stroke stroke;
    stroke.first = first;
    stroke.last = run.samples.size() - 1;
    stroke.direction = direction;
    run.strokes.push_back(stroke);
  }
  product.measurement.runs = {run};
  product.calibration.residuals_before = {residuals};
  product.calibration.verdict = calibration::CalibrationVerdict::unexplained;
  return product;
}

TEST(Headline, SaysEverywhereOnlyOfAConstantError) {
  const auto problem = [](double (*error)(double)) { return headline(joint_with_errors(error)).problem; };
  EXPECT_THAT(problem([](double) { return -0.6; }), StartsWith("The joint reads 0.6° low everywhere: "));
  // 0 at 0, −1.2° at 80°: the mean is −0.6°, and the cause is a gain.
  EXPECT_THAT(problem([](double theta) { return -0.015 * theta; }), StartsWith("The joint turns 1.5 % too little: "));
  // −0.6° in 60 of 81 rows: the mean is −0.44°.
  EXPECT_THAT(problem([](double theta) { return theta < 60 ? -0.6 : 0.0; }),
              StartsWith("The joint reads 0.44° low on average: "));
}

TEST(ResidualMap, CutsLongNamesBetweenCharacters) {
  CalibrationProduct product = joint_with_errors([](double) { return -0.6; });
  measurement::Run& run = product.measurement.runs.front();
  for (measurement::Sample& sample : run.samples) sample.alpha = sample.theta;
  product.calibration.residuals_after = product.calibration.residuals_before;
  const auto label_of = [&](std::size_t length) {
    run.name.clear();
    for (std::size_t i = 0; i < length; ++i) run.name += "µ";
    const std::string html = residual_map_html(product);
    EXPECT_TRUE(is_utf8(html)) << length;
    const std::size_t begin = std::min(html.find("…µ"), html.find("µ"));
    const std::string label = html.substr(begin, html.find('<', begin) - begin);
    return std::pair(characters(label), label.starts_with("…"));
  };
  EXPECT_EQ(label_of(28), std::pair(std::size_t{28}, false));
  EXPECT_EQ(label_of(40), std::pair(std::size_t{28}, true));
}

// An instruction ends at its first colon outside brackets.
TEST(Headline, KeepsAnInstructionWhole) {
  CalibrationProduct product = joint_with_errors([](double) { return -0.6; });
  plan::NextMeasurement next;
  next.words = "measure the tendon and enter half of its excess (negative: too small) as prior.radius_offset_mm";
  product.calibration.next = {next};
  EXPECT_EQ(headline(product).action,
            "Measure the tendon and enter half of its excess (negative: too small) as prior.radius_offset_mm.");
  product.calibration.next.front().words = "drive slowly: the pulley is tied";
  EXPECT_EQ(headline(product).action, "Drive slowly.");
}

calibration::FittedParameter number(const char* name, double value, double rms_deg, bool excludes_zero) {
  calibration::FittedParameter made;
  made.name = name;
  made.value = value;
  made.rms = radians(rms_deg);
  made.excludes_zero = excludes_zero;
  return made;
}

TEST(Headline, NamesTheNumbersThatMatter) {
  CalibrationProduct product = joint_with_errors([](double theta) { return 0.01 * theta; });
  calibration::FoundEffect effect;
  effect.name = "guide_position";
  effect.group = {"guide_position"};
  effect.parameters = {number("outward1_mm", 0.0306, 0.5, false), number("down1_mm", 0.2, 0.1, true),
                       number("down2_mm", 0.999, 0.4, true)};
  product.calibration.effects = {effect};
  EXPECT_EQ(headline(product).cause, "Guide position (down2 0.999 mm, down1 0.2 mm).");
}

TEST(Headline, GivesNoSizeOfZero) {
  CalibrationProduct product = joint_with_errors([](double theta) { return 0.01 * theta; });
  calibration::FoundEffect effect;
  effect.name = "zero_offset";
  effect.group = {"zero_offset", "slack", "motor_offset", "unmodelled"};
  effect.parameters = {number("offset_deg", 2, 2, true)};
  effect.alternatives = {{"slack", {number("slack_mm", 0, 0, false)}}};
  product.calibration.effects = {effect};
  EXPECT_EQ(headline(product).cause,
            "Either zero offset (offset 2°), or slack, or motor offset, or an unmodelled cause.");
  const std::vector<CauseRow> rows = cause_rows(product);
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[2].size, "not determined");
  EXPECT_EQ(rows[3].size, "–");
}

TEST(Headline, BeginsWithConditionOfRuns) {
  CalibrationProduct product = joint_with_errors([](double) { return 0.3; });
  calibration::LikelyInputError error;
  error.key = "load.tip_force_N";
  error.declared = {6};
  error.would_be = {0};
  error.question = "did nothing hang on the joint?";
  error.remedy = "If so, give --set load.tip_force_N=0; otherwise log the load as load_N";
  error.rms = radians(0.03);
  product.input_errors = {error};
  EXPECT_EQ(headline(product).problem,
            "No load in the runs without a load column, in place of load.tip_force_N = 6, would explain the data to "
            "0.03°: did nothing hang on the joint? If so, give --set load.tip_force_N=0; otherwise log the load as "
            "load_N.");
}

}  // namespace
}  // namespace fusee::formats
