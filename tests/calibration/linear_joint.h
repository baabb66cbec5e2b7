/// \file
/// A joint whose fit is linear least squares: declared by its ratio, logged under loads, θ = offset + α/4 − c·load.
#pragma once

#include <functional>
#include <random>

#include "calibration/fit.h"
#include "fusee/mechanism_file.h"

namespace fusee::calibration::linear {

constexpr double k_ratio = 4;
constexpr double k_floor = 1e-3;    // rad
constexpr std::size_t k_rows = 20;  // of a stroke

inline const DeclaredMechanism& joint() {
  static const DeclaredMechanism declared =
      parse_mechanism("schema = 1\nname = \"joint\"\n[transmission]\nkind = \"ratio\"\nratio = 4\n", "joint.toml");
  return declared;
}

/// `strokes` strokes up and down, at one row per second.
inline measurement::Run run_of(const std::string& name, double load, std::size_t strokes) {
  measurement::Run run;
  run.name = name;
  run.has_time = run.has_load = true;
  run.mean_load = load;
  run.speed = 0.1;
  for (std::size_t s = 0; s < strokes; ++s) {
    const int direction = s % 2 == 0 ? 1 : -1;
    run.strokes.push_back({s * k_rows, s * k_rows + k_rows - 1, direction, static_cast<int>(s / 2), false});
    for (std::size_t i = 0; i < k_rows; ++i) {
      measurement::Sample sample;
      sample.time = static_cast<double>(run.samples.size());
      sample.alpha = direction * (-1.0 + 2.0 * static_cast<double>(i) / (k_rows - 1));
      sample.theta = sample.alpha / k_ratio;
      sample.load = load;
      run.samples.push_back(sample);
    }
  }
  return run;
}

/// A run of four strokes for each load. `added`: added to the declared θ of a row, rad.
inline measurement::Measurement measured(const std::vector<double>& loads,
                                         const std::function<double(const measurement::Sample&)>& added) {
  measurement::Measurement measurement;
  measurement.load_unit = "N";
  for (std::size_t i = 0; i < loads.size(); ++i) {
    measurement.runs.push_back(run_of("run_" + std::to_string(i + 1), loads[i], 4));
    for (measurement::Sample& sample : measurement.runs.back().samples) sample.theta += added(sample);
  }
  return measurement;
}

/// Every row of every stroke in use, each stroke a fold.
inline calibration::Evidence evidence_of(const measurement::Measurement& measurement) {
  calibration::Evidence evidence;
  evidence.declared = &joint();
  evidence.measurement = measurement;
  evidence.log = measurement::bench_log(measurement);
  evidence.floor = k_floor;
  joint::Readings theta;
  std::size_t offset = 0;
  for (std::size_t r = 0; r < measurement.runs.size(); ++r) {
    const measurement::Run& run = measurement.runs[r];
    theta.emplace_back();
    for (const measurement::Sample& sample : run.samples) theta.back().push_back(sample.theta);
    for (std::size_t s = 0; s < run.strokes.size(); ++s) {
      calibration::Block block{r, s, {}};
      for (std::size_t i = run.strokes[s].first; i <= run.strokes[s].last; ++i) block.rows.push_back(offset + i);
      evidence.run_folds.push_back({evidence.blocks.size()});
      evidence.blocks.push_back(block);
    }
    offset += run.samples.size();
  }
  evidence.theta = calibration::flat(theta);
  evidence.factor_folds = evidence.run_folds;
  calibration::weigh(evidence);
  return evidence;
}

inline std::function<double(const measurement::Sample&)> white_noise(double size, unsigned seed) {
  return [size, random = std::mt19937(seed)](const measurement::Sample&) mutable {
    return std::normal_distribution<double>(0.0, size)(random);
  };
}

/// Fit of given slopes and residuals by normal equations, without simulation.
inline calibration::Fit hand_made(const calibration::Evidence& evidence, const Eigen::MatrixXd& J,
                                  const Eigen::VectorXd& residual) {
  calibration::Fit fit;
  fit.usable = true;
  fit.J = J;
  fit.x = Eigen::VectorXd::Zero(J.cols());
  fit.residual = residual;
  fit.loose = Eigen::VectorXd::Zero(residual.size());
  fit.readings = calibration::NormalEquations::none(J.cols());
  double squares = 0;
  for (const calibration::Block& block : evidence.blocks) {
    fit.sums.push_back(calibration::sums_of(block, fit, evidence.floor));
    squares += fit.sums.back().rr;
  }
  fit.mean_square = squares / static_cast<double>(evidence.rows_used());
  fit.by_factor = calibration::hold_out(evidence, fit, evidence.factor_folds);
  fit.by_run = calibration::hold_out(evidence, fit, evidence.run_folds);
  return fit;
}

inline const Effect& named(const std::string& name) {
  const Effect* effect = find_effect(name, JointKind::ratio);
  if (effect == nullptr) throw std::invalid_argument("no effect " + name);
  return *effect;
}

}  // namespace fusee::calibration::linear
