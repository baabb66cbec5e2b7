#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fusee/base/units.h"
#include "fusee/calibration/measurement.h"

namespace fusee {
namespace {

/// Cycles of a triangle wave with white noise on θ, `shift` added from cycle to cycle.
Measurement noisy(double noise, int cycles, double shift = 0, double quantum = 0) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  Measurement measurement;
  Run run;
  constexpr int rows = 200;
  for (int stroke = 0; stroke < 2 * cycles; ++stroke) {
    for (int i = 0; i < rows; ++i) {
      // Places differ from cycle to cycle, as on a bench.
      const double share = (i + 0.3 * (stroke / 2)) / rows;
      Sample sample;
      sample.alpha = stroke % 2 == 0 ? share : 1 - share;
      sample.theta = 0.3 * std::sin(2 * sample.alpha) + noise * normal(random) + shift * (stroke / 2);
      if (quantum > 0) sample.theta = quantum * std::round(sample.theta / quantum);
      run.samples.push_back(sample);
    }
    run.strokes.push_back({static_cast<std::size_t>(stroke * rows), static_cast<std::size_t>((stroke + 1) * rows - 1), stroke % 2 == 0 ? 1 : -1, stroke / 2, false});
  }
  measurement.runs.push_back(run);
  measurement.theta_quantum = quantum;
  return measurement;
}

TEST(NoiseFloor, IsTheNoise) {
  for (const double noise : {1e-4, 1e-2}) {
    const NoiseFloor floor = noise_floor(noisy(noise, 6));
    EXPECT_TRUE(floor.from_repeats);
    EXPECT_NEAR(floor.rms, noise, 0.05 * noise);
    EXPECT_GT(floor.degrees_of_freedom, 500);
  }
}

TEST(NoiseFloor, SteadyDriftIsNoNoise) { EXPECT_NEAR(noise_floor(noisy(1e-4, 6, 0.01)).rms, 1e-4, 1e-5); }

TEST(NoiseFloor, AnExactJointHasNone) { EXPECT_LT(noise_floor(noisy(0, 4)).rms, 1e-8); }

TEST(NoiseFloor, ACoarseSensorAddsItsQuantum) {
  const double quantum = radians(0.1);
  EXPECT_GE(noise_floor(noisy(1e-5, 6, 0, quantum)).rms, quantum / std::sqrt(12.0));
}

TEST(NoiseFloor, WithoutRepeatsItIsOnlyABound) {
  const NoiseFloor floor = noise_floor(noisy(1e-3, 1));
  EXPECT_FALSE(floor.from_repeats);
  EXPECT_NEAR(floor.rms, 1e-3, 1e-4);
}

}  // namespace
}  // namespace fusee
