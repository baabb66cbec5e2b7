// Bench runs as rows, and the next measurements.
#include <gmock/gmock.h>

#include <cmath>

#include "fusee/mechanism_file.h"
#include "fusee/plan.h"
#include "joint/sensors.h"
#include "mechanism/effect.h"
#include "support/mechanisms.h"

namespace fusee::plan {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// Strokes of 3.5 rad.
constexpr PlannedRun k_run{.from = -1.5, .to = 2.0, .cycles = 3, .speed = 0.25, .load = 5};

TEST(PlannedRun, DurationFollowsStrokes) {
  EXPECT_DOUBLE_EQ(minutes_of(k_run), 3 * 2 * (3.5 / 0.25) / 60);
  PlannedRun with_dwells = k_run;
  with_dwells.dwell = 30;
  EXPECT_DOUBLE_EQ(minutes_of(with_dwells), minutes_of(k_run) + 3 * 2 * 30 / 60.0);
}

TEST(PlannedRun, RowsCoverStrokesInTheirTime) {
  for (const double dwell : {0.0, 30.0}) {
    PlannedRun run = k_run;
    run.dwell = dwell;
    const joint::BenchRun rows = driven(run, 20);
    EXPECT_DOUBLE_EQ(rows.rows.front().alpha, run.from);
    EXPECT_DOUBLE_EQ(rows.rows.back().alpha, run.from);
    EXPECT_NEAR(rows.rows.back().time, 60 * minutes_of(run), 1e-9);
    double path = 0;  // rad
    for (std::size_t i = 1; i < rows.rows.size(); ++i) {
      const double step = std::abs(rows.rows[i].alpha - rows.rows[i - 1].alpha);
      const double time = rows.rows[i].time - rows.rows[i - 1].time;
      EXPECT_GT(time, 0);
      if (step > 0) {
        EXPECT_NEAR(step / time, run.speed, 1e-9);
      }
      EXPECT_EQ(rows.rows[i].load, run.load);
      path += step;
    }
    EXPECT_NEAR(path, run.cycles * 2 * 3.5, 1e-9);
  }
}

TEST(PlannedRun, HasInstruction) {
  EXPECT_EQ(words(k_run, k_run.speed, "N"), "3 cycles, slow, at 5 N");
  PlannedRun other = k_run;
  other.load = 0;
  other.speed = radians(90.0);
  other.change = BenchChange::joint_sensor_turned;
  EXPECT_THAT(words(other, k_run.speed, "N"), HasSubstr("quarter turn"));
  EXPECT_THAT(words(other, k_run.speed, "N"), HasSubstr("90 deg/s, without load"));
}

// e(α + φ) − e(φ): the encoder's error after it is turned by φ and its zero is set again.
TEST(TurnedEncoder, ShiftsMotorError) {
  MotorSensorError motor;
  motor.eccentricity_sin = 0.02;
  motor.eccentricity_cos = -0.01;
  motor.wave_sin = 0.004;
  motor.wave_cos = 0.007;
  motor.wave_order = 3;
  const double turn = mounting_of(BenchChange::motor_sensor_turned).motor_sensor_turned;
  ASSERT_NE(turn, 0);
  const auto error = [&](double alpha) { return joint::shaft_angle(alpha, motor) - alpha; };
  for (const double alpha : {-2.0, -0.3, 0.0, 1.1, 4.0}) {
    const double shown = joint::shaft_angle(alpha, joint::turned(motor, turn)) - alpha;
    EXPECT_NEAR(shown, error(alpha + turn) - error(turn), 1e-15);
  }
  EXPECT_EQ(joint::turned(motor, 0.0), motor);
}

TEST(TurnedEncoder, ShiftsJointError) {
  JointSensorError sensor;
  sensor.eccentricity_sin = 0.02;
  sensor.eccentricity_cos = 0.03;
  const double turn = 0.7;
  const joint::BenchRun run{.rows = {{0, 0, 0, 0}, {1, 0, 0, 0}}};
  const auto error = [&](double theta, const JointSensorError& of) {
    return joint::sensed(run, {theta, theta}, of)[1] - theta;
  };
  for (const double theta : {-0.5, 0.2})
    EXPECT_NEAR(error(theta, joint::turned(sensor, turn)), error(theta + turn, sensor) - error(turn, sensor), 1e-15);
}

TEST(NextMeasurement, DescribesEachKind) {
  const NextMeasurement run = next_run(k_run, k_run.speed, "N");
  EXPECT_EQ(run.kind(), "run");
  EXPECT_EQ(run.words, "drive 3 cycles, slow, at 5 N");
  EXPECT_GT(run.minutes, minutes_of(k_run)) << "hanging the load takes time";
  PlannedRun turned = k_run;
  turned.change = BenchChange::joint_sensor_turned;
  EXPECT_EQ(next_run(turned, k_run.speed, "N").kind(), "turn_sensor");
  EXPECT_GT(next_run(turned, k_run.speed, "N").minutes, run.minutes);
  const fusee::EffectParameter& pin = find_effect("guide_radius", JointKind::tendons)->parameters.front();
  EXPECT_EQ(next_reading({&pin}).kind(), "caliper");
  EXPECT_EQ(next_reading({&pin}).words, std::string(pin.by_hand.words) + " = [value, uncertainty]");
  EXPECT_DOUBLE_EQ(next_reading({&pin, &pin}).minutes, 2 * next_reading({&pin}).minutes);
  const NextMeasurement inspection = next_inspection("tighten it");
  EXPECT_EQ(inspection.kind(), "inspect");
  EXPECT_EQ(inspection.text(), "tighten it");
  EXPECT_GT(inspection.minutes, 0);
}

// A reading that is written into the file is not requested again.
TEST(UnreadNumbers, WriteToTheirKeys) {
  for (const fusee::EffectParameter* number : unread_numbers(testing::forearm())) {
    DeclaredMechanism joint = testing::forearm();
    const Field* field = find_field(number->by_hand.key);
    ASSERT_NE(field, nullptr) << number->by_hand.key;
    EXPECT_THAT(std::string(number->by_hand.words), HasSubstr("prior." + std::string(field->key)));
    const auto value = [&](double written) {
      field->numbers(joint) = {written, 0.5};
      const std::vector<ManualReading> readings = number->by_hand.readings(joint);
      EXPECT_EQ(readings.size(), 1u) << field->key;
      EXPECT_GT(readings.back().uncertainty, 0) << field->key;
      return readings.back().value;
    };
    EXPECT_NE(value(2), value(1)) << field->key;
    EXPECT_THAT(unread_numbers(joint), Not(::testing::Contains(number)));
  }
}

TEST(BenchChanges, HaveInstructions) {
  EXPECT_THAT(words(BenchChange::none), IsEmpty());
  for (const BenchChange change : {BenchChange::motor_sensor_turned, BenchChange::joint_sensor_turned})
    EXPECT_THAT(words(change), Not(IsEmpty()));
}

}  // namespace
}  // namespace fusee::plan
