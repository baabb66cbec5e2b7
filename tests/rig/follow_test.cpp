// The next measurements, made on the rig.
#include "rig/follow.h"

#include <gmock/gmock.h>

#include "fusee/mechanism/fields.h"
#include "rig/judge.h"
#include "rig/test_joints.h"

namespace fusee::rig {
namespace {

Case case_of(const Hidden& hidden) {
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

TEST(Follow, ReadsByHandWhatIsHidden) {
  Hidden hidden;
  hidden.guide_radius = 0.7;
  hidden.pulley_scale = -0.02;
  hidden.radius_offset = 0.3;
  hidden.backlash = 0.03;
  hidden.pin_down[1] = 1.5;
  hidden.gain = 0.04;
  hidden.zero = -0.02;
  Case made = case_of({});
  hidden.modulus = made.joint.declared.tendon.modulus / 3.0;
  made.hidden = hidden;
  EXPECT_NEAR(read_by_hand(number("guide_radius"), made), 0.7, 1e-12);
  EXPECT_NEAR(read_by_hand(number("pulley_scale"), made), -0.02, 1e-12);
  EXPECT_NEAR(read_by_hand(number("radius_offset"), made), 0.3, 1e-12);
  EXPECT_NEAR(read_by_hand(number("backlash"), made), 0.03, 1e-12);
  EXPECT_NEAR(read_by_hand(number("guide_position", 3), made), 1.5, 1e-12);
  EXPECT_NEAR(read_by_hand(number("joint_sensor_gain"), made), 0.04, 1e-12);
  EXPECT_NEAR(read_by_hand(number("zero_offset"), made), -0.02, 1e-12);
  EXPECT_NEAR(read_by_hand(number("tendon_stretch"), made), 2.0, 1e-12);
}

// A protractor sees the sensor's waves too.
TEST(Follow, ProtractorReadsAllThatTheSensorShowsTooMuch) {
  Hidden hidden;
  hidden.joint_eccentricity = 0.05;
  hidden.joint_eccentricity_phase = 0.4;
  const Case made = case_of(hidden);
  Imperfections same;
  same.sensor.eccentricity_sin = 0.05 * std::cos(0.4);
  same.sensor.eccentricity_cos = 0.05 * std::sin(0.4);
  const double read = read_by_hand(number("joint_sensor_gain"), made);
  EXPECT_GT(std::abs(read), 0.01);
  EXPECT_NEAR(reading_by_hand(number("joint_sensor_gain"), same, made.joint.declared), read, 1e-12);
}

TEST(Follow, WritesReadingsIntoTheFile) {
  for (const EffectParameter* asked : unread_numbers(soft().declared)) {
    Case made = case_of({});
    ASSERT_TRUE(perform(next_reading({asked}), made)) << asked->by_hand.key;
    const std::vector<CaliperReading> readings = asked->by_hand.readings(made.joint.declared);
    ASSERT_FALSE(readings.empty()) << asked->by_hand.key;
    EXPECT_NEAR(readings.back().value, 0, 4 * asked->by_hand.uncertainty) << asked->by_hand.key;
    EXPECT_NE(readings.back().value, 0) << asked->by_hand.key;
    EXPECT_NEAR(readings.back().uncertainty, asked->by_hand.uncertainty, 0.5 * asked->by_hand.uncertainty);
  }
}

TEST(Follow, DrivesRunsAfterThoseThatWereMade) {
  Hidden hidden;
  hidden.joint_eccentricity = 0.02;
  Case made = case_of(hidden);
  const Log first = made.logs.front();
  PlannedRun run{.from = first.front().alpha, .to = -first.front().alpha, .cycles = 1, .speed = radians(30.0)};
  run.change = BenchChange::joint_sensor_turned;
  ASSERT_TRUE(perform(next_run(run, run.speed, "N"), made));
  ASSERT_EQ(made.logs.size(), 2u);
  EXPECT_EQ(made.logs[0].back().theta, first.back().theta);
  EXPECT_GT(made.logs[1].front().time, first.back().time);
  double apart = 0;
  for (std::size_t k = 0; k < first.size(); ++k)
    apart = std::max(apart, std::abs(made.logs[1][k].theta - first[k].theta));
  EXPECT_GT(apart, 0.003) << "the sensor was not turned";
  EXPECT_THAT(csv_text(made.logs[1], false, made.plans[1]), ::testing::HasSubstr("load_N,joint_sensor_turned_deg\n"));
}

TEST(Follow, DoesNothingThatItCannotMake) {
  Case made = case_of({});
  EXPECT_FALSE(perform(next_inspection("mark the tendon"), made));
  EXPECT_EQ(made.plans.size(), 1u);
}

}  // namespace
}  // namespace fusee::rig
