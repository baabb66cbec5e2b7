// The empirical curve of the unmodelled error, on a rig that shares no equation with it: its predicted gain is compared
// with new runs of the same joint.
#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <sstream>

#include "fusee/correction.h"
#include "fusee/joint.h"
#include "rig/judge.h"
#include "rig/truths.h"

namespace fusee::rig {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

std::filesystem::path scratch(const std::string& name) {
  return std::filesystem::path(testing::TempDir()) / ("fusee_covered_" + name);
}

measurement::Measurement read(const Case& made) {
  const std::filesystem::path folder = scratch(made.truth + std::to_string(made.seed));
  measurement::Measurement measurement = measurement::read_measurement(write_case(made, folder), made.joint.declared);
  std::filesystem::remove_all(folder);
  return measurement;
}

struct Answer {
  Case made;
  calibration::Calibration calibration;
  correction::Correction correction;
};

Answer answer(const std::vector<std::string>& faults, std::uint64_t seed, Protocol protocol = Protocol::full) {
  CaseOptions options;
  options.protocol = protocol;
  Answer answer{make_case({faults.front(), faults}, seed, options), {}, {}};
  const measurement::Measurement measurement = read(answer.made);
  calibration::CalibrationOptions quick;
  quick.audit = false;
  answer.calibration = calibration::calibrate(answer.made.joint.declared, measurement, quick);
  answer.correction = correction::correct(answer.made.joint.declared, measurement, answer.calibration);
  return answer;
}

/// Measures the same joint and programme again, with other noise.
Case measured_again(Case made) {
  made.sensors.seed += 1000;
  made.logs = log_runs(made.joint, made.hidden, made.plans, made.sensors, made.motion);
  return made;
}

/// Rms of measured − model on new runs, rad.
struct RemainingError {
  double effects = 0;
  double with_curve = 0;

  double gain() const { return std::sqrt(std::max(0.0, effects * effects - with_curve * with_curve)); }
};

RemainingError error_on_new_runs(const Answer& answer) {
  const calibration::EmpiricalCurve& curve = answer.calibration.curve;
  const measurement::Measurement again = read(measured_again(answer.made));
  const joint::Readings model =
      joint::predict(answer.made.joint.declared, answer.calibration.identified, measurement::bench_log(again));
  double without = 0, with = 0, rows = 0;
  for (std::size_t r = 0; r < again.runs.size(); ++r) {
    for (const measurement::Stroke& stroke : again.runs[r].strokes) {
      for (std::size_t i = stroke.first; !stroke.partial && i <= stroke.last; ++i) {
        const measurement::Sample& sample = again.runs[r].samples[i];
        const double off = sample.theta - model[r][i];
        if (sample.alpha < curve.alpha.front() || sample.alpha > curve.alpha.back() || !std::isfinite(off)) continue;
        without += off * off;
        with += std::pow(off - curve.at(sample.alpha, stroke.direction > 0), 2);
        rows += 1;
      }
    }
  }
  return {std::sqrt(without / rows), std::sqrt(with / rows)};
}

/// A line of compensation.csv, deg.
using Line = std::array<double, 5>;

std::vector<Line> lines_of(const std::string& csv) {
  std::istringstream text(csv);
  std::string row;
  std::getline(text, row);
  EXPECT_EQ(row, "theta_deg,alpha_up_deg,alpha_down_deg,empirical_up_deg,empirical_down_deg");
  std::vector<Line> lines;
  while (std::getline(text, row)) {
    std::istringstream cells(row);
    Line line{};
    for (double& number : line) {
      std::string cell;
      std::getline(cells, cell, ',');
      number = std::strtod(cell.c_str(), nullptr);
    }
    lines.push_back(line);
  }
  return lines;
}

/// Rms deviation of a joint from the table, deg, over the rows of a log after its first reversal.
double deviation_from_table(const Log& log, const std::vector<Line>& table, bool with_curve) {
  double squares = 0, rows = 0;
  for (std::size_t i = log.size() / 4 + 1; i < log.size(); ++i) {
    const std::size_t column = log[i].alpha > log[i - 1].alpha ? 1 : 2;
    const double alpha = degrees(log[i].alpha);
    const auto alpha_of = [&](const Line& line) { return line[column] - (with_curve ? 0.0 : line[column + 2]); };
    for (std::size_t k = 1; k < table.size(); ++k) {
      const double from = alpha_of(table[k - 1]), to = alpha_of(table[k]);
      if (alpha < from || alpha >= to) continue;
      const double theta = table[k - 1][0] + (table[k][0] - table[k - 1][0]) * (alpha - from) / (to - from);
      squares += std::pow(degrees(log[i].theta) - theta, 2);
      rows += 1;
    }
  }
  return std::sqrt(squares / rows);
}

std::vector<std::string> names_of(const calibration::Calibration& calibration) {
  std::vector<std::string> names;
  for (const calibration::FoundEffect& effect : calibration.effects)
    names.insert(names.end(), effect.group.begin(), effect.group.end());
  return names;
}

TEST(EmpiricalCurve, CoversBumpAsPredicted) {
  const Answer found = answer({"lump"}, 1);
  const calibration::EmpiricalCurve& curve = found.calibration.curve;
  ASSERT_TRUE(curve.used) << curve.why;
  EXPECT_GT(degrees(curve.gain), 0.15);
  const RemainingError residual = error_on_new_runs(found);
  EXPECT_NEAR(residual.gain(), curve.gain, 0.05 * curve.gain);
  EXPECT_NEAR(residual.effects, curve.held_out_effects, 0.05 * residual.effects);
  EXPECT_NEAR(residual.with_curve, curve.held_out_rms, 0.2 * residual.with_curve);
  EXPECT_EQ(found.correction.by_curve, curve.gain);
  EXPECT_GE(found.correction.by_table, found.correction.by_curve);
}

TEST(EmpiricalCurve, TableReducesControllerError) {
  const Answer found = answer({"lump"}, 1);
  const std::vector<Line> table = lines_of(correction::compensation_csv(found.correction));
  const Case again = measured_again(found.made);
  const Log& unloaded = again.logs.front();
  const double before = deviation_from_table(unloaded, table, false),
               after = deviation_from_table(unloaded, table, true);
  EXPECT_LT(after, 0.3 * before);
  EXPECT_NEAR(std::sqrt(before * before - after * after), degrees(found.calibration.curve.gain),
              0.1 * degrees(found.calibration.curve.gain));
}

TEST(EmpiricalCurve, DistinguishesDirections) {
  const Answer found = answer({"climbing_flank"}, 3);  // acts only while tendon 2 is wound in
  const calibration::EmpiricalCurve& curve = found.calibration.curve;
  ASSERT_TRUE(curve.used) << curve.why;
  double up = 0, down = 0;
  for (std::size_t i = 0; i < curve.alpha.size(); ++i) {
    up = std::max(up, std::abs(curve.up[i]));
    down = std::max(down, std::abs(curve.down[i]));
  }
  EXPECT_GT(up, 10 * down);
  EXPECT_GT(error_on_new_runs(found).gain(), 0.9 * curve.gain);
}

TEST(EmpiricalCurve, KeepsKnownCause) {
  const Answer found = answer({"backlash", "lump"}, 1);
  EXPECT_THAT(names_of(found.calibration), Contains("backlash"));
  ASSERT_TRUE(found.calibration.curve.used) << found.calibration.curve.why;
  EXPECT_NEAR(error_on_new_runs(found).gain(), found.calibration.curve.gain, 0.15 * found.calibration.curve.gain);
}

struct UncorrectableFault {
  const char* fault;
  std::uint64_t seed;
};

TEST(EmpiricalCurve, RejectsLoadOrTimeDependence) {
  // A flat under a compliant tendon, and knots that have settled by the second run.
  for (const UncorrectableFault& one : {UncorrectableFault{"flat_on_pin", 2}, {"tightening_knots", 1}}) {
    const Answer found = answer({one.fault}, one.seed);
    EXPECT_FALSE(found.calibration.curve.used) << one.fault;
    EXPECT_EQ(found.calibration.curve.why.empty(),
              found.calibration.verdict != calibration::CalibrationVerdict::unexplained);
    EXPECT_EQ(found.correction.by_curve, 0) << one.fault;
    EXPECT_THAT(correction::compensation_csv(found.correction), StartsWith("theta_deg,alpha_up_deg,alpha_down_deg\n"));
  }
}

TEST(EmpiricalCurve, RejectsWaveFinerThanRows) {
  const Answer found = answer({"jumping_hub"}, 3);
  EXPECT_FALSE(found.calibration.curve.used);
  EXPECT_NE(found.calibration.curve.why, "");
}

TEST(EmpiricalCurve, IsEmptyWithoutDiscrepancy) {
  const Answer found = answer({"backlash"}, 1);
  EXPECT_EQ(found.calibration.curve.why, "");
  EXPECT_TRUE(found.calibration.curve.alpha.empty());
  EXPECT_THAT(correction::compensation_csv(found.correction), Not(HasSubstr("empirical")));
}

// Long: the figures of the empirical curve in docs/background/calibration-results.md.
TEST(EmpiricalCurve, PredictedGainHoldsOnRandomJoints) {
  if (std::getenv("FUSEE_LONG_TESTS") == nullptr) GTEST_SKIP() << "FUSEE_LONG_TESTS is not set";
  constexpr std::uint64_t joints = 4;
  for (const Protocol protocol : {Protocol::full, Protocol::random}) {
    std::vector<double> kept;
    std::size_t all = 0;
    for (const std::string& fault : names_in("tuning")) {
      for (std::uint64_t seed = 1; seed <= joints; ++seed) {
        const Answer found = answer({fault}, seed, protocol);
        ++all;
        if (!found.calibration.curve.used) continue;
        kept.push_back(error_on_new_runs(found).gain() / found.calibration.curve.gain);
        EXPECT_GT(kept.back(), 0.7) << fault << " " << seed;
      }
    }
    std::sort(kept.begin(), kept.end());
    ASSERT_FALSE(kept.empty());
    std::printf("%s protocol: %zu of %zu covered; gain on a new run / predicted gain: %.2f … %.2f, median %.2f\n",
                protocol == Protocol::full ? "full" : "random", kept.size(), all, kept.front(), kept.back(),
                kept[kept.size() / 2]);
  }
}

}  // namespace
}  // namespace fusee::rig
