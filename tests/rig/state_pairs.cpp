#include "rig/state_pairs.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>

#include "fusee/base.h"

namespace fusee::rig {
namespace {

constexpr double k_noise = radians(0.02);
constexpr double k_least_seen = 3.0;  // noise rms
constexpr double k_most_seen = 15.0;
constexpr int k_rows_per_stroke = 30;  // few rows, and two cycles per run, so that many pairs can be tried
constexpr int k_attempts = 40;         // joints drawn for a pair
constexpr int k_iterations = 8;        // of the search for a size

struct BenchState {
  MadeJoint joint;
  HiddenFaults hidden;
};

/// A change whose effect grows with `size`.
struct SizedChange {
  double first = 0;
  double most = 0;
  std::function<void(BenchState&, double size)> apply;
};

SizedChange find_change(const std::string& name, Random& random) {
  const Character character{random.sign(), random.between(0.0, k_two_pi), random.share()};
  if (name == "pretension") {
    return {0.3, 0.9, [character](BenchState& state, double size) {
              state.joint.declared.tendon.pretension *= character.sign > 0 ? 1.0 + size : 1.0 - size;
            }};
  }
  const Fault& fault = find_fault(name);
  return {fault.first, fault.most, [&fault, character](BenchState& state, double size) {
            fault.set(state.hidden, size, character, state.joint);
          }};
}

std::vector<Log> logs_of(const BenchState& state, const std::vector<RunPlan>& plans, const SensorPlan& sensors) {
  MotionPlan motion;
  motion.rows_per_stroke = k_rows_per_stroke;
  return log_runs(state.joint, state.hidden, plans, sensors, motion);
}

/// Applies the change at the size that moves the reading by about `target`. Returns that movement, rms, rad; 0: none.
double apply_sized(const SizedChange& change, double target, const std::vector<RunPlan>& plans, BenchState& state) {
  const BenchState from = state;
  const std::vector<Log> without = logs_of(from, plans, noiseless());
  const SizedFault found = find_size(change.first, change.most, target, k_iterations, [&](double size) {
    state = from;
    change.apply(state, size);
    return rms_difference(logs_of(state, plans, noiseless()), without);
  });
  return found.is_met ? found.moved : 0;
}

using Paths = std::vector<std::filesystem::path>;

Paths write_runs(const std::vector<Log>& logs, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  Paths files;
  for (std::size_t run = 0; run < logs.size(); ++run) {
    files.push_back(folder / ("run_" + std::to_string(run + 1) + ".csv"));
    std::ofstream(files.back()) << csv_text(logs[run]);
  }
  return files;
}

bool try_pair(StatePair& pair, Random& random, std::uint64_t seed, const std::filesystem::path& folder) {
  BenchState state{random_joint(random), {}};
  state.hidden.groove_friction = 0.2;
  pair.joint = state.joint;
  std::vector<RunPlan> plans =
      full_protocol(std::round(state.joint.declared.tendon.pretension * (1.4 + 0.4 * random.share())));
  for (RunPlan& plan : plans) plan.cycles = 2;
  const auto target = [&] { return k_noise * std::exp(random.between(std::log(k_least_seen), std::log(k_most_seen))); };
  pair.common.clear();
  if (random.share() < 0.5) {
    const std::vector<std::string> all = changes_to_draw();
    pair.common = all[static_cast<std::size_t>(random.share() * static_cast<double>(all.size()))];
    if (pair.common == pair.change) return false;
    if (apply_sized(find_change(pair.common, random), target(), plans, state) == 0) return false;
  }
  BenchState after = state;
  pair.seen = 0;
  if (pair.change != "nothing") {
    pair.seen = apply_sized(find_change(pair.change, random), target(), plans, after) / k_noise;
    if (pair.seen < 0.85 * k_least_seen || pair.seen > 1.3 * k_most_seen) return false;
    // In half of the pairs the cause disappears.
    if (random.share() < 0.5) std::swap(state, after);
  }
  SensorPlan sensors = usual_sensors(seed);
  sensors.seed = 2 * seed;
  const std::vector<Log> first = logs_of(state, plans, sensors);
  sensors.seed = 2 * seed + 1;
  const std::vector<Log> second = logs_of(after, plans, sensors);
  if (rms_difference(first, second) == 0) return false;
  Paths files = write_runs(first, folder / "before");
  pair.runs.before = measurement::read_measurement(files, pair.joint.declared);
  const Paths later = write_runs(second, folder / "after");
  pair.runs.after = measurement::read_measurement(later, pair.joint.declared);
  files.insert(files.end(), later.begin(), later.end());
  pair.runs.both = measurement::read_measurement(files, pair.joint.declared);
  return true;
}

}  // namespace

std::vector<std::string> changes_to_draw() {
  return {"pretension",   "slack",        "tendon_stretch",  "capstan_friction", "backlash",       "zero_offset",
          "motor_offset", "pulley_scale", "radius_offset",   "pulley_runout",    "joint_friction", "joint_sensor_gain",
          "gravity",      "sensor_lag",   "groove_friction", "guide_position"};
}

StatePair make_pair(const std::string& change, std::uint64_t seed, const std::filesystem::path& folder) {
  Random random = numbered(static_cast<double>(seed), 41);
  StatePair pair;
  pair.change = change;
  pair.effect = change == "pretension" ? "slack" : change;
  for (int attempt = 0; attempt < k_attempts; ++attempt) {
    if (try_pair(pair, random, seed, folder)) return pair;
  }
  throw InputError("rig", "no joint was found on which " + change + " is well seen");
}

}  // namespace fusee::rig
