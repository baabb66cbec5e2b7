#include "fusee/plan/bench_run.h"

#include <algorithm>
#include <cmath>

#include "fusee/base/text.h"
#include "fusee/joint/joint_effects.h"

namespace fusee {
namespace {

constexpr double k_quarter = 0.25 * k_two_pi;
/// Rows of a dwell come at this distance, s.
constexpr double k_dwell_step = 2.0;

double seconds_of_stroke(const PlannedRun& run) { return std::abs(run.to - run.from) / run.speed; }

std::string pace_words(const PlannedRun& run, double slow) {
  const double pace = run.speed / slow;
  if (std::abs(pace - 1) < 0.01) return "slow";
  return rounded(degrees(run.speed), 3) + " deg/s";
}

}  // namespace

std::string_view words(BenchChange change) {
  switch (change) {
    case BenchChange::motor_sensor_turned:
      return "turn the motor's encoder on its shaft by a quarter turn";
    case BenchChange::joint_sensor_turned:
      return "turn the joint's encoder on its axis by a quarter turn";
    case BenchChange::doubled_pretension:
      return "double the pretension";
    case BenchChange::on_its_side:
      return "lay the joint on its side";
    case BenchChange::none:
      break;
  }
  return "";
}

Mounting mounting_of(BenchChange change) {
  return {change == BenchChange::motor_sensor_turned ? k_quarter : 0.0,
          change == BenchChange::joint_sensor_turned ? k_quarter : 0.0};
}

ChangedJoint changed(const Mechanism& declared, const Imperfections& at, BenchChange change) {
  ChangedJoint joint{declared, at};
  if (change == BenchChange::doubled_pretension) joint.declared.tendon.pretension *= 2;
  if (change == BenchChange::on_its_side) joint.at.joint.weight = {};
  return joint;
}

double minutes_of(const PlannedRun& run) { return run.cycles * 2 * (seconds_of_stroke(run) + run.dwell) / 60.0; }

std::string words(const PlannedRun& run, double slow, const std::string& load_unit) {
  const std::string amount = rounded(run.load, 3);
  const std::string load = run.load == 0       ? "without load"
                           : load_unit.empty() ? "at load " + amount
                                               : "at " + amount + " " + load_unit;
  const std::string pace = pace_words(run, slow);
  std::string text = std::to_string(run.cycles) + (run.cycles == 1 ? " cycle, " : " cycles, ") + pace + ", " + load;
  if (run.dwell > 0) text += ", held for " + rounded(run.dwell, 3) + " s at both ends";
  if (run.change != BenchChange::none) text = std::string(words(run.change)) + ", set home again: " + text;
  return text;
}

BenchRun driven(const PlannedRun& run, int rows_a_stroke) {
  BenchRun driven;
  driven.has_load = true;
  driven.mounting = mounting_of(run.change);
  const double step = seconds_of_stroke(run) / rows_a_stroke;
  const int held = static_cast<int>(run.dwell / k_dwell_step);
  double time = 0;
  const auto log = [&](double alpha) { driven.rows.push_back({time, alpha, run.load, 0}); };
  log(run.from);
  for (int stroke = 0; stroke < 2 * run.cycles; ++stroke) {
    const double start = stroke % 2 == 0 ? run.from : run.to;
    const double end = stroke % 2 == 0 ? run.to : run.from;
    for (int i = 1; i <= rows_a_stroke; ++i) {
      time += step;
      log(std::lerp(start, end, static_cast<double>(i) / rows_a_stroke));
    }
    for (int i = 0; i < held; ++i) {
      time += run.dwell / held;
      log(end);
    }
  }
  return driven;
}

std::size_t RankedMeasurement::told() const {
  return static_cast<std::size_t>(std::count_if(margins.begin(), margins.end(), [](double m) { return m > 1; }));
}
double RankedMeasurement::most() const {
  return margins.empty() ? 0.0 : *std::max_element(margins.begin(), margins.end());
}

void rank(std::vector<RankedMeasurement>& measurements) {
  std::stable_sort(measurements.begin(), measurements.end(),
                   [](const RankedMeasurement& a, const RankedMeasurement& b) {
                     return a.told() != b.told() ? a.told() > b.told() : a.most() > b.most();
                   });
}

double rms_apart(const std::vector<std::vector<double>>& one, const std::vector<std::vector<double>>& other) {
  double squares = 0;
  double rows = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    for (std::size_t k = 0; k < one[i].size(); ++k) {
      const double difference = one[i][k] - other[i][k];
      if (!std::isfinite(difference)) continue;
      squares += difference * difference;
      rows += 1;
    }
  }
  return rows > 0 ? std::sqrt(squares / rows) : 0.0;
}

std::vector<const EffectParameter*> hand_readable(const Mechanism& declared) {
  std::vector<const EffectParameter*> readable;
  if (declared.transmission) return readable;
  for (const Effect* effect : effects_of(declared)) {
    for (const EffectParameter& parameter : effect->parameters) {
      if (!parameter.by_hand.words.empty()) readable.push_back(&parameter);
    }
  }
  return readable;
}

}  // namespace fusee
