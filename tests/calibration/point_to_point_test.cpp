// Joints measured at held motor angles, by a rig that shares no code with the fit: what a reader of strokes would refuse.
#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>

#include "fusee/base/text.h"
#include "fusee/calibration/calibration.h"
#include "fusee/mechanism/file.h"
#include "rig/bench.h"
#include "rig/random.h"

namespace fusee {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;

/// Where the motor is held, under what load, for how many rows.
struct Stop {
  double share = 0;  ///< of the declared range of α, −1 … 1
  double load = 0;   ///< N
  int rows = 1;
};
using Stops = std::vector<Stop>;

const rig::MadeJoint& joint() {
  static const rig::MadeJoint made = rig::make_joint(
      read_mechanism(std::string(FUSEE_SOURCE_DIR) + "/tests/data/rig/b_stretch/spec.toml").mechanism);
  return made;
}

/// Held angles with the load put on and taken off in steps at each, up the range and down again.
Stops load_staircase(int rows) {
  Stops stops;
  for (const double share : {-0.8, -0.4, 0.0, 0.4, 0.8, 0.4, 0.0, -0.4, -0.8}) {
    for (const double load : {0.0, 1.0, 2.0, 3.0, 2.0, 1.0, 0.0}) stops.push_back({share, load, rows});
  }
  return stops;
}

/// From end to end, at one load after another.
Stops alternating_ends(int rows) {
  Stops stops;
  for (int i = 0; i < 40; ++i) stops.push_back({i % 2 == 0 ? -0.85 : 0.85, 1.0 * static_cast<double>(i / 10 % 3), rows});
  return stops;
}

/// Between held angles, up and down at three loads.
Stops steps(int rows) {
  Stops stops;
  for (const double load : {0.0, 1.5, 3.0}) {
    for (int cycle = 0; cycle < 3; ++cycle) {
      for (const double share : {-0.9, -0.6, -0.3, 0.0, 0.3, 0.6, 0.9, 0.6, 0.3, 0.0, -0.3, -0.6}) stops.push_back({share, load, rows});
    }
  }
  return stops;
}

/// What the bench writes; between stops it moves and loads in small steps that are not logged.
std::string log_of(const Stops& stops, const rig::Hidden& hidden, std::uint64_t seed, double noise = 0.02) {
  constexpr int between = 30;
  rig::Bench bench(joint(), hidden);
  rig::Random random(seed);
  double alpha = 0, load = 0, time = 0, pulley = 0;
  const auto to = [&](double next_alpha, double next_load) {
    alpha = next_alpha;
    load = next_load;
    pulley = std::clamp(pulley, alpha - 0.5 * hidden.backlash, alpha + 0.5 * hidden.backlash);
    rig::Conditions at;
    at.load = load;
    return bench.to(pulley, alpha, at);
  };
  std::string text = "time_s,alpha_deg,theta_deg,load_N\n";
  for (const Stop& stop : stops) {
    const double goal = stop.share * (stop.share < 0 ? -joint().alpha_min : joint().alpha_max);
    const double from = alpha, before = load;
    for (int i = 1; i <= between; ++i) to(from + (goal - from) * i / between, before);
    for (int i = 1; i <= between; ++i) to(goal, before + (stop.load - before) * i / between);
    time += 1.0;
    for (int row = 0; row < stop.rows; ++row) {
      time += 0.1;
      text += shortest(time) + "," + shortest(degrees(goal)) + "," +
              shortest(degrees(to(goal, stop.load)) + noise * random.normal()) + "," + shortest(stop.load) + "\n";
    }
  }
  return text;
}

Calibration calibrated(const std::vector<std::string>& logs) {
  Measurement measurement;
  for (std::size_t i = 0; i < logs.size(); ++i)
    measurement.runs.push_back(parse_run(logs[i], "run_" + std::to_string(i + 1) + ".csv", {}, measurement));
  compare_with_declared(joint().declared, measurement);
  return calibrate(joint().declared, measurement);
}

std::vector<std::string> names_of(const Calibration& found) {
  std::vector<std::string> names;
  for (const FoundEffect& effect : found.effects) names.insert(names.end(), effect.group.begin(), effect.group.end());
  return names;
}

rig::Hidden soft() {
  rig::Hidden hidden;
  hidden.modulus = 0.3 * joint().declared.tendon.modulus;
  return hidden;
}

rig::Hidden loose() {
  rig::Hidden hidden;
  hidden.backlash = radians(1.5);
  return hidden;
}

struct Protocol {
  const char* name;
  Stops (*stops)(int rows);
  int rows;
};
const Protocol k_protocols[] = {{"staircase", load_staircase, 8}, {"ends", alternating_ends, 20}, {"steps", steps, 6},
                                {"staircase of single rows", load_staircase, 1}, {"steps of single rows", steps, 1}, {"ends of single rows", alternating_ends, 1}};

TEST(PointToPoint, Look) {
  for (const Protocol& protocol : k_protocols) {
    int which = 0;
    for (const rig::Hidden& hidden : {rig::Hidden{}, soft(), loose()}) {
      const std::string text = log_of(protocol.stops(protocol.rows), hidden, 5);
      if (std::getenv("DUMP")) std::ofstream(std::string(std::getenv("DUMP")) + "/" + protocol.name + std::to_string(which) + ".csv") << text;
      const Calibration found = calibrated({text});
      std::printf("%s %d: verdict %d floor %.4f repeats %d colour %.2f dof %.0f before %.4f after %.4f between %.3f\n   %s\n", protocol.name, which++,
                  static_cast<int>(found.verdict), degrees(found.noise.rms), found.noise.from_repeats, found.noise.colour, found.noise.degrees_of_freedom,
                  degrees(found.before.rms), degrees(found.after.rms), degrees(found.noise.between_runs), found.summary.c_str());
      for (const std::string& name : names_of(found)) std::printf("   - %s\n", name.c_str());
      for (const std::string& name : found.held_out_factors) std::printf("   factor %s\n", name.c_str());
    }
  }
}

}  // namespace
}  // namespace fusee
