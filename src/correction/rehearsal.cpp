#include <algorithm>
#include <cmath>

#include "fusee/base.h"
#include "fusee/correction.h"
#include "fusee/joint.h"
#include "mechanism/effect.h"
#include "transmission/load.h"

namespace fusee::correction {
namespace {

constexpr int k_intervals = 60;                      ///< of the stroke
constexpr double k_speed = radians(20);              ///< motor speed, rad/s: slow, as on a bench
constexpr double k_least_influence = radians(1e-3);  ///< on the sensed angle, rad; smaller effects are not listed

/// No load, and the largest logged loads in both directions, ascending; the declared load if none was logged as a
/// force.
std::vector<double> loads_of(const measurement::Measurement& measurement, const Mechanism& expected) {
  double low = 0, high = 0;
  bool logged = false;
  for (const measurement::Run& run : measurement.runs) {
    logged = logged || (run.has_load && measurement.load_unit == "N");
    for (const measurement::Sample& sample : run.samples) {
      if (!run.has_load) continue;
      low = std::min(low, sample.load);
      high = std::max(high, sample.load);
    }
  }
  if (!logged) return {expected.load.tip_force};
  std::vector<double> loads{low, 0.0, high};
  loads.erase(std::unique(loads.begin(), loads.end()), loads.end());
  return loads;
}

std::vector<double> difference_of(std::vector<double> one, const std::vector<double>& other) {
  for (std::size_t i = 0; i < one.size(); ++i) one[i] -= other[i];
  return one;
}

/// A cycle of a stroke there and back under one load, driven twice; the second cycle is evaluated.
class Drive {
 public:
  Drive(const Mechanism& expected, const std::vector<double>& alphas, double load)
      : expected_(expected), count_(alphas.size()) {
    joint::BenchRun run;
    run.has_load = true;
    double time = 0, at = 0;
    const auto move_to = [&](double alpha) {
      time += std::abs(alpha - at) / k_speed;
      at = alpha;
      joint::BenchRow row;
      row.time = time;
      row.alpha = alpha;
      row.load = load;
      run.rows.push_back(row);
    };
    for (auto alpha = alphas.rbegin(); alpha != alphas.rend(); ++alpha) {
      if (*alpha <= 0) move_to(*alpha);  // from home to the lower end
    }
    first_ = run.rows.size();
    for (int cycle = 0; cycle < 2; ++cycle) {
      std::for_each(alphas.begin(), alphas.end(), move_to);
      std::for_each(alphas.rbegin(), alphas.rend(), move_to);
    }
    log_ = {run};
    without_ = sensed_angles({});
  }

  struct DirectionalResponse {
    std::vector<double> rising, falling;  ///< rad
  };
  /// Change of the sensed angle by the given imperfections.
  DirectionalResponse response_to(const Imperfections& imperfections) const {
    const DirectionalResponse with = sensed_angles(imperfections);
    return {difference_of(with.rising, without_.rising), difference_of(with.falling, without_.falling)};
  }

 private:
  DirectionalResponse sensed_angles(const Imperfections& imperfections) const {
    const std::vector<double> theta = joint::predict(expected_, imperfections, log_).front();
    const auto start = theta.begin() + static_cast<std::ptrdiff_t>(first_ + 2 * count_);  // of the second cycle
    const auto reversal = start + static_cast<std::ptrdiff_t>(count_);
    DirectionalResponse angles{{start, reversal}, {reversal, reversal + static_cast<std::ptrdiff_t>(count_)}};
    std::reverse(angles.falling.begin(), angles.falling.end());  // by increasing α
    return angles;
  }

  const Mechanism& expected_;
  std::size_t count_;      ///< rows of a stroke
  std::size_t first_ = 0;  ///< row of the first cycle
  joint::BenchLog log_;
  DirectionalResponse without_;  ///< sensed angles without imperfections
};

/// Imperfections with `effect` alone, at a share of its identified size.
Imperfections share_of(const Effect& effect, const Imperfections& found, double share) {
  Imperfections joint;
  for (const EffectParameter& parameter : effect.parameters) {
    reset(joint, parameter);
    const double none = value_of(joint, parameter);
    set_value(joint, parameter, none + share * (value_of(found, parameter) - none));
  }
  return joint;
}

std::vector<calibration::FittedParameter> numbers_of(const Effect& effect, const Imperfections& joint,
                                                     const Mechanism& expected) {
  std::vector<calibration::FittedParameter> numbers;
  for (const EffectParameter& parameter : effect.parameters) {
    calibration::FittedParameter number;
    number.name = parameter.name;
    number.value = shown_value(parameter, joint, expected);
    numbers.push_back(number);
  }
  return numbers;
}

/// Largest change of the sensed angle, rad.
double largest_change(const RehearsedShare& share) {
  double most = 0;
  for (const auto* direction : {&share.rising, &share.falling}) {
    for (const std::vector<double>& stroke : *direction) {
      for (const double angle : stroke) most = std::isfinite(angle) ? std::max(most, std::abs(angle)) : most;
    }
  }
  return most;
}

RehearsedEffect rehearsed(const Effect& effect, const DeclaredMechanism& expected, const Imperfections& found,
                          const std::vector<Drive>& drives) {
  RehearsedEffect result{effect.name, {}};
  for (const double share : k_rehearsed_shares) {
    const Imperfections joint = share_of(effect, found, share);
    RehearsedShare rehearsed_share{numbers_of(effect, joint, expected), {}, {}};
    for (const Drive& drive : drives) {
      Drive::DirectionalResponse response = drive.response_to(joint);
      rehearsed_share.rising.push_back(std::move(response.rising));
      rehearsed_share.falling.push_back(std::move(response.falling));
    }
    result.shares.push_back(std::move(rehearsed_share));
  }
  return result;
}

}  // namespace

Rehearsal rehearse(const DeclaredMechanism& expected, const measurement::Measurement& measurement,
                   const calibration::Calibration& calibration) {
  Rehearsal rehearsal;
  if (expected.transmission || calibration.effects.empty()) return rehearsal;
  profile::SynthesisResult synthesis = profile::synthesise(expected, {.advice = false, .stroke_steps = k_intervals});
  if (!synthesis.made()) return rehearsal;
  std::vector<double> alphas;
  for (const transmission::TransmissionPoint& point : synthesis.stroke) alphas.push_back(point.alpha);
  std::vector<Drive> drives;
  for (const double load : loads_of(measurement, expected)) {
    Mechanism loaded = expected;
    transmission::keep_law(loaded);
    loaded.load.tip_force = load;
    rehearsal.strokes.push_back({load, analysis::settled_stroke(loaded, alphas)});
    drives.emplace_back(expected, alphas, load);
  }
  for (const Effect& effect : effects(kind_of(expected))) {
    const bool found = std::any_of(calibration.effects.begin(), calibration.effects.end(),
                                   [&](const calibration::FoundEffect& one) { return one.name == effect.name; });
    if (!found) continue;
    RehearsedEffect one = rehearsed(effect, expected, calibration.identified, drives);
    if (largest_change(one.shares.back()) > k_least_influence) rehearsal.effects.push_back(std::move(one));
  }
  rehearsal.mechanism = expected;
  rehearsal.synthesis = std::move(synthesis);
  return rehearsal;
}

}  // namespace fusee::correction
