// A custom effect requires one file like this one. Calibration then searches for it and identifies it.
#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "fusee/calibration.h"
#include "fusee/joint.h"
#include "support/mechanisms.h"

namespace fusee::calibration {
namespace {

constexpr double k_noise = radians(0.01);

/// A pulley with seven lobes, from the teeth of the wheel that turned the printer's table. No effect of the catalogue
/// and no combination acts like it. (Five lobes would be ambiguous with waves of both sensors.)
fusee::Effect seven_lobes() {
  fusee::Effect effect;
  effect.name = "seven_lobes";
  effect.place = ChainPlace::pulley;
  effect.rank = 5;
  effect.signature = "seven times per turn of the pulley, independent of direction and load";
  effect.correctable_by = CorrectableBy::pulley;
  effect.needs = {.tendons = true};
  effect.parameters = {{.name = "sin_mm",
                        .number = [](Imperfections& at) -> double& { return at.pulley.outline.wave_sin; },
                        .least = -2,
                        .most = 2,
                        .step = 2e-3,
                        .shown = shown::as_is,
                        .key = {}},
                       {.name = "cos_mm",
                        .number = [](Imperfections& at) -> double& { return at.pulley.outline.wave_cos; },
                        .least = -2,
                        .most = 2,
                        .step = 2e-3,
                        .shown = shown::as_is,
                        .key = {}},
                       {.name = "order",
                        .number = [](Imperfections& at) -> double& { return at.pulley.outline.wave_order; },
                        .least = 7,
                        .most = 7,
                        .step = 1,
                        .shown = shown::as_is,
                        .key = {},
                        .searched = true}};
  effect.starts = {{0, 0, 7}};
  return effect;
}

/// Three runs of three cycles over the whole range.
measurement::Measurement measured(const DeclaredMechanism& declared, const Imperfections& truth) {
  constexpr int k_rows = 120;
  constexpr double k_most = radians(100);
  measurement::Measurement measurement;
  measurement.load_unit = "N";
  for (int r = 0; r < 3; ++r) {
    fusee::measurement::Run run;
    run.name = "run_" + std::to_string(r + 1) + ".csv";
    for (int stroke = 0; stroke < 6; ++stroke) {
      const bool up = stroke % 2 == 0;
      const std::size_t first = run.samples.size();
      for (int i = 0; i < k_rows; ++i) {
        measurement::Sample sample;
        sample.alpha = (up ? 1 : -1) * k_most * (2.0 * i / (k_rows - 1) - 1.0);
        run.samples.push_back(sample);
      }
      run.strokes.push_back({first, run.samples.size() - 1, up ? 1 : -1, stroke / 2, false});
    }
    measurement.runs.push_back(run);
  }
  const joint::Readings theta = joint::predict(declared, truth, measurement::bench_log(measurement));
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, k_noise);
  for (std::size_t r = 0; r < theta.size(); ++r) {
    for (std::size_t i = 0; i < theta[r].size(); ++i)
      measurement.runs[r].samples[i].theta = theta[r][i] + noise(random);
  }
  return measurement;
}

/// A forearm whose tendons stay taut over the lobes. Readings of a loose joint contain little information.
DeclaredMechanism taut_forearm() {
  DeclaredMechanism mechanism = testing::forearm();
  mechanism.tendon.modulus = 3000;
  mechanism.tendon.pretension = 30;
  return mechanism;
}

TEST(CustomEffect, IsFoundOnlyWithItsFile) {
  const DeclaredMechanism declared = taut_forearm();
  Imperfections truth;
  truth.pulley.outline.wave_sin = 0.4;
  truth.pulley.outline.wave_order = 7;
  const measurement::Measurement measurement = measured(declared, truth);
  EXPECT_EQ(calibrate(declared, measurement).verdict, CalibrationVerdict::unexplained);
  const fusee::Effect own = seven_lobes();
  CalibrationOptions options;
  options.more_effects = {&own};
  const Calibration found = calibrate(declared, measurement, options);
  EXPECT_EQ(found.verdict, CalibrationVerdict::explained) << found.summary;
  ASSERT_EQ(found.effects.size(), 1u);
  EXPECT_EQ(found.effects.front().name, "seven_lobes");
  EXPECT_THAT(found.effects.front().group, ::testing::ElementsAre("seven_lobes"));
  EXPECT_NEAR(found.effects.front().parameters.at(0).value, 0.4, 0.02);
  EXPECT_NEAR(found.identified.pulley.outline.wave_sin, 0.4,
              0.02);  // a discrepancy of any smooth shape is allowed beside it
  EXPECT_EQ(found.identified.pulley.outline.wave_order, 7);
}

}  // namespace
}  // namespace fusee::calibration
