// Segments of logs with dwells and with loads that change within a run.
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <random>

#include "base/text.h"
#include "fusee/measurement.h"
#include "support/mechanisms.h"

namespace fusee::measurement {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

struct Row {
  double alpha = 0;  ///< deg
  double load = 0;   ///< N
};

/// `rows` rows at each angle, and `between` on the way to the next one.
std::vector<Row> dwells_at(const std::vector<double>& angles, int rows, int between = 0, double load = 0) {
  std::vector<Row> log;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    log.insert(log.end(), static_cast<std::size_t>(rows), {angles[i], load});
    for (int k = 1; k <= between && i + 1 < angles.size(); ++k)
      log.push_back({angles[i] + (angles[i + 1] - angles[i]) * k / (between + 1), load});
  }
  return log;
}

/// θ is a quarter of α minus 0.05° per newton, up to `stop`; both sensors scatter.
Measurement read(const std::vector<Row>& log, double noise = 0.01, double alpha_quantum = 0, bool has_load = true,
                 double stop = 90) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::string text = has_load ? "time_s,alpha_deg,theta_deg,load_N\n" : "time_s,alpha_deg,theta_deg\n";
  for (std::size_t i = 0; i < log.size(); ++i) {
    double alpha = log[i].alpha + noise * normal(random);
    if (alpha_quantum > 0) alpha = alpha_quantum * std::round(alpha / alpha_quantum);
    text += shortest(0.1 * static_cast<double>(i)) + "," + shortest(alpha) + "," +
            shortest(std::min(stop, 0.25 * log[i].alpha - 0.05 * log[i].load) + noise * normal(random)) +
            (has_load ? "," + shortest(log[i].load) : "") + "\n";
  }
  Measurement measurement;
  measurement.runs.push_back(parse_run(text, "run.csv", {}, measurement));
  return measurement;
}

std::string reasons_of(const Measurement& measurement) {
  std::string all;
  for (const std::string& reason : measurement.not_testable) all += reason + "\n";
  return all;
}

/// Dwells as sign of approach and angle, "·" for a segment in motion: "--40" is −40° approached downwards. The sign of
/// the first dwell is the direction of its stroke.
std::string dwells_of(const fusee::measurement::Run& run) {
  std::string dwells;
  for (const Segment& segment : run.segments) {
    const int direction = run.strokes[segment.stroke].direction;
    const std::string sign = direction > 0 ? "+" : direction < 0 ? "-" : "";
    const double alpha = degrees(run.samples[(segment.first + segment.last) / 2].alpha);
    dwells += (dwells.empty() ? "" : " ") + (segment.is_dwell ? sign + rounded(std::round(alpha)) : std::string("·"));
  }
  return dwells;
}

std::vector<double> triangle(double size, int per_stroke, int strokes) {
  std::vector<double> alphas;
  for (int i = 0; i <= per_stroke * strokes; ++i) {
    const double rising = -size + 2 * size * (i % per_stroke) / per_stroke;
    alphas.push_back(i / per_stroke % 2 == 0 ? rising : -rising);
  }
  return alphas;
}

// ---- dwells ---------------------------------------------------------------------------------------------------------

TEST(Segments, RecordDirectionOfApproach) {
  for (const double noise : {0.0, 0.01, 0.05}) {
    for (const int between : {0, 2}) {
      const Measurement m = read(dwells_at({-40, 0, 40, 10, -40, 0, 40, 10, -40}, 12, between), noise);
      EXPECT_EQ(reasons_of(m), "") << noise << " " << between;
      const std::string dwells = dwells_of(m.runs[0]);
      EXPECT_EQ(dwells, between == 0 ? "+-40 +0 +40 -10 --40 +0 +40 -10 --40"
                                     : "+-40 · +0 · +40 · -10 · --40 · +0 · +40 · -10 · --40")
          << noise;
    }
  }
}

TEST(Segments, StrokesBetweenEndsAreSingleDwells) {
  const Measurement m = read(dwells_at({-40, 40, -40, 40, -40, 40}, 20));
  EXPECT_EQ(reasons_of(m), "");
  EXPECT_EQ(dwells_of(m.runs[0]), "+-40 +40 --40 +40 --40 +40");
  EXPECT_EQ(m.runs[0].speed, 0);
  EXPECT_EQ(m.alpha_quantum, 0) << "dwell angles are not sensor steps";
  EXPECT_THAT(m.notes, ElementsAre(HasSubstr("alpha is held 6 times")));
}

/// Three rows at each end look like jitter, and the joint, which stops early, does not follow.
TEST(Segments, JointMayStopEarly) {
  const std::vector<double> ends = {-95, 94, -72, 70, -48, 46, -24, 23};
  const Measurement stopped = read(dwells_at(ends, 3), 0.002, 0, true, -10);
  EXPECT_THAT(reasons_of(stopped), IsEmpty());
  EXPECT_EQ(dwells_of(stopped.runs.front()), "+-95 +94 --72 +70 --48 +46 --24 +23");
}

TEST(Segments, OneRowAtEachEndIsMotion) {
  std::vector<double> ends;
  for (int i = 0; i < 30; ++i) ends.push_back(i % 2 == 0 ? -40.0 : 40.0);
  const Measurement m = read(dwells_at(ends, 1));
  EXPECT_EQ(reasons_of(m), "");
  EXPECT_THAT(m.runs[0].segments, SizeIs(30));
}

TEST(Segments, LargeStepIsNotUnwrapped) {
  const Measurement m = read(dwells_at({-150, 150, -150, 150}, 10));
  EXPECT_EQ(dwells_of(m.runs[0]), "+-150 +150 --150 +150");
}

TEST(Segments, FlickeringSensorIsDwell) {
  const Measurement m = read(dwells_at({-40, 0, 40, 0, -40, 0, 40}, 30), 0.05, 0.1);
  EXPECT_EQ(dwells_of(m.runs[0]), "+-40 +0 +40 -0 --40 +0 +40");
  EXPECT_NEAR(degrees(m.alpha_quantum), 0.1, 1e-6);
}

// In a sweep, slow or coarse, with dwells or round ends, each stroke is one segment.
TEST(Segments, SweepHasWholeStrokes) {
  std::vector<double> sine, dwells;
  for (int i = 0; i < 1200; ++i) sine.push_back(40 * std::sin(k_two_pi * i / 300.0));
  for (const double alpha : triangle(40, 100, 6)) dwells.insert(dwells.end(), std::abs(alpha) == 40 ? 30 : 1, alpha);
  for (const auto& alphas : {triangle(40, 30, 6), triangle(40, 2000, 4), sine, dwells}) {
    for (const double quantum : {0.0, 0.1, 1.0}) {
      std::vector<Row> log;
      for (const double alpha : alphas) log.push_back({alpha, 0});
      const Measurement m = read(log, 0.01, quantum, false);
      EXPECT_FALSE(is_from_point_to_point(m.runs[0])) << alphas.size() << " " << quantum;
      EXPECT_EQ(m.runs[0].segments.size(), m.runs[0].strokes.size());
    }
  }
}

// ---- loads ----------------------------------------------------------------------------------------------------------

TEST(Segments, SeparateLoadingAndUnloading) {
  std::vector<Row> log;
  for (const double alpha : {-40.0, 0.0, 40.0, 0.0, -40.0}) {
    for (const double load : {0.0, 5.0, 10.0, 5.0, 0.0}) log.insert(log.end(), 8, {alpha, load});
  }
  const Measurement m = read(log);
  EXPECT_EQ(reasons_of(m), "");
  ASSERT_THAT(m.runs[0].segments, SizeIs(25));  // five loads at five angles
  std::vector<int> pulls;
  for (std::size_t i = 5; i < 10; ++i) pulls.push_back(m.runs[0].segments[i].pull);
  EXPECT_THAT(pulls, ElementsAre(0, 1, 1, -1, -1));
}

TEST(Segments, ConstantMotorIsOneStroke) {
  std::vector<Row> log;
  for (const double load : {0.0, 5.0, 10.0, 5.0, 0.0}) log.insert(log.end(), 10, {20.0, load});
  for (const double noise : {0.0, 0.01}) {
    const Measurement m = read(log, noise);
    EXPECT_EQ(reasons_of(m), "") << noise;
    EXPECT_THAT(m.runs[0].segments, SizeIs(5));
    ASSERT_THAT(m.runs[0].strokes, SizeIs(1));
    EXPECT_EQ(m.runs[0].strokes[0].direction, 0);
  }
}

TEST(Segments, LoadLevelsCutStroke) {
  // Loads applied in the middle of strokes, at different places each time.
  std::vector<Row> stepped, ramped, by_spring;
  const std::vector<double> alphas = triangle(40, 60, 6);
  for (std::size_t i = 0; i < alphas.size(); ++i) {
    stepped.push_back({alphas[i], static_cast<double>(i / 47 % 3) * 5});
    ramped.push_back({alphas[i], 15.0 * static_cast<double>(i) / static_cast<double>(alphas.size())});
    by_spring.push_back({alphas[i], 5 + 0.1 * alphas[i]});
  }
  const fusee::measurement::Run run = read(stepped).runs[0];
  EXPECT_EQ(run.strokes.size(), 6u);
  EXPECT_GT(run.segments.size(), 9u);
  for (const Segment& segment : run.segments) {
    double least = 1e9, most = -1e9;
    for (std::size_t i = segment.first; i <= segment.last; ++i) {
      least = std::min(least, run.samples[i].load);
      most = std::max(most, run.samples[i].load);
    }
    if (segment.last - segment.first < 12) continue;  // too short to be divided at the step in it
    EXPECT_LT(most - least, 1) << segment.first;
  }
  EXPECT_EQ(read(by_spring).runs[0].segments.size(), 6u) << "a spring's load is a function of place";
  EXPECT_EQ(read(ramped).runs[0].segments.size(), 6u) << "it hardly changes within a stroke";
  std::vector<Row> waves;
  for (std::size_t i = 0; i < alphas.size(); ++i)
    waves.push_back({alphas[i], 5 + 5 * std::sin(0.05 * static_cast<double>(i))});
  EXPECT_GT(read(waves).runs[0].segments.size(), 12u);
}

}  // namespace
}  // namespace fusee::measurement
