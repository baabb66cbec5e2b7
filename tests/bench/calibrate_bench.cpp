// Duration of a calibration with five runs of 500 rows and the whole catalogue, and its growth with the number of rows.
//
// Peers: calibrate_peers.py FUSEE
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iterator>

#include "base/text.h"
#include "calibration/words.h"
#include "fusee/correction.h"
#include "fusee/joint.h"
#include "fusee/mechanism_file.h"
#include "fusee/transmission.h"

namespace {

using namespace fusee;

const DeclaredMechanism& forearm() {
  static const DeclaredMechanism mechanism =
      read_mechanism(std::filesystem::path(FUSEE_SOURCE_DIR) / "profiles/forearm.toml").mechanism;
  return mechanism;
}

/// Sum of twelve uniform deviates, less its mean of 6: approximately normal with variance 1, and equal on every machine.
/// The generator is linear congruential with Knuth's constants for MMIX.
class Noise {
 public:
  double operator()() {
    double sum = -6;
    for (int i = 0; i < 12; ++i) {
      state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
      sum += static_cast<double>(state_ >> 11) / 9007199254740992.0;  // 2⁵³
    }
    return sum;
  }

 private:
  std::uint64_t state_ = 1;
};

struct Plan {
  double load = 0;      ///< N
  double seconds = 75;  ///< the whole run
};
constexpr Plan k_runs[] = {{0, 75}, {20, 75}, {0, 15}, {10, 75}, {-20, 75}};
constexpr int k_strokes = 5;        // reversals fall on rows
constexpr int k_model_rows = 4000;  // of the simulated truth, for each run

/// Motor angle at a share of the run, for strokes there and back.
double alpha_at(double share) {
  static const transmission::Transmission law(forearm());
  const double stroke = share * k_strokes;
  const double there = stroke - 2 * std::floor(0.5 * stroke);
  return 0.9 * (law.alpha_min() + (law.alpha_max() - law.alpha_min()) * (there <= 1 ? there : 2 - there));
}

/// θ of such runs with a tendon of 12000 instead of 40000 MPa and 1.2° of play, without noise, at a fixed number of
/// rows.
const std::vector<std::vector<double>>& true_angles() {
  static const std::vector<std::vector<double>> angles = [] {
    measurement::Measurement measurement;
    for (const Plan& plan : k_runs) {
      measurement::Run run;
      run.has_time = run.has_load = true;
      for (int i = 0; i <= k_model_rows; ++i) {
        const double share = static_cast<double>(i) / k_model_rows;
        run.samples.push_back({share * plan.seconds, alpha_at(share), 0, plan.load, 0, 0, 0});
      }
      measurement.runs.push_back(run);
    }
    Imperfections hidden;
    hidden.tendon.stretch = 40000.0 / 12000.0 - 1;
    hidden.shaft.backlash = radians(1.2);
    return joint::predict(forearm(), hidden, measurement::bench_log(measurement));
  }();
  return angles;
}

std::string run_text(std::size_t run, std::int64_t rows, Noise& noise) {
  const std::vector<double>& truth = true_angles()[run];
  std::string text = "time_s,alpha_deg,theta_deg,load_N\n";
  for (std::int64_t i = 0; i < rows; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(rows);
    const auto before = static_cast<std::size_t>(share * k_model_rows);
    const double between = share * k_model_rows - static_cast<double>(before);
    const double theta = truth[before] + between * (truth[before + 1] - truth[before]) + radians(0.02) * noise();
    text += fixed(share * k_runs[run].seconds, 5) + "," + fixed(degrees(alpha_at(share)), 4) + "," +
            fixed(degrees(theta), 5) + "," + fixed(k_runs[run].load, 1) + "\n";
  }
  return text;
}

std::vector<std::string> texts(std::int64_t rows) {
  Noise noise;
  std::vector<std::string> all;
  for (std::size_t run = 0; run < std::size(k_runs); ++run)
    all.push_back(run_text(run, rows / static_cast<std::int64_t>(std::size(k_runs)), noise));
  return all;
}

measurement::Measurement measured(const std::vector<std::string>& runs) {
  measurement::Measurement measurement;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    measurement::Run run = measurement::parse_run(runs[i], "run_" + std::to_string(i + 1), {}, measurement);
    measurement.runs.push_back(std::move(run));
  }
  return measurement;
}

/// `rows` in five runs, with the correction: everything of `fusee calibrate` except files.
void calibrate_rows(benchmark::State& state) {
  const measurement::Measurement measurement = measured(texts(state.range(0)));
  std::string verdict;
  for (auto _ : state) {
    const calibration::Calibration calibration = calibration::calibrate(forearm(), measurement);
    benchmark::DoNotOptimize(correction::correct(forearm(), measurement, calibration));
    verdict = calibration::word(calibration.verdict);
    for (const calibration::FoundEffect& effect : calibration.effects) verdict += " " + effect.name;
  }
  state.SetLabel(verdict);
}
BENCHMARK(calibrate_rows)
    ->Name("calibrate, five runs of 500 rows")
    ->Arg(2500)
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->Iterations(1);
BENCHMARK(calibrate_rows)
    ->Name("calibrate, rows")
    ->Arg(10000)
    ->Arg(100000)
    ->Arg(1000000)
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->Iterations(1);

/// One simulation of the rows: a fit does this for each parameter in each step.
void move_joint(benchmark::State& state) {
  const joint::BenchLog log = measurement::bench_log(measured(texts(state.range(0))));
  Imperfections soft;
  soft.tendon.stretch = 1.5;
  soft.shaft.backlash = radians(1.0);
  for (auto _ : state) benchmark::DoNotOptimize(joint::predict(forearm(), soft, log));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(move_joint)->Name("move the joint, rows")->Arg(850)->Arg(2500)->Unit(benchmark::kMillisecond);

void read_rows(benchmark::State& state) {
  const std::vector<std::string> runs = texts(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(measured(runs));
  state.SetComplexityN(state.range(0));
}
BENCHMARK(read_rows)
    ->Name("read, rows")
    ->Arg(10000)
    ->Arg(100000)
    ->Arg(1000000)
    ->Unit(benchmark::kMillisecond)
    ->Complexity(benchmark::oN);

}  // namespace
