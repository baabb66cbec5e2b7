// Results of calibrate() for data of its own model: every effect is found in data that contain it, and none in data
// without. Data of another model are in tests/rig.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "calibration/contract_effects.h"
#include "fusee/base.h"
#include "fusee/calibration.h"
#include "fusee/joint.h"
#include "fusee/mechanism_file.h"
#include "mechanism/effect.h"

namespace fusee::calibration {
namespace {

using testing::Contains;
using testing::IsEmpty;
using testing::Not;

constexpr double k_noise = radians(0.02);

DeclaredMechanism bench_joint() {
  const std::string folder = std::string(FUSEE_SOURCE_DIR) + "/tests/data/rig/a_declared_right/";
  return read_mechanism(folder + "spec.toml").mechanism;
}

struct Plan {
  double load = 0;   ///< N
  double speed = 1;  ///< times 30°/s
};

/// Sawtooth strokes over nearly the whole range, warming up by 10 K.
measurement::Run planned(const std::string& name, const Plan& plan, double alpha_most, double start) {
  measurement::Run run;
  run.name = name;
  run.has_time = run.has_load = run.has_temperature = true;
  run.mean_load = plan.load;
  run.speed = radians(30) * plan.speed;
  constexpr int strokes = 6;
  constexpr int rows = 60;
  double time = 0;
  for (int s = 0; s < strokes; ++s) {
    const double sign = s % 2 == 0 ? 1 : -1;
    run.strokes.push_back({run.samples.size(), run.samples.size() + rows - 1, s % 2 == 0 ? 1 : -1, s / 2, false});
    for (int i = 0; i < rows; ++i) {
      measurement::Sample sample;
      sample.time = time;
      sample.alpha = sign * alpha_most * (2.0 * i / (rows - 1) - 1.0);
      sample.load = plan.load;
      sample.temperature_C = 20 + 10 * (1 - std::exp(-(start + time) / 200));
      run.samples.push_back(sample);
      time += 2 * alpha_most / (rows - 1) / run.speed;
    }
  }
  return run;
}

/// Log by sensors with white noise of a joint that differs from its file by `at`.
measurement::Measurement logged(const DeclaredMechanism& declared, const Imperfections& at,
                                const std::vector<Plan>& plans, unsigned seed = 1) {
  measurement::Measurement measurement;
  measurement.load_unit = "N";
  for (std::size_t i = 0; i < plans.size(); ++i) {
    measurement.runs.push_back(
        planned("run_" + std::to_string(i + 1) + ".csv", plans[i], radians(100), 80.0 * static_cast<double>(i)));
  }
  const std::vector<std::vector<double>> theta = joint::predict(declared, at, measurement::bench_log(measurement));
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, k_noise);
  for (std::size_t i = 0; i < theta.size(); ++i) {
    for (std::size_t k = 0; k < theta[i].size(); ++k)
      measurement.runs[i].samples[k].theta = theta[i][k] + noise(random);
  }
  return measurement;
}

const std::vector<Plan> k_full = {{0, 1}, {3, 1}, {0, 8}, {1.5, 1}, {-3, 1}};

double rms_difference(const std::vector<std::vector<double>>& one, const std::vector<std::vector<double>>& other) {
  double squares = 0;
  double rows = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    for (std::size_t k = 0; k < one[i].size(); ++k) {
      squares += (one[i][k] - other[i][k]) * (one[i][k] - other[i][k]);
      rows += 1;
    }
  }
  return std::sqrt(squares / rows);
}

/// A size that moves θ by eight times the noise, rms. No number is near its bound, because effects at a bound are not
/// reported.
Imperfections well_seen(const DeclaredMechanism& declared, const fusee::Effect& effect) {
  constexpr double within = 0.8;
  const measurement::Measurement measurement = logged(declared, {}, k_full);
  const auto moved = [&](double size) {
    Imperfections at;
    double part = 1;
    for (const EffectParameter& parameter : effect.parameters) {
      if (parameter.searched) continue;
      set_value(at, parameter,
                std::clamp(part * size * parameter.step, within * parameter.least, within * parameter.most));
      part *= -0.6;
      if (parameter.least == 0) part = std::abs(part);
    }
    return at;
  };
  const joint::BenchLog log = measurement::bench_log(measurement);
  const joint::Readings as_declared = joint::predict(declared, {}, log);
  double size = 1;
  for (int i = 0; i < 60 && rms_difference(joint::predict(declared, moved(size), log), as_declared) < 8 * k_noise; ++i)
    size *= 1.25;
  return moved(size);
}

std::vector<std::string> all_groups(const Calibration& found) {
  std::vector<std::string> names;
  for (const FoundEffect& effect : found.effects) names.insert(names.end(), effect.group.begin(), effect.group.end());
  return names;
}

std::string why(const Calibration& found) {
  std::string words;
  for (const Candidate& candidate : found.tried) {
    words += candidate.name + " " + std::to_string(candidate.evidence) + ": " + candidate.why + "\n";
  }
  return words;
}

class EveryEffect : public testing::TestWithParam<std::string> {};

TEST_P(EveryEffect, IsIdentifiedInDataThatContainIt) {
  const DeclaredMechanism declared = bench_joint();
  const fusee::Effect* effect = find_effect(GetParam(), JointKind::tendons);
  ASSERT_NE(effect, nullptr);
  const Imperfections truth = well_seen(declared, *effect);
  const joint::BenchLog log = measurement::bench_log(logged(declared, {}, k_full));
  if (rms_difference(joint::predict(declared, truth, log), joint::predict(declared, {}, log)) < 3 * k_noise)
    GTEST_SKIP() << "however large, it hardly moves this joint";
  CalibrationOptions options;
  options.audit = false;  // it only adds members to groups
  const Calibration found = calibrate(declared, logged(declared, truth, k_full), options);
  EXPECT_THAT(found.verdict, testing::AnyOf(CalibrationVerdict::explained, CalibrationVerdict::confounded));
  // Known error: beside a drifting temperature, a friction far below the noise is reported too.
  ASSERT_LE(found.effects.size(), GetParam() == "thermal_expansion" ? 2u : 1u) << found.summary;
  if (found.effects.size() == 2) {
    EXPECT_LT(found.effects.back().rms_drop, 0.5 * k_noise) << found.summary;
  }
  EXPECT_THAT(all_groups(found), Contains(GetParam())) << found.summary << "\n" << why(found);
  EXPECT_LT(found.after.held_out_rms, 1.1 * k_noise);
}

// tendon_slip makes this joint loose, and the model does not predict where a loose joint rests: rig.known_truth tests
// it. groove_friction moves a joint with such stiff tendons by a tenth of the noise at most: a softer joint below tests
// it.
std::vector<std::string> seen_on_the_bench_joint() {
  std::vector<std::string> names(k_contract_effects.begin(), k_contract_effects.end());
  std::erase_if(names, [](const std::string& name) { return name == "tendon_slip" || name == "groove_friction"; });
  return names;
}

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryEffect, testing::ValuesIn(seen_on_the_bench_joint()),
                         [](const auto& one) { return one.param; });

TEST(Selection, FindsGrooveFrictionOfSoftTendon) {
  DeclaredMechanism declared = bench_joint();
  declared.tendon.modulus = 900;  // a nylon line
  Imperfections truth;
  truth.tendon.groove_friction = -0.2;  // no friction, while the file declares 0.2
  const std::vector<Plan> plans = {{0, 1}, {10, 1}, {0, 8}, {5, 1}, {-10, 1}};
  const measurement::Measurement measurement = logged(declared, truth, plans);
  const joint::BenchLog log = measurement::bench_log(measurement);
  EXPECT_GT(rms_difference(joint::predict(declared, truth, log), joint::predict(declared, {}, log)), 5 * k_noise);
  CalibrationOptions options;
  options.audit = false;
  const Calibration found = calibrate(declared, measurement, options);
  EXPECT_THAT(all_groups(found), Contains("groove_friction")) << found.summary << "\n" << why(found);
  EXPECT_NEAR(found.identified.tendon.groove_friction, -0.2, 0.03);
  const Calibration nothing = calibrate(declared, logged(declared, {}, plans), options);
  EXPECT_THAT(nothing.effects, IsEmpty()) << nothing.summary;
}

TEST(Selection, FindsNoEffectInNoise) {
  const DeclaredMechanism declared = bench_joint();
  for (const unsigned seed : {1u, 2u, 3u, 4u, 5u}) {
    const Calibration found = calibrate(declared, logged(declared, {}, k_full, seed));
    EXPECT_EQ(found.verdict, CalibrationVerdict::no_effect) << found.summary;
    EXPECT_THAT(found.effects, IsEmpty());
    for (const Detectable& detectable : found.detectable) EXPECT_GT(detectable.smallest, 0) << detectable.name;
  }
}

TEST(Selection, IdentifiesTwoEffectsWithTheirNumbers) {
  const DeclaredMechanism declared = bench_joint();
  Imperfections truth;
  truth.tendon.stretch = 2.0;
  truth.shaft.backlash = radians(1.5);
  const Calibration found = calibrate(declared, logged(declared, truth, k_full));
  // In runs of less than a minute, much creep acts like a little more stretch.
  EXPECT_THAT(found.verdict, testing::AnyOf(CalibrationVerdict::explained, CalibrationVerdict::confounded));
  ASSERT_EQ(found.effects.size(), 2u);
  EXPECT_NEAR(found.identified.tendon.stretch, 2.0, 0.05);
  EXPECT_NEAR(found.identified.shaft.backlash, radians(1.5), radians(0.03));
}

TEST(Selection, DistinguishesDelayFromPlayAtTwoSpeeds) {
  const DeclaredMechanism declared = bench_joint();
  Imperfections truth;
  truth.shaft.backlash = radians(2);
  const Calibration one_speed = calibrate(declared, logged(declared, truth, {{0, 1}}));
  EXPECT_EQ(one_speed.verdict, CalibrationVerdict::confounded);
  EXPECT_THAT(all_groups(one_speed), Contains("backlash"));
  EXPECT_THAT(one_speed.next, Not(IsEmpty()));
  EXPECT_THAT(one_speed.null_combinations, Not(IsEmpty()));
  const Calibration two_speeds = calibrate(declared, logged(declared, truth, {{0, 1}, {0, 0.2}, {3, 1}}));
  EXPECT_EQ(two_speeds.verdict, CalibrationVerdict::explained);
  EXPECT_THAT(all_groups(two_speeds), testing::ElementsAre("backlash"));
}

// An error that turns with a sensor is caused by the sensor. No caliper and no other run separates it as well.
TEST(Selection, AsksToTurnEccentricSensor) {
  const DeclaredMechanism declared = bench_joint();
  Imperfections truth;
  truth.motor.eccentricity_sin = radians(2);
  truth.motor.eccentricity_cos = radians(-1);
  const Calibration found = calibrate(declared, logged(declared, truth, {{0, 1}}));
  ASSERT_THAT(all_groups(found), Contains("motor_sensor_eccentricity"));
  ASSERT_GT(all_groups(found).size(), 1u);
  const auto turned = std::find_if(found.next.begin(), found.next.end(), [](const plan::NextMeasurement& next) {
    return next.run && next.run->change == plan::BenchChange::motor_sensor_turned;
  });
  ASSERT_NE(turned, found.next.end());
  EXPECT_EQ(turned->kind(), "turn_sensor");
  EXPECT_THAT(turned->separates, Contains("motor_sensor_eccentricity"));
  EXPECT_GT(turned->separates.size(), 1u);
}

TEST(Selection, AsksForNoRunThatWasMeasured) {
  const DeclaredMechanism declared = bench_joint();
  Imperfections truth;
  truth.shaft.backlash = radians(2);
  const Calibration found = calibrate(declared, logged(declared, truth, {{0, 1}}));
  ASSERT_FALSE(found.next.empty());
  for (const plan::NextMeasurement& next : found.next) {
    const bool is_measured = next.run && next.run->load == 0 && next.run->change == plan::BenchChange::none &&
                             next.run->dwell == 0 && std::abs(next.run->speed - radians(30)) < radians(3);
    EXPECT_FALSE(is_measured) << next.words;
  }
}

TEST(Selection, CaliperReadingSplitsGroup) {
  DeclaredMechanism declared = bench_joint();
  Imperfections truth;
  truth.pulley.scale = -0.02;
  const measurement::Measurement measurement = logged(declared, truth, {{0, 1}});
  const Calibration without = calibrate(declared, measurement);
  ASSERT_THAT(all_groups(without), Contains("pulley_scale"));
  ASSERT_THAT(all_groups(without), Contains("radius_offset"));
  declared.prior.radius_offset = {0.0, 0.005};
  const Calibration with = calibrate(declared, measurement);
  EXPECT_THAT(all_groups(with), Contains("pulley_scale"));
  EXPECT_THAT(all_groups(with), Not(Contains("radius_offset")));
}

// Only an unmodelled path of the tendons changes the moment arms of a load. Without this alternative, displaced pins
// led by 57 nats.
TEST(Selection, UnmodelledGeometryIsNoCertainEffect) {
  const DeclaredMechanism declared = bench_joint();
  Imperfections truth;
  truth.joint.path1 = {0.0, 4.0, 4.0};
  const Calibration found = calibrate(declared, logged(declared, truth, {{0, 1}, {12, 1}, {0, 8}, {-12, 1}}));
  ASSERT_FALSE(found.effects.empty());
  EXPECT_THAT(found.effects.front().group, testing::AllOf(Contains("guide_position"), Contains("unmodelled")));
  EXPECT_THAT(found.effects.front().unmodelled.words, testing::HasSubstr("tendons' paths"));
}

// This friction acts like that of a bearing, which led every empirical curve by 220 nats.
TEST(Selection, UnmodelledFrictionIsNoCertainEffect) {
  const DeclaredMechanism declared = bench_joint();
  Imperfections truth;
  truth.joint.rubbing.by_area = 250;
  const Calibration found = calibrate(declared, logged(declared, truth, {{0, 1}, {8, 1}, {0, 8}, {-8, 1}}));
  ASSERT_FALSE(found.effects.empty());
  EXPECT_THAT(found.effects.front().group, Contains("unmodelled")) << why(found);
  EXPECT_THAT(found.effects.front().unmodelled.words, testing::HasSubstr("a friction that is not proportional"));

  truth = {};
  truth.joint.friction = 250;
  const Calibration named = calibrate(declared, logged(declared, truth, {{0, 1}, {8, 1}, {0, 8}, {-8, 1}}));
  ASSERT_EQ(named.effects.size(), 1u) << why(named);
  EXPECT_THAT(named.effects.front().group, testing::ElementsAre("joint_friction"));
}

TEST(Selection, WalkingZeroIsNoEffect) {
  const DeclaredMechanism declared = bench_joint();
  measurement::Measurement measurement = logged(declared, {}, k_full);
  std::mt19937 random(3);
  std::normal_distribution<double> step(0.0, 8 * k_noise);
  for (fusee::measurement::Run& run : measurement.runs) {
    for (const measurement::Stroke& stroke : run.strokes) {
      const double off = step(random);
      for (std::size_t k = stroke.first; k <= stroke.last; ++k) run.samples[k].theta += off;
    }
  }
  const Calibration found = calibrate(declared, measurement);
  EXPECT_EQ(found.verdict, CalibrationVerdict::not_repeatable) << found.summary;
  EXPECT_THAT(found.effects, IsEmpty());
}

TEST(Selection, FitsNoHeldOutRuns) {
  const DeclaredMechanism declared = bench_joint();
  Imperfections truth;
  truth.shaft.backlash = radians(2);
  measurement::Measurement measurement = logged(declared, truth, k_full);
  CalibrationOptions options;
  options.hold_out = {"run_5.csv"};
  const Calibration found = calibrate(declared, measurement, options);
  EXPECT_THAT(found.held_out_runs, testing::ElementsAre("run_5.csv"));
  EXPECT_LT(found.after.held_out_rms, 1.2 * k_noise);
  // The held-out run does not change the result.
  for (measurement::Sample& sample : measurement.runs.back().samples) sample.theta += radians(3);
  const Calibration other = calibrate(declared, measurement, options);
  EXPECT_EQ(other.identified.shaft.backlash, found.identified.shaft.backlash);
  EXPECT_GT(other.after.held_out_rms, radians(2.9));
}

}  // namespace
}  // namespace fusee::calibration
