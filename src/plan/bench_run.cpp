#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "fusee/plan.h"
#include "joint/joint_effects.h"
#include "plan/thresholds.h"

namespace fusee::plan {
namespace {

constexpr double k_quarter_turn = 0.25 * k_two_pi;
/// Least time between two rows of a dwell, s.
constexpr double k_dwell_step = 2.0;

double seconds_of_stroke(const PlannedRun& run) { return std::abs(run.to - run.from) / run.speed; }

/// "slow", or the speed. `slow`: the speed that is called slow, rad/s.
std::string pace_words(const PlannedRun& run, double slow) {
  const double pace = run.speed / slow;
  if (std::abs(pace - 1) < 0.01) return "slow";
  return rounded(degrees(run.speed), 3) + " deg/s";
}

std::string load_words(const PlannedRun& run, const std::string& load_unit) {
  if (run.load == 0) return "without load";
  const std::string amount = rounded(run.load, 3);
  return load_unit.empty() ? "at load " + amount : "at " + amount + " " + load_unit;
}

}  // namespace

std::string_view words(BenchChange change) {
  switch (change) {
    case BenchChange::motor_sensor_turned:
      return "turn the motor's encoder on its shaft by a quarter turn";
    case BenchChange::joint_sensor_turned:
      return "turn the joint's encoder on its axis by a quarter turn";
    case BenchChange::none:
      break;
  }
  return "";
}

joint::Mounting mounting_of(BenchChange change) {
  return {change == BenchChange::motor_sensor_turned ? k_quarter_turn : 0.0,
          change == BenchChange::joint_sensor_turned ? k_quarter_turn : 0.0};
}

double setup_minutes_of(const PlannedRun& run) {
  return (run.load != 0 ? k_bench_minutes.load : 0.0) +
         (run.change != BenchChange::none ? k_bench_minutes.mounting : 0.0);
}

double minutes_of(const PlannedRun& run) { return run.cycles * 2 * (seconds_of_stroke(run) + run.dwell) / 60.0; }

std::string words(const PlannedRun& run, double slow, const std::string& load_unit) {
  std::string text = std::to_string(run.cycles) + (run.cycles == 1 ? " cycle, " : " cycles, ") + pace_words(run, slow) +
                     ", " + load_words(run, load_unit);
  if (run.dwell > 0) text += ", held for " + rounded(run.dwell, 3) + " s at both ends";
  if (run.change != BenchChange::none) text = std::string(words(run.change)) + ", set home again: " + text;
  return text;
}

joint::BenchRun driven(const PlannedRun& run, int rows_a_stroke) {
  joint::BenchRun driven;
  driven.has_load = true;
  driven.mounting = mounting_of(run.change);
  const double step = seconds_of_stroke(run) / rows_a_stroke;
  const int dwell_rows = static_cast<int>(run.dwell / k_dwell_step);
  double time = 0;
  const auto add_row = [&](double alpha) { driven.rows.push_back({time, alpha, run.load, 0}); };
  add_row(run.from);
  for (int stroke = 0; stroke < 2 * run.cycles; ++stroke) {
    const double start = stroke % 2 == 0 ? run.from : run.to;
    const double end = stroke % 2 == 0 ? run.to : run.from;
    for (int i = 1; i <= rows_a_stroke; ++i) {
      time += step;
      add_row(std::lerp(start, end, static_cast<double>(i) / rows_a_stroke));
    }
    for (int i = 0; i < dwell_rows; ++i) {
      time += run.dwell / dwell_rows;
      add_row(end);
    }
  }
  return driven;
}

std::string_view NextMeasurement::kind() const {
  if (run) return run->change == BenchChange::none ? "run" : "turn_sensor";
  return readings.empty() ? "inspect" : word(readings.front()->by_hand.tool);
}

std::string NextMeasurement::text() const { return gain.empty() ? words : words + ": it distinguishes " + gain; }

NextMeasurement next_run(const PlannedRun& run, double slow, const std::string& load_unit) {
  NextMeasurement next;
  next.run = run;
  next.words = (run.change == BenchChange::none ? "drive " : "") + words(run, slow, load_unit);
  next.minutes = minutes_of(run) + setup_minutes_of(run);
  return next;
}

std::string reading_words(const fusee::EffectParameter& reading) {
  std::string text(reading.by_hand.words);
  const std::string key(reading.by_hand.key);
  const std::size_t at = text.find(key);
  if (key.empty() || at == std::string::npos) return text;
  return text.insert(at + key.size(), " = [value, uncertainty]");
}

NextMeasurement next_reading(const std::vector<const fusee::EffectParameter*>& readings) {
  NextMeasurement next;
  next.readings = readings;
  for (const fusee::EffectParameter* reading : readings)
    next.words += (next.words.empty() ? "" : "; ") + reading_words(*reading);
  next.minutes = k_bench_minutes.reading * static_cast<double>(readings.size());
  return next;
}

NextMeasurement next_inspection(const std::string& words) {
  NextMeasurement next;
  next.words = words;
  next.minutes = k_bench_minutes.inspection;
  return next;
}

double rms_apart(const std::vector<std::vector<double>>& one, const std::vector<std::vector<double>>& other) {
  double squares = 0, rows = 0;
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

std::vector<const fusee::EffectParameter*> unread_numbers(const DeclaredMechanism& declared) {
  std::vector<const fusee::EffectParameter*> unread;
  if (declared.transmission) return unread;
  for (const Effect* effect : joint::effects_of(declared)) {
    for (const fusee::EffectParameter& parameter : effect->parameters) {
      if (!parameter.by_hand.words.empty() && parameter.by_hand.readings(declared).empty())
        unread.push_back(&parameter);
    }
  }
  return unread;
}

}  // namespace fusee::plan
