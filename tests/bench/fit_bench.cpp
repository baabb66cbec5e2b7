// One fit of three known parameters, gain, play and zero, to measured runs. Then the joint as a function, for other
// least-squares solvers with the same physics: calibrate_peers.py.
//
//   bench_fit SPEC RUN.csv...
//
// Standard output gets a line of JSON for the fit. Then each line "gain play zero" (rad) of standard input is answered
// by the residuals, measured − model in rad, as doubles. The first line states their number.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "calibration/fit.h"
#include "fusee/base.h"
#include "fusee/joint.h"
#include "fusee/mechanism_file.h"

namespace {

using namespace fusee;

constexpr double k_noise_floor = radians(0.02);  // that of calibrate_peers.py
constexpr int k_repetitions = 7;

const Effect* effect(const char* name) { return find_effect(name, JointKind::tendons); }

/// Best of several, each with its own simulation: other load on the machine only increases the time.
double fit_seconds(const calibration::Evidence& evidence, const calibration::EffectSet& effects,
                   calibration::Fit& fit) {
  double best = 1e300;
  for (int i = 0; i < k_repetitions; ++i) {
    const auto start = std::chrono::steady_clock::now();
    joint::Forward forward(*evidence.declared, evidence.log);
    fit = calibration::Fitter(evidence, forward).fit(effects, {});
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return best;
}

void answer(const calibration::Evidence& evidence) {
  Imperfections at;
  while (std::scanf("%lf %lf %lf", &at.sensor.gain, &at.shaft.backlash, &at.sensor.zero) == 3) {
    const Eigen::VectorXd residual =
        evidence.theta - calibration::flat(joint::predict(*evidence.declared, at, evidence.log));
    std::fwrite(residual.data(), sizeof(double), static_cast<std::size_t>(residual.size()), stdout);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fputs("usage: bench_fit SPEC RUN.csv...\n", stderr);
    return 2;
  }
  const DeclaredMechanism declared = joint::expected_joint(read_mechanism(argv[1]).mechanism);
  const std::vector<std::filesystem::path> runs(argv + 2, argv + argc);
  const calibration::Evidence evidence =
      calibration::gather(declared, measurement::read_measurement(runs, declared), k_noise_floor);
  calibration::Fit fit;
  const double seconds =
      fit_seconds(evidence, {effect("joint_sensor_gain"), effect("backlash"), effect("zero_offset")}, fit);
  std::printf("{\"seconds\": %.6f, \"rows\": %ld, \"gain\": %.9g, \"play\": %.9g, \"zero\": %.9g}\n", seconds,
              static_cast<long>(evidence.theta.size()), fit.at.sensor.gain, fit.at.shaft.backlash, fit.at.sensor.zero);
  std::fflush(stdout);
  answer(evidence);
}
