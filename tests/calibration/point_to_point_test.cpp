// Joints measured at dwells of the motor, by a rig that shares no code with the fit. Such logs have no rows in motion.
#include <gmock/gmock.h>

#include <algorithm>

#include "base/text.h"
#include "fusee/calibration.h"
#include "fusee/mechanism_file.h"
#include "rig/bench.h"
#include "rig/random.h"

namespace fusee::calibration {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

/// Dwell of the motor: its place, load and rows.
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

/// Dwells up the range and down again; at each the load is put on and taken off in steps.
Stops load_staircase(int rows) {
  Stops stops;
  for (const double share : {-0.8, -0.4, 0.0, 0.4, 0.8, 0.4, 0.0, -0.4, -0.8}) {
    for (const double load : {0.0, 1.0, 2.0, 3.0, 2.0, 1.0, 0.0}) stops.push_back({share, load, rows});
  }
  return stops;
}

/// Alternates between the ends, at one load after another.
Stops alternating_ends(int rows) {
  Stops stops;
  for (int i = 0; i < 40; ++i)
    stops.push_back({i % 2 == 0 ? -0.85 : 0.85, 1.0 * static_cast<double>(i / 10 % 3), rows});
  return stops;
}

/// Moves between dwells, up and down at three loads.
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

/// Three cycles without dwells.
Stops sweep(double share) {
  Stops stops;
  for (int i = 0; i < 360; ++i) stops.push_back({share * (std::abs(i % 120 - 60) / 30.0 - 1), 0.0, 1});
  return stops;
}

/// Six cycles over five angles. `loads`: number of loads that the cycles take in turn.
Stops cycles_at(int loads, int rows) {
  Stops stops;
  for (int cycle = 0; cycle < 6; ++cycle) {
    for (const double share : {-0.9, -0.45, 0.0, 0.45, 0.9, 0.45, 0.0, -0.45})
      stops.push_back({share, 3.0 * static_cast<double>(cycle % loads) / (loads - 1), rows});
  }
  return stops;
}
Stops few_repeats(int rows) { return cycles_at(2, rows); }
Stops no_repeats(int rows) { return cycles_at(6, rows); }

/// Log of the bench; between stops it moves and loads in small steps that are not logged.
std::string log_of(const Stops& stops, const rig::HiddenFaults& hidden, std::uint64_t seed, double noise = 0.02) {
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
  measurement::Measurement measurement;
  for (std::size_t i = 0; i < logs.size(); ++i)
    measurement.runs.push_back(
        measurement::parse_run(logs[i], "run_" + std::to_string(i + 1) + ".csv", {}, measurement));
  measurement::compare_with_declared(joint().declared, measurement);
  return calibrate(joint().declared, measurement);
}

std::vector<std::string> names_of(const Calibration& found) {
  std::vector<std::string> names;
  for (const FoundEffect& effect : found.effects) names.insert(names.end(), effect.group.begin(), effect.group.end());
  return names;
}

rig::HiddenFaults soft() {
  rig::HiddenFaults hidden;
  hidden.modulus = 0.3 * joint().declared.tendon.modulus;
  return hidden;
}

rig::HiddenFaults loose() {
  rig::HiddenFaults hidden;
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
                                {"steps of single rows", steps, 1},
                                {"few repeats of single rows", few_repeats, 1},
                                {"no repeats of single rows", no_repeats, 1}};

TEST(PointToPoint, DeclaredJointHasNoFalsePositive) {
  for (const Protocol& protocol : k_protocols) {
    const Calibration found = calibrated({log_of(protocol.stops(protocol.rows), {}, 5)});
    EXPECT_NE(found.verdict, CalibrationVerdict::not_testable) << protocol.name << ": " << found.summary;
    EXPECT_THAT(names_of(found), IsEmpty()) << protocol.name;
    // Single rows have too few repeats for a better estimate.
    EXPECT_NEAR(degrees(found.noise.rms), 0.02, protocol.rows > 1 ? 0.002 : 0.01) << protocol.name;
    EXPECT_LT(degrees(found.before.rms), 0.023) << protocol.name;
  }
}

TEST(PointToPoint, AcceptsDeclaredJointWithFewRows) {
  for (const Protocol& protocol : k_protocols) {
    if (protocol.rows > 1) continue;
    // Regression: the ends in turn were reported as not_repeatable with seed 2, few repeats as unexplained with both.
    for (const std::uint64_t seed : {2, 3}) {
      const Calibration found = calibrated({log_of(protocol.stops(protocol.rows), {}, seed)});
      EXPECT_EQ(found.verdict, CalibrationVerdict::no_effect) << protocol.name << ", " << seed << ": " << found.summary;
    }
  }
}

TEST(PointToPoint, DetectsStretchBetweenLoads) {
  for (const Protocol& protocol : k_protocols) {
    if (protocol.stops == alternating_ends) continue;  // ReportsNoSingleCauseFromTwoPlaces
    const Calibration found = calibrated({log_of(protocol.stops(protocol.rows), soft(), 5)});
    EXPECT_THAT(names_of(found), Contains("tendon_stretch")) << protocol.name << ": " << found.summary;
    EXPECT_LT(found.after.rms, 0.6 * found.before.rms) << protocol.name;
  }
}

TEST(PointToPoint, DetectsPlayBetweenApproachDirections) {
  for (const Protocol& protocol : k_protocols) {
    if (protocol.stops == alternating_ends) continue;  // ReportsNoSingleCauseFromTwoPlaces
    const Calibration found = calibrated({log_of(protocol.stops(protocol.rows), loose(), 5)});
    EXPECT_THAT(names_of(found), Contains("backlash")) << protocol.name << ": " << found.summary;
    EXPECT_LT(found.after.rms, 0.2 * found.before.rms) << protocol.name;
  }
}

struct Ends {
  rig::HiddenFaults (*hidden)();
  const char* name;
  const char* factor;  ///< first word of the factor on which the discrepancy depends
};

// At two places any smooth error has two numbers, so no cause is reported alone. Each place is also approached from one
// side only, and two places show no harmonic.
TEST(PointToPoint, ReportsNoSingleCauseFromTwoPlaces) {
  for (const Ends& ends : {Ends{loose, "backlash", "place"}, Ends{soft, "tendon_stretch", "load"}}) {
    const Calibration found = calibrated({log_of(alternating_ends(20), ends.hidden(), 5)});
    for (const FoundEffect& effect : found.effects) {
      EXPECT_GT(effect.group.size(), 1u) << found.summary;
      EXPECT_THAT(effect.group, Contains(ends.name));
    }
    const auto tried = std::find_if(found.tried.begin(), found.tried.end(),
                                    [&](const Candidate& candidate) { return candidate.name == ends.name; });
    ASSERT_NE(tried, found.tried.end()) << ends.name;
    EXPECT_GT(tried->evidence, 0) << ends.name;
    if (!found.effects.empty()) continue;
    EXPECT_EQ(found.verdict, CalibrationVerdict::unexplained) << found.summary;
    ASSERT_FALSE(found.discrepancy.empty()) << ends.name;
    EXPECT_THAT(found.discrepancy.front().factor, StartsWith(ends.factor));
    EXPECT_THAT(tried->why,
                AnyOf("it adds less than a report requires", StartsWith("with it rows that were not fitted")));
  }
}

std::vector<std::string> next_words(const Calibration& calibration) {
  std::vector<std::string> words;
  for (const plan::NextMeasurement& next : calibration.next) words.push_back(next.words);
  return words;
}

const char* const k_both_sides = "approach each dwell from both sides";

TEST(PointToPoint, RequestsApproachFromBothSides) {
  EXPECT_THAT(next_words(calibrated({log_of(alternating_ends(20), loose(), 5)})), Contains(StartsWith(k_both_sides)));
  EXPECT_THAT(next_words(calibrated({log_of(steps(6), {}, 5)})), Not(Contains(StartsWith(k_both_sides))));
  Stops up;
  for (int i = 0; i < 7; ++i) up.push_back({-0.9 + 0.3 * i, 0.0, 6});
  EXPECT_THAT(next_words(calibrated({log_of(up, {}, 5)})), Contains(StartsWith(k_both_sides)));
  EXPECT_THAT(next_words(calibrated({log_of(up, {}, 5), log_of(sweep(0.95), {}, 6)})),
              Not(Contains(StartsWith(k_both_sides))));
  EXPECT_THAT(next_words(calibrated({log_of(up, {}, 5), log_of(sweep(0.2), {}, 6)})),
              Contains(StartsWith(k_both_sides)));
  Stops few = alternating_ends(1);
  few.resize(8);
  const Calibration too_few = calibrated({log_of(few, {}, 5)});
  EXPECT_EQ(too_few.verdict, CalibrationVerdict::not_testable) << too_few.summary;
  EXPECT_THAT(next_words(too_few), Contains(StartsWith(k_both_sides)));
}

TEST(PointToPoint, HoldsOutLoadLevelsWithinRun) {
  EXPECT_THAT(calibrated({log_of(load_staircase(8), {}, 5)}).held_out_factors, ElementsAre("load"));
}

}  // namespace
}  // namespace fusee::calibration
