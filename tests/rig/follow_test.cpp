// Further measurements on the rig.
#include <gmock/gmock.h>

#include "fusee/mechanism_file.h"
#include "mechanism/effect.h"
#include "rig/judge.h"
#include "rig/test_joints.h"
#include "rig/truths.h"

namespace fusee::rig {
namespace {

Case case_of(const HiddenFaults& hidden) {
  Case made;
  made.joint = soft();
  made.hidden = hidden;
  made.plans = {{0.0, radians(30.0), 1}};
  made.sensors.noise = 0;
  made.logs = log_runs(made.joint, made.hidden, made.plans, made.sensors, made.motion);
  return made;
}

const EffectParameter& number(const std::string& effect, std::size_t i = 0) {
  return find_effect(effect, JointKind::tendons)->parameters[i];
}

TEST(Follow, ManualReadingEqualsHiddenValue) {
  Case made = case_of({});
  made.hidden = {.radius_offset = 0.3, .pulley_scale = -0.02, .modulus = made.joint.declared.tendon.modulus / 3.0};
  made.hidden.backlash = 0.03, made.hidden.guide_radius = 0.7, made.hidden.pin_down[1] = 1.5;
  made.hidden.zero = -0.02, made.hidden.gain = 0.04;
  const std::pair<const EffectParameter*, double> expected[] = {
      {&number("guide_radius"), 0.7},  {&number("pulley_scale"), -0.02},    {&number("radius_offset"), 0.3},
      {&number("backlash"), 0.03},     {&number("guide_position", 3), 1.5}, {&number("joint_sensor_gain"), 0.04},
      {&number("zero_offset"), -0.02}, {&number("tendon_stretch"), 2.0},
  };
  for (const auto& [parameter, value] : expected)
    EXPECT_NEAR(read_by_hand(*parameter, made), value, 1e-12) << parameter->name;
}

TEST(Follow, ProtractorReadingIncludesSensorWaves) {
  const Case made = case_of({.joint_eccentricity = 0.05, .joint_eccentricity_phase = 0.4});
  Imperfections same;
  same.sensor.eccentricity_sin = 0.05 * std::cos(0.4);
  same.sensor.eccentricity_cos = 0.05 * std::sin(0.4);
  const double read = read_by_hand(number("joint_sensor_gain"), made);
  EXPECT_GT(std::abs(read), 0.01);
  EXPECT_NEAR(reading_by_hand(number("joint_sensor_gain"), same, made.joint.declared), read, 1e-12);
}

TEST(Follow, WritesReadingsIntoTheFile) {
  for (const EffectParameter* asked : plan::unread_numbers(soft().declared)) {
    Case made = case_of({});
    ASSERT_TRUE(perform(plan::next_reading({asked}), made)) << asked->by_hand.key;
    const std::vector<ManualReading> readings = asked->by_hand.readings(made.joint.declared);
    ASSERT_FALSE(readings.empty()) << asked->by_hand.key;
    EXPECT_NEAR(readings.back().value, 0, 4 * asked->by_hand.uncertainty) << asked->by_hand.key;
    EXPECT_NE(readings.back().value, 0) << asked->by_hand.key;
    EXPECT_NEAR(readings.back().uncertainty, asked->by_hand.uncertainty, 0.5 * asked->by_hand.uncertainty);
  }
}

TEST(Follow, DrivesRunsAfterThoseThatWereMade) {
  Case made = case_of({.joint_eccentricity = 0.02});
  const Log first = made.logs.front();
  plan::PlannedRun run{.from = first.front().alpha, .to = -first.front().alpha, .cycles = 1, .speed = radians(30.0)};
  run.change = plan::BenchChange::joint_sensor_turned;
  ASSERT_TRUE(perform(plan::next_run(run, run.speed, "N"), made));
  ASSERT_EQ(made.logs.size(), 2u);
  EXPECT_EQ(made.logs[0].back().theta, first.back().theta);
  EXPECT_GT(made.logs[1].front().time, first.back().time);
  double difference = 0;
  for (std::size_t k = 0; k < first.size(); ++k)
    difference = std::max(difference, std::abs(made.logs[1][k].theta - first[k].theta));
  EXPECT_GT(difference, 0.003) << "the sensor was not turned";
  EXPECT_THAT(csv_text(made.logs[1], false, made.plans[1]), ::testing::HasSubstr("load_N,joint_sensor_turned_deg\n"));
}

TEST(Follow, RejectsInspections) {
  Case made = case_of({});
  EXPECT_FALSE(perform(plan::next_inspection("mark the tendon"), made));
  EXPECT_EQ(made.plans.size(), 1u);
}

}  // namespace
}  // namespace fusee::rig
