#include <algorithm>
#include <cmath>

#include "fusee/base.h"
#include "fusee/correction.h"
#include "fusee/joint.h"
#include "mechanism/effect.h"
#include "transmission/load.h"

namespace fusee::correction {
namespace {

constexpr int k_places = 60;            ///< intervals of the stroke
constexpr double k_pace = radians(20);  ///< motor speed, 1/s: slow, as on a bench
constexpr double k_seen = radians(1e-3);

/// No load, and the largest logged loads in both directions; without logged loads the declared one.
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

/// A stroke there and back, driven twice; the second is evaluated.
class Drive {
 public:
  Drive(const Mechanism& expected, const std::vector<double>& alphas, double load)
      : expected_(expected), count_(alphas.size()) {
    joint::BenchRun run;
    run.has_load = true;
    double time = 0, at = 0;
    const auto go = [&](double alpha) {
      time += std::abs(alpha - at) / k_pace;
      at = alpha;
      joint::BenchRow row;
      row.time = time;
      row.alpha = alpha;
      row.load = load;
      run.rows.push_back(row);
    };
    for (auto alpha = alphas.rbegin(); alpha != alphas.rend(); ++alpha) {
      if (*alpha <= 0) go(*alpha);  // from home to the lower end
    }
    first_ = run.rows.size();
    for (int cycle = 0; cycle < 2; ++cycle) {
      std::for_each(alphas.begin(), alphas.end(), go);
      std::for_each(alphas.rbegin(), alphas.rend(), go);
    }
    log_ = {run};
    without_ = shown({});
  }

  struct DirectionalResponse {
    std::vector<double> rising, falling;  ///< rad
  };
  /// Change of the sensed angle by the given imperfections.
  DirectionalResponse response_to(const Imperfections& imperfections) const {
    const DirectionalResponse with = shown(imperfections);
    return {difference_of(with.rising, without_.rising), difference_of(with.falling, without_.falling)};
  }

 private:
  DirectionalResponse shown(const Imperfections& imperfections) const {
    const std::vector<double> theta = joint::predict(expected_, imperfections, log_).front();
    const auto from = theta.begin() + static_cast<std::ptrdiff_t>(first_ + 2 * count_);
    const auto turn = from + static_cast<std::ptrdiff_t>(count_);
    DirectionalResponse ways{{from, turn}, {turn, turn + static_cast<std::ptrdiff_t>(count_)}};
    std::reverse(ways.falling.begin(), ways.falling.end());
    return ways;
  }

  const Mechanism& expected_;
  std::size_t count_;
  std::size_t first_ = 0;
  joint::BenchLog log_;
  DirectionalResponse without_;
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

double largest(const RehearsedShare& share) {
  double most = 0;
  for (const auto* way : {&share.rising, &share.falling}) {
    for (const std::vector<double>& places : *way) {
      for (const double angle : places) most = std::isfinite(angle) ? std::max(most, std::abs(angle)) : most;
    }
  }
  return most;
}

RehearsedEffect rehearsed(const Effect& effect, const DeclaredMechanism& expected, const Imperfections& found,
                          const std::vector<Drive>& drives) {
  RehearsedEffect result{effect.name, {}};
  for (const double share : k_rehearsed_shares) {
    const Imperfections joint = share_of(effect, found, share);
    RehearsedShare shown{numbers_of(effect, joint, expected), {}, {}};
    for (const Drive& drive : drives) {
      Drive::DirectionalResponse ways = drive.response_to(joint);
      shown.rising.push_back(std::move(ways.rising));
      shown.falling.push_back(std::move(ways.falling));
    }
    result.shares.push_back(std::move(shown));
  }
  return result;
}

}  // namespace

Rehearsal rehearse(const DeclaredMechanism& expected, const measurement::Measurement& measurement,
                   const calibration::Calibration& calibration) {
  Rehearsal rehearsal;
  if (expected.transmission || calibration.effects.empty()) return rehearsal;
  profile::SynthesisResult synthesis = profile::synthesise(expected, {.advice = false, .stroke_steps = k_places});
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
    if (largest(one.shares.back()) > k_seen) rehearsal.effects.push_back(std::move(one));
  }
  rehearsal.mechanism = expected;
  rehearsal.synthesis = std::move(synthesis);
  return rehearsal;
}

}  // namespace fusee::correction
