// The simulation that fits use, for a joint declared by its ratio, compared with closed forms.
#include "joint/forward.h"

#include <gmock/gmock.h>

#include "calibration/linear_joint.h"

namespace fusee::calibration::linear {
namespace {

class GearedJoint : public testing::Test {
 protected:
  measurement::Measurement measurement = measured({0, 5}, [](const measurement::Sample&) { return 0.0; });
  joint::BenchLog log = measurement::bench_log(measurement);
  joint::Forward forward{joint(), log};

  Imperfections with(const std::string& effect, double value) const {
    Imperfections at;
    set_value(at, named(effect).parameters.front(), value);
    return at;
  }

  /// Compares every row with its expected value.
  void expect(const Imperfections& at,
              const std::function<double(const fusee::measurement::Run&, std::size_t)>& expected) {
    const joint::Readings found = forward(at);
    for (std::size_t r = 0; r < found.size(); ++r) {
      for (std::size_t i = 0; i < found[r].size(); ++i)
        EXPECT_NEAR(found[r][i], expected(measurement.runs[r], i), 1e-14) << r << " " << i;
    }
  }
};

double declared(const fusee::measurement::Run& run, std::size_t i) { return run.samples[i].alpha / k_ratio; }

TEST_F(GearedJoint, FollowsDeclaredRatio) { expect({}, declared); }

TEST_F(GearedJoint, AddsZero) {
  Imperfections at;
  set_value(at, *calibration::free_offset(joint()), 0.02);
  expect(at, [](const fusee::measurement::Run& run, std::size_t i) { return declared(run, i) + 0.02; });
}

TEST_F(GearedJoint, GainIsProportionalToAngle) {
  expect(with("joint_sensor_gain", 0.01),
         [](const fusee::measurement::Run& run, std::size_t i) { return 1.01 * declared(run, i); });
}

TEST_F(GearedJoint, LoadTurnsJointDown) {
  expect(with("tendon_stretch", 1e-3), [](const fusee::measurement::Run& run, std::size_t i) {
    return declared(run, i) - 1e-3 * run.samples[i].load;
  });
}

TEST_F(GearedJoint, PlayFollowsAtHalfItsWidth) {
  constexpr double width = 0.3;
  expect(with("backlash", width), [play = 0.0](const fusee::measurement::Run& run, std::size_t i) mutable {
    if (i == 0) play = run.samples[0].alpha + 0.5 * width;  // reached from home, by falling α
    const double alpha = run.samples[i].alpha;
    play = std::clamp(play, alpha - 0.5 * width, alpha + 0.5 * width);
    return play / k_ratio;
  });
}

TEST_F(GearedJoint, DelayShowsEarlierAngle) {
  const Imperfections late = with("sensor_lag", 0.25);  // a quarter of the time between rows
  expect(late, [](const fusee::measurement::Run& run, std::size_t i) {
    return i == 0 ? declared(run, 0) : 0.25 * declared(run, i - 1) + 0.75 * declared(run, i);
  });
}

TEST_F(GearedJoint, FilterShowsRoundedReversal) {
  constexpr double tau = 0.8;
  Imperfections late;
  late.sensor.lag = tau;
  late.sensor.first_order = 1;
  // Integrates τ ẏ = θ − y in small steps along straight lines between rows, which are one second apart.
  const joint::Readings found = forward(late);
  const fusee::measurement::Run& run = measurement.runs[0];
  double y = declared(run, 0);
  for (std::size_t i = 1; i < run.samples.size(); ++i) {
    constexpr int steps = 20000;
    const double from = declared(run, i - 1), by = declared(run, i) - from;
    for (int k = 0; k < steps; ++k) y += (from + by * (k + 0.5) / steps - y) / (tau * steps);
    EXPECT_NEAR(found[0][i], y, 1e-5) << i;
  }
}

TEST_F(GearedJoint, SensorHarmonicsHaveTheirOrders) {
  Imperfections at;
  at.sensor.wave_sin = 0.01;
  at.sensor.wave_cos = -0.02;
  at.sensor.wave_order = 3;
  expect(at, [](const fusee::measurement::Run& run, std::size_t i) {
    const double theta = declared(run, i);
    return theta + 0.01 * std::sin(3 * theta) - 0.02 * (std::cos(3 * theta) - 1);
  });
  at = {};
  at.motor.wave_cos = 0.03;
  at.motor.wave_order = 4;
  expect(at, [](const fusee::measurement::Run& run, std::size_t i) {
    return declared(run, i) + 0.03 * (std::cos(4 * run.samples[i].alpha) - 1) / k_ratio;
  });
}

TEST_F(GearedJoint, LoadTakesUpSlack) {
  Imperfections at;
  at.ratio_joint.slack = 0.3;
  at.ratio_joint.slack_taken_up = 0.2;
  expect(at, [play = 0.0](const fusee::measurement::Run& run, std::size_t i) mutable {
    const double width = 0.3 / (1 + 0.2 * run.samples[i].load);  // half of it under 5
    if (i == 0) play = run.samples[0].alpha + 0.5 * width;       // reached from home, by falling α
    const double alpha = run.samples[i].alpha;
    play = std::clamp(play, alpha - 0.5 * width, alpha + 0.5 * width);
    return play / k_ratio;
  });
}

TEST_F(GearedJoint, CreepFollowsLogarithmOfTime) {
  const joint::Readings found = forward(with("creep", 1e-3));
  const fusee::measurement::Run& loaded = measurement.runs[1];
  for (std::size_t i = 0; i < loaded.samples.size(); ++i) {
    EXPECT_NEAR(found[0][i], declared(measurement.runs[0], i), 1e-15);
    const double time = loaded.samples[i].time - loaded.samples[0].time;
    EXPECT_NEAR(found[1][i], declared(loaded, i) - 5e-3 * std::log10(1 + 1.78 * time), 0.15 * 5e-3) << i;
  }
}

TEST(Creep, IsRememberedInTheNextRun) {
  const measurement::Measurement measurement = measured({0, 5, 0}, [](const measurement::Sample&) { return 0.0; });
  const joint::BenchLog log = measurement::bench_log(measurement);
  joint::Forward forward(joint(), log);
  Imperfections at;
  at.ratio_joint.drift = 1e-3;
  const joint::Readings found = forward(at);
  // A run is 79 s long. The creep of the loaded run remains, minus the creep since the load was removed.
  const double remaining = 5e-3 * (std::log10(79.0 + 20) - std::log10(20.0));
  EXPECT_NEAR(declared(measurement.runs[2], 20) - found[2][20], remaining, 0.1 * 5e-3);
}

TEST_F(GearedJoint, IsNeverLoose) {
  for (const std::vector<double>& run : forward.looseness({})) EXPECT_THAT(run, testing::Each(0.0));
}

}  // namespace
}  // namespace fusee::calibration::linear
