#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "fusee/base.h"
#include "fusee/measurement.h"

namespace fusee::measurement {
namespace {

/// Parameters of a simulated bench.
struct Bench {
  double noise = 0;  ///< rad
  int cycles = 6;
  int rows = 200;      ///< per stroke
  double shift = 0;    ///< change of θ from cycle to cycle, rad
  double quantum = 0;  ///< sensor step of θ, rad
  double alpha_quantum = 0;
  double colour = 0;               ///< correlation of the noise from row to row
  double load_noise = 0;           ///< N
  std::vector<double> loads = {};  ///< one per cycle, N; each moves the joint by −.01 rad/N
  bool same_places = false;        ///< rows of all cycles are at the same α
  unsigned seed = 7;
};

/// Cycles of a triangle wave with noise on θ.
Run logged(const Bench& bench) {
  std::mt19937 random(bench.seed);
  std::normal_distribution<double> normal;
  Run run;
  run.has_load = !bench.loads.empty() || bench.load_noise > 0;
  double carried = normal(random);
  const auto stepped = [](double value, double quantum) {
    return quantum > 0 ? quantum * std::round(value / quantum) : value;
  };
  for (int stroke = 0; stroke < 2 * bench.cycles; ++stroke) {
    const int cycle = stroke / 2;
    const double load = bench.loads.empty() ? 0 : bench.loads[static_cast<std::size_t>(cycle)];
    for (int i = 0; i < bench.rows; ++i) {
      // Places differ from cycle to cycle, as on a bench.
      const double share = (i + (bench.same_places ? 0.0 : 0.3 * (cycle % 3))) / bench.rows;
      carried = bench.colour * carried + std::sqrt(1 - bench.colour * bench.colour) * normal(random);
      Sample sample;
      sample.alpha = stroke % 2 == 0 ? share : 1 - share;
      sample.theta = stepped(
          0.3 * std::sin(2 * sample.alpha) + bench.noise * carried + bench.shift * cycle - 0.01 * load, bench.quantum);
      sample.alpha = stepped(sample.alpha, bench.alpha_quantum);
      sample.load = load + bench.load_noise * normal(random);
      run.samples.push_back(sample);
    }
    run.strokes.push_back({static_cast<std::size_t>(stroke * bench.rows),
                           static_cast<std::size_t>((stroke + 1) * bench.rows - 1), stroke % 2 == 0 ? 1 : -1, cycle,
                           false});
  }
  return run;
}

Measurement measured(const Bench& bench) {
  Measurement measurement;
  measurement.runs.push_back(logged(bench));
  measurement.theta_quantum = bench.quantum;
  measurement.alpha_quantum = bench.alpha_quantum;
  return measurement;
}

NoiseFloor floor_of(const Bench& bench) { return noise_floor(measured(bench)); }

TEST(NoiseFloor, EqualsSimulatedNoise) {
  for (const double noise : {1e-4, 1e-2}) {
    const NoiseFloor floor = floor_of({.noise = noise});
    EXPECT_TRUE(floor.from_repeats);
    EXPECT_NEAR(floor.rms, noise, 0.05 * noise);
    EXPECT_GT(floor.degrees_of_freedom, 400);
  }
}

TEST(NoiseFloor, IgnoresSteadyDrift) { EXPECT_NEAR(floor_of({.noise = 1e-4, .shift = 0.01}).rms, 1e-4, 1e-5); }

TEST(NoiseFloor, IsZeroForExactJoint) { EXPECT_LT(floor_of({.cycles = 4}).rms, 1e-8); }

// If the noise spreads readings over more than one step, the scatter is σ² + q²/12: the step is counted once.
TEST(NoiseFloor, CountsQuantisationOnce) {
  const double quantum = radians(0.1);
  for (const double noise : {0.5, 1.0}) {
    const double expected = quantum * std::sqrt(noise * noise + 1.0 / 12.0);
    EXPECT_NEAR(floor_of({.noise = noise * quantum, .quantum = quantum}).rms, expected, 0.06 * expected);
  }
}

TEST(NoiseFloor, RepeatsOnSameStepHideQuantisation) {
  const double quantum = radians(0.1);
  EXPECT_DOUBLE_EQ(floor_of({.quantum = quantum, .same_places = true}).rms, quantum / std::sqrt(12.0));
}

TEST(NoiseFloor, ScalesMotorStepBySlope) {
  const double step = 0.1;
  // θ spans about .3 while α spans 1.
  EXPECT_NEAR(floor_of({.alpha_quantum = step, .same_places = true}).rms, 0.3 * step / std::sqrt(12.0), 1e-4);
}

TEST(NoiseFloor, DenseLogHasRepeats) {
  const double quantum = 2e-3;
  const NoiseFloor floor = floor_of({.noise = 3e-3, .rows = 3000, .quantum = quantum, .alpha_quantum = 5e-3});
  EXPECT_TRUE(floor.from_repeats);
  // α's step appears in θ by the slope .6 cos 2α, whose rms over α = 0 … 1 is .6 √(1/2 + sin(4)/8) = .382.
  const double expected = std::sqrt(9e-6 + (quantum * quantum + 0.382 * 0.382 * 25e-6) / 12.0);
  EXPECT_NEAR(floor.rms, expected, 0.05 * expected);
}

TEST(NoiseFloor, IgnoresOutliers) {
  Measurement measurement = measured({.noise = 1e-3});
  for (std::size_t i = 40; i < measurement.runs[0].samples.size(); i += 371)
    measurement.runs[0].samples[i].theta += 0.2;
  EXPECT_NEAR(noise_floor(measurement).rms, 1e-3, 1e-4);
}

// A joint that sometimes settles elsewhere does so in more rows than sensor spikes do.
TEST(NoiseFloor, CountsFrequentDeviations) {
  Measurement measurement = measured({.noise = 1e-3});
  for (std::size_t i = 0; i < measurement.runs[0].samples.size(); ++i) {
    if (i / 400 == 2) measurement.runs[0].samples[i].theta += 0.02;
  }
  EXPECT_GT(noise_floor(measurement).rms, 5e-3);
}

TEST(NoiseFloor, ColourReducesDegreesOfFreedom) {
  const NoiseFloor white = floor_of({.noise = 1e-3, .cycles = 20}),
                   coloured = floor_of({.noise = 1e-3, .cycles = 20, .colour = 0.9});
  EXPECT_NEAR(coloured.rms, 1e-3, 1e-4);
  EXPECT_LT(coloured.degrees_of_freedom, 0.25 * white.degrees_of_freedom);
}

// A variance from n degrees of freedom has a variance of 2/n of its square.
TEST(NoiseFloor, DegreesOfFreedomPredictScatter) {
  for (const double colour : {0.0, 0.8}) {
    double sum = 0, squares = 0, degrees_of_freedom = 0;
    constexpr int trials = 300;
    for (int i = 0; i < trials; ++i) {
      const NoiseFloor floor = floor_of({.noise = 1,
                                         .cycles = 5,
                                         .rows = 60,
                                         .colour = colour,
                                         .same_places = true,
                                         .seed = 100u + static_cast<unsigned>(i)});
      const double variance = floor.rms * floor.rms;
      sum += variance / trials;
      squares += variance * variance / trials;
      degrees_of_freedom += floor.degrees_of_freedom / trials;
    }
    const double seen = 2 * sum * sum / (squares - sum * sum);
    EXPECT_NEAR(degrees_of_freedom / seen, 1.0, 0.35)
        << "colour " << colour << ": " << degrees_of_freedom << " reported, " << seen << " observed";
  }
}

TEST(NoiseFloor, ComparesEqualLoadsOnly) {
  const NoiseFloor stairs = floor_of({.noise = 1e-4, .cycles = 8, .loads = {0, 10, 20, 30, 0, 10, 20, 30}});
  EXPECT_TRUE(stairs.from_repeats);
  EXPECT_NEAR(stairs.rms, 1e-4, 1e-5);
  // Loads that differ by the load cell's noise count as one load.
  const NoiseFloor constant = floor_of({.noise = 1e-4, .load_noise = 0.1});
  EXPECT_TRUE(constant.from_repeats);
  EXPECT_GT(constant.degrees_of_freedom, 400);
}

TEST(NoiseFloor, ComparesSingleCyclesBetweenRuns) {
  Measurement measurement;
  for (unsigned i = 0; i < 5; ++i) measurement.runs.push_back(logged({.noise = 1e-3, .cycles = 1, .seed = i}));
  const NoiseFloor floor = noise_floor(measurement);
  EXPECT_TRUE(floor.from_repeats);
  EXPECT_NEAR(floor.rms, 1e-3, 1e-4);
  for (std::size_t i = 0; i < 5; ++i) measurement.runs[i].speed = 1.0 + static_cast<double>(i);
  EXPECT_FALSE(noise_floor(measurement).from_repeats);
}

// Runs before and after a change of the joint, at the same load, speed and places.
TEST(NoiseFloor, RejectsSmoothlyDifferentRuns) {
  for (const double colour : {0.0, 0.5}) {
    Measurement measurement;
    for (unsigned i = 0; i < 2; ++i)
      measurement.runs.push_back(logged({.noise = 1e-3, .cycles = 1, .colour = colour, .seed = i}));
    const NoiseFloor alike = noise_floor(measurement);
    EXPECT_TRUE(alike.from_repeats) << colour;
    EXPECT_EQ(alike.between_runs, 0) << colour;
    for (Sample& sample : measurement.runs[1].samples) sample.theta += 0.02 * std::cos(3 * sample.alpha);
    const NoiseFloor apart = noise_floor(measurement);
    EXPECT_FALSE(apart.from_repeats) << colour;
    EXPECT_LT(apart.rms, 1.1e-3) << colour;
    // rms of cos 3α over 0 … 1 is .69, but for the strokes' ends.
    EXPECT_NEAR(apart.between_runs, 0.69 * 0.02, 0.001) << colour;
  }
}

TEST(NoiseFloor, PrefersRepeatsWithinRun) {
  Measurement measurement;
  for (unsigned i = 0; i < 2; ++i) measurement.runs.push_back(logged({.noise = 1e-3, .seed = i}));
  for (Sample& sample : measurement.runs[1].samples) sample.theta += 0.02 * std::cos(3 * sample.alpha);
  const NoiseFloor floor = noise_floor(measurement);
  EXPECT_TRUE(floor.from_repeats);
  EXPECT_NEAR(floor.rms, 1e-3, 5e-5);
}

TEST(NoiseFloor, EstimatesColour) {
  for (const double colour : {0.0, 0.5, 0.9}) {
    const NoiseFloor floor = floor_of({.noise = 1e-3, .cycles = 20, .colour = colour});
    EXPECT_NEAR(floor.colour, colour, 0.08);  // interpolation between rows adds a little
    // The variance of a mean of n rows with correlation r^k is (1 + r)/(1 − r)/n. For every second row r² replaces r.
    const double r = floor.colour;
    EXPECT_DOUBLE_EQ(floor.effective_rows(100), 100 * (1 - r) / (1 + r));
    EXPECT_DOUBLE_EQ(floor.effective_rows(100, 2), 100 * (1 - r * r) / (1 + r * r));
  }
}

/// Alternating dwells at both ends, of `rows` rows each. The joint settles differently at each visit, by `scatter` rms.
Measurement dwells_at_ends(double noise, double scatter, int rows) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  Measurement measurement;
  Run& run = measurement.runs.emplace_back();
  for (int visit = 0; visit < 400; ++visit) {
    const double landed = scatter * normal(random), alpha = visit % 2 == 0 ? 0.0 : 1.0;
    const std::size_t first = run.samples.size();
    for (int i = 0; i < rows; ++i) {
      Sample sample;
      // The motor misses the angle slightly.
      sample.alpha = alpha + 3e-4 * normal(random);
      sample.theta = 0.3 * sample.alpha + landed + noise * normal(random);
      run.samples.push_back(sample);
    }
    run.strokes.push_back({first, run.samples.size() - 1, visit % 2 == 0 ? -1 : 1, visit / 2, false});
    run.segments.push_back({first, run.samples.size() - 1, run.strokes.size() - 1, true, 0});
  }
  return measurement;
}

TEST(NoiseFloor, ComparesDwells) {
  for (const int rows : {1, 12}) {
    const NoiseFloor floor = noise_floor(dwells_at_ends(1e-3, 0, rows));
    EXPECT_TRUE(floor.from_repeats);
    EXPECT_NEAR(floor.rms, 1e-3, rows == 1 ? 1e-4 : 3e-5) << rows;
  }
  // The scatter between visits counts, once per visit.
  const NoiseFloor apart = noise_floor(dwells_at_ends(1e-3, 2e-3, 12));
  EXPECT_NEAR(apart.rms, std::sqrt(5.0) * 1e-3, 2e-4);  // noise 1e-3 and scatter 2e-3
  EXPECT_GT(apart.colour, 0.6);
  EXPECT_LT(apart.degrees_of_freedom, 0.5 * noise_floor(dwells_at_ends(1e-3, 0, 12)).degrees_of_freedom);
}

/// Dwells of one row at five uneven angles on each stroke, each cycle under another load. θ is quadratic in α and
/// depends on the load.
Measurement dwells_without_repeats(double noise, unsigned seed) {
  constexpr int cycles = 8;
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Measurement measurement;
  Run& run = measurement.runs.emplace_back();
  run.has_load = true;
  const std::vector<double> places = {0.0, 0.2, 0.5, 0.6, 1.0};
  for (int stroke = 0; stroke < 2 * cycles; ++stroke) {
    const std::size_t first = run.samples.size();
    for (std::size_t i = 0; i < places.size(); ++i) {
      Sample sample;
      sample.alpha = places[stroke % 2 == 0 ? i : places.size() - 1 - i];
      sample.load = 10.0 * (stroke / 2);
      sample.theta =
          (0.3 + 0.01 * sample.load) * sample.alpha - 0.1 * sample.alpha * sample.alpha + noise * normal(random);
      run.samples.push_back(sample);
      run.segments.push_back(
          {run.samples.size() - 1, run.samples.size() - 1, static_cast<std::size_t>(stroke), true, 0});
    }
    run.strokes.push_back({first, run.samples.size() - 1, stroke % 2 == 0 ? 1 : -1, stroke / 2, false});
  }
  return measurement;
}

TEST(NoiseFloor, ComparesNeighbouringDwells) {
  // A parabola is not noise, at even or uneven distances.
  EXPECT_LT(noise_floor(dwells_without_repeats(0, 1)).rms, 1e-12);
  constexpr unsigned logs = 400;
  double squares = 0;
  for (unsigned seed = 1; seed <= logs; ++seed) {
    const NoiseFloor floor = noise_floor(dwells_without_repeats(1e-3, seed));
    EXPECT_FALSE(floor.from_repeats);
    EXPECT_LT(floor.degrees_of_freedom, 32);  // two differences in each of 16 strokes, which share rows
    squares += floor.rms * floor.rms / logs;
  }
  EXPECT_NEAR(std::sqrt(squares), 1e-3, 3e-5);
}

TEST(NoiseFloor, IsLowerBoundWithoutRepeats) {
  const NoiseFloor floor = floor_of({.noise = 1e-3, .cycles = 1});
  EXPECT_FALSE(floor.from_repeats);
  EXPECT_NEAR(floor.rms, 1e-3, 1e-4);
  EXPECT_LT(floor_of({.noise = 1e-3, .cycles = 1, .colour = 0.95}).rms, 0.5e-3);
}

}  // namespace
}  // namespace fusee::measurement
