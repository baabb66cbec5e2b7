// Joints measured at held motor angles, by a rig that shares no code with the fit: what a reader of strokes would
// refuse.
#include <gmock/gmock.h>

#include <algorithm>

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

/// Where the motor is held, under what load, for how many rows.
struct Stop {
  double share = 0;  ///< of the declared range of α, −1 … 1
  double load = 0;   ///< N
  int rows = 1;
};
using Stops = std::vector<Stop>;

const rig::MadeJoint& joint() {
  static const rig::MadeJoint made =
      rig::make_joint(read_mechanism(std::string(FUSEE_SOURCE_DIR) + "/tests/data/rig/b_stretch/spec.toml").mechanism);
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
  for (int i = 0; i < 40; ++i)
    stops.push_back({i % 2 == 0 ? -0.85 : 0.85, 1.0 * static_cast<double>(i / 10 % 3), rows});
  return stops;
}

/// Between held angles, up and down at three loads.
Stops steps(int rows) {
  Stops stops;
  for (const double load : {0.0, 1.5, 3.0}) {
    for (int cycle = 0; cycle < 3; ++cycle) {
      for (const double share : {-0.9, -0.6, -0.3, 0.0, 0.3, 0.6, 0.9, 0.6, 0.3, 0.0, -0.3, -0.6})
        stops.push_back({share, load, rows});
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
  int rows;  ///< at each stop
};
const Protocol k_protocols[] = {{"load staircase", load_staircase, 8},
                                {"ends in turn", alternating_ends, 20},
                                {"steps", steps, 6},
                                {"staircase of single rows", load_staircase, 1},
                                {"ends of single rows", alternating_ends, 1},
                                {"steps of single rows", steps, 1}};

TEST(PointToPoint, a_joint_as_declared_is_blamed_for_nothing) {
  for (const Protocol& protocol : k_protocols) {
    const Calibration found = calibrated({log_of(protocol.stops(protocol.rows), {}, 5)});
    EXPECT_NE(found.verdict, CalibrationVerdict::not_testable) << protocol.name << ": " << found.summary;
    EXPECT_THAT(names_of(found), IsEmpty()) << protocol.name;
    // Single rows repeat too rarely to know it better.
    EXPECT_NEAR(degrees(found.noise.rms), 0.02, protocol.rows > 1 ? 0.002 : 0.007) << protocol.name;
    EXPECT_LT(degrees(found.before.rms), 0.023) << protocol.name;
  }
}

TEST(PointToPoint, soft_tendons_show_between_loads) {
  for (const Protocol& protocol : k_protocols) {
    if (protocol.stops == alternating_ends) continue;  // at two places any shape may stand for it
    const Calibration found = calibrated({log_of(protocol.stops(protocol.rows), soft(), 5)});
    EXPECT_THAT(names_of(found), Contains("tendon_stretch")) << protocol.name;
    EXPECT_LT(found.after.rms, 0.6 * found.before.rms) << protocol.name;
  }
}

TEST(PointToPoint, play_shows_between_the_sides_that_a_place_was_come_to_from) {
  for (const Protocol& protocol : k_protocols) {
    if (protocol.stops == alternating_ends) continue;  // each place is come to from one side only
    const Calibration found = calibrated({log_of(protocol.stops(protocol.rows), loose(), 5)});
    EXPECT_THAT(names_of(found), Contains("backlash")) << protocol.name;
    EXPECT_LT(found.after.rms, 0.2 * found.before.rms) << protocol.name;
  }
}

// Where each place is come to from one side only, play could be shape as well, of any kind: it is not named alone.
TEST(PointToPoint, ends_alone_do_not_name_play_alone) {
  const Calibration found = calibrated({log_of(alternating_ends(20), loose(), 5)});
  EXPECT_THAT(found.verdict, testing::AnyOf(CalibrationVerdict::confounded, CalibrationVerdict::unexplained));
  for (const FoundEffect& effect : found.effects) EXPECT_GT(effect.group.size(), 1u) << effect.name;
}

TEST(PointToPoint, loads_within_a_run_are_held_out) {
  EXPECT_THAT(calibrated({log_of(load_staircase(8), {}, 5)}).held_out_factors, ElementsAre("load"));
}

}  // namespace
}  // namespace fusee
