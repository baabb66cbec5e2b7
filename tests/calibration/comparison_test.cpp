// Two states of one joint: changes in either direction are reported, and none if the states are equal.
#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "calibration/changes.h"
#include "fusee/calibration.h"
#include "fusee/joint.h"
#include "support/mechanisms.h"

namespace fusee::calibration {
namespace {

constexpr double k_noise = radians(0.01);

DeclaredMechanism geared(double ratio = 4) {
  DeclaredMechanism joint;
  joint.transmission = RatioTransmission{ratio};
  return joint;
}

/// Strokes there and back between two angles of the motor, at two loads.
measurement::Measurement strokes(const std::string& name, double from = radians(-40), double to = radians(40)) {
  constexpr int k_rows = 60;
  measurement::Measurement measurement;
  measurement.load_unit = "N";
  for (int r = 0; r < 2; ++r) {
    fusee::measurement::Run run;
    run.name = name + "_" + std::to_string(r + 1) + ".csv";
    run.has_load = true;
    run.mean_load = 4.0 * r;
    for (int stroke = 0; stroke < 6; ++stroke) {
      const bool up = stroke % 2 == 0;
      const std::size_t first = run.samples.size();
      for (int i = 0; i < k_rows; ++i) {
        const double share = static_cast<double>(i) / (k_rows - 1);
        measurement::Sample sample;
        sample.alpha = from + (to - from) * (up ? share : 1 - share);
        sample.load = run.mean_load;
        run.samples.push_back(sample);
      }
      run.strokes.push_back({first, run.samples.size() - 1, up ? 1 : -1, stroke / 2, false});
    }
    measurement.runs.push_back(run);
  }
  return measurement;
}

/// θ of a joint in a state, plus an unmodelled bump that both states have.
measurement::Measurement measured(const DeclaredMechanism& declared, measurement::Measurement measurement,
                                  const Imperfections& state, unsigned seed) {
  const joint::Readings theta = joint::predict(declared, state, measurement::bench_log(measurement));
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, k_noise);
  for (std::size_t r = 0; r < theta.size(); ++r) {
    for (std::size_t i = 0; i < theta[r].size(); ++i) {
      measurement::Sample& sample = measurement.runs[r].samples[i];
      sample.theta = theta[r][i] + radians(0.3) * std::exp(-std::pow(sample.alpha / radians(8), 2)) + noise(random);
    }
  }
  return measurement;
}

ComparedRuns both_of(measurement::Measurement before, measurement::Measurement after) {
  ComparedRuns runs{before, after, before};
  runs.both.runs.insert(runs.both.runs.end(), after.runs.begin(), after.runs.end());
  return runs;
}

ComparedRuns two_states(const Imperfections& before, const Imperfections& after) {
  return both_of(measured(geared(), strokes("before"), before, 1), measured(geared(), strokes("after"), after, 2));
}

Imperfections with_play(double width) {
  Imperfections joint;
  joint.shaft.backlash = width;
  return joint;
}

const StateChange* find_change(const Comparison& comparison, const std::string& name) {
  for (const StateChange& change : comparison.found) {
    if (std::find(change.group.begin(), change.group.end(), name) != change.group.end()) return &change;
  }
  return nullptr;
}

TEST(EarlierState, ActsInItsOwnRunsAlone) {
  const DeclaredMechanism declared = testing::forearm();
  const joint::BenchLog log = measurement::bench_log(both_of(strokes("before"), strokes("after")).both);
  Imperfections before, change, sum;
  before.shaft.backlash = radians(2);
  before.tendon.stretch = 0.5;
  change.shaft.backlash = radians(-0.5);
  change.sensor.zero = 0.01;
  sum.shaft.backlash = radians(1.5);
  sum.tendon.stretch = 0.5;
  sum.sensor.zero = 0.01;
  const joint::Readings shown = joint::predict(declared, change, log, joint::EarlierState{before, 2});
  const joint::Readings first = joint::predict(declared, before, log), second = joint::predict(declared, sum, log);
  for (std::size_t run = 0; run < log.size(); ++run) {
    for (std::size_t row = 0; row < log[run].rows.size(); ++row)
      ASSERT_NEAR(shown[run][row], (run < 2 ? first : second)[run][row], 1e-7) << run << " " << row;
  }
}

TEST(Changes, MayRemoveEarlierEffect) {
  const std::vector<fusee::Effect> changes = changes_from(with_play(radians(2)), JointKind::ratio);
  const auto play =
      std::find_if(changes.begin(), changes.end(), [](const fusee::Effect& e) { return e.name == "backlash"; });
  ASSERT_NE(play, changes.end());
  EXPECT_DOUBLE_EQ(play->parameters.front().least, -radians(2));
  EXPECT_THAT(play->starts, ::testing::Contains(std::vector<double>{radians(-1.5)}));
  EXPECT_THAT(play->starts, ::testing::Not(::testing::Contains(std::vector<double>{radians(-5)})));
}

TEST(Comparison, ReportsNoChangeWithinOneState) {
  const Comparison comparison = compare_states(geared(), two_states(with_play(radians(2)), with_play(radians(2))));
  EXPECT_EQ(comparison.verdict, ComparisonVerdict::no_change);
  EXPECT_TRUE(comparison.found.empty());
  EXPECT_LT(comparison.difference.before, 3 * k_noise);
}

/// Adds a random gain and a random play to each run.
measurement::Measurement unrepeated(measurement::Measurement measurement, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> gain(0.0, 0.01), half_play(0.0, radians(0.05));
  for (fusee::measurement::Run& run : measurement.runs) {
    const double by_place = gain(random), by_direction = half_play(random);
    for (const measurement::Stroke& stroke : run.strokes) {
      for (std::size_t i = stroke.first; i <= stroke.last; ++i)
        run.samples[i].theta += by_place * run.samples[i].alpha / 4 + by_direction * stroke.direction;
    }
  }
  return measurement;
}

TEST(Comparison, IgnoresChangesThatRunsDoNotRepeat) {
  for (const unsigned seed : {1u, 4u, 6u}) {
    const ComparedRuns same = two_states(with_play(radians(2)), with_play(radians(2)));
    const ComparedRuns runs = both_of(unrepeated(same.before, seed), unrepeated(same.after, 100 + seed));
    EXPECT_EQ(compare_states(geared(), runs).verdict, ComparisonVerdict::no_change) << seed;
  }
}

TEST(Comparison, FindsPlayThatGrewAndShrank) {
  for (const auto& [before, after] : {std::pair{2.0, 3.0}, std::pair{3.0, 2.0}}) {
    const Comparison comparison =
        compare_states(geared(), two_states(with_play(radians(before)), with_play(radians(after))));
    EXPECT_EQ(comparison.verdict, ComparisonVerdict::changed);
    const StateChange* play = find_change(comparison, "backlash");
    ASSERT_NE(play, nullptr) << before;
    ASSERT_EQ(play->name, "backlash");
    EXPECT_NEAR(play->parameters.front().change(), after - before, 0.1);
    EXPECT_NEAR(play->parameters.front().before, before, 0.2);
    EXPECT_LT(play->parameters.front().low, after - before);
    EXPECT_GT(play->parameters.front().high, after - before);
    EXPECT_LT(comparison.difference.after, 0.5 * comparison.difference.before);
    EXPECT_GT(play->by_runs, 20);
  }
}

TEST(Comparison, KeepsUncertaintyOfPlayThatIsGone) {
  ComparedRuns runs = two_states(with_play(radians(2)), {});
  for (measurement::Measurement* measurement : {&runs.before, &runs.after, &runs.both}) {
    for (fusee::measurement::Run& run : measurement->runs)
      run.has_load = false;  // with a load, slack would be equally likely
  }
  const Comparison comparison = compare_states(geared(), runs);
  const StateChange* play = find_change(comparison, "backlash");
  ASSERT_NE(play, nullptr);
  ASSERT_EQ(play->name, "backlash");
  const ChangedParameter& width = play->parameters.front();
  EXPECT_NEAR(width.after, 0, 0.02);
  EXPECT_NEAR(width.change(), -2, 0.1);
  EXPECT_LT(width.high, -1.8);
  EXPECT_GT(width.low, -2.2);
  // The only change removes what the difference loses.
  const StateDifference& difference = comparison.difference;
  EXPECT_NEAR(play->share, 1 - std::pow(difference.after / difference.before, 2), 0.01);
  EXPECT_GT(play->share, 0.95);
}

TEST(Comparison, FindsMovedZeroOfJointDeclaredByRatio) {
  // The second offset exceeds half of the joint's motion, but the joint is still the same one.
  for (const double offset : {0.5, 12.0}) {
    Imperfections moved;
    moved.sensor.zero = radians(offset);
    const Comparison comparison = compare_states(geared(), two_states({}, moved));
    EXPECT_EQ(comparison.verdict, ComparisonVerdict::changed);
    const StateChange* zero = find_change(comparison, "zero_offset");
    ASSERT_NE(zero, nullptr);
    ASSERT_EQ(zero->name, "zero_offset");
    EXPECT_NEAR(zero->parameters.front().change(), offset, 0.05);
  }
}

TEST(Comparison, RefusesRunsOfAnotherJoint) {
  ComparedRuns runs =
      both_of(measured(geared(), strokes("before"), {}, 1), measured(geared(2), strokes("after"), {}, 2));
  const Comparison comparison = compare_states(geared(), runs);
  EXPECT_EQ(comparison.verdict, ComparisonVerdict::not_comparable);
  EXPECT_THAT(comparison.why, ::testing::HasSubstr("no two states of one joint"));
}

TEST(Comparison, RefusesRunsWithoutCommonPlace) {
  const measurement::Measurement before = measured(geared(), strokes("before", radians(-40), radians(-5)), {}, 1);
  const measurement::Measurement after = measured(geared(), strokes("after", radians(5), radians(40)), {}, 2);
  const Comparison comparison = compare_states(geared(), both_of(before, after));
  EXPECT_EQ(comparison.verdict, ComparisonVerdict::not_comparable);
  EXPECT_THAT(comparison.why, ::testing::HasSubstr("these ranges hardly overlap"));
}

TEST(Comparison, RefusesLoadsInTwoUnits) {
  ComparedRuns runs = two_states({}, {});
  runs.after.load_unit = "Nm";
  const Comparison comparison = compare_states(geared(), runs);
  EXPECT_EQ(comparison.verdict, ComparisonVerdict::not_comparable);
  EXPECT_THAT(comparison.why, ::testing::HasSubstr("The load is in N before and in Nm after"));
}

}  // namespace
}  // namespace fusee::calibration
