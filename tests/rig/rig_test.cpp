// The rig agrees with geometry of circles, virtual work, hand calculation, the target motion, and data of another rig.
#include "rig/rig.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "fusee/joint.h"
#include "fusee/measurement.h"
#include "fusee/mechanism_file.h"
#include "fusee/transmission.h"
#include "rig/bench.h"
#include "rig/random.h"
#include "rig/string_geometry.h"
#include "rig/test_joints.h"
#include "rig/truths.h"
#include "transmission/load.h"

namespace fusee::rig {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// One unloaded run.
Log run_of(const MadeJoint& joint, const HiddenFaults& hidden, const SensorPlan& sensors = noiseless()) {
  return log_runs(joint, hidden, single_protocol(), sensors).front();
}

// ---- strings --------------------------------------------------------------------------------------------------------

Polygon circle(double radius, int corners) {
  Polygon polygon;
  for (int i = 0; i < corners; ++i) polygon.push_back(radius * unit(k_two_pi * i / corners));
  return polygon;
}

TEST(String, WindsOnCircle) {
  const Hull hull = hull_of(circle(7.0, 20000));
  const Circle pin{{15.0, 40.0}, 2.0};
  const LowerString string = lower_string(hull, pin, initial_corner(hull, pin));
  const double c = pin.centre.norm();
  EXPECT_NEAR(string.length, std::sqrt(c * c - 25.0), 5e-3);  // a corner may lie half a side off
  EXPECT_NEAR(string.arm, 7.0, 1e-6);
  EXPECT_NEAR(std::atan2(string.normal.y(), string.normal.x()), std::atan2(40.0, 15.0) - std::acos(5.0 / c), 2e-4);
  EXPECT_NEAR(hull.around, 7.0 * k_two_pi, 1e-5);
}

TEST(String, CountsWholeTurns) {
  const Hull hull = hull_of(circle(7.0, 720));
  const Circle pin{{15.0, 40.0}, 2.0};
  const LowerString once = lower_string(hull, pin, initial_corner(hull, pin));
  const LowerString later = lower_string(hull, pin, once.corner + 3 * 720);
  EXPECT_NEAR(later.arc - once.arc, 3 * hull.around, 1e-10);
  const LowerString earlier = lower_string(hull, pin, once.corner - 720);
  EXPECT_NEAR(earlier.arc - once.arc, -hull.around, 1e-10);
}

TEST(String, BridgesHollow) {
  Polygon notched = circle(10.0, 360);
  for (std::size_t i = 20; i < 40; ++i) notched[i] *= 0.9;
  EXPECT_NEAR(hull_of(notched).around, hull_of(circle(10.0, 360)).around, 0.05);
  EXPECT_LT(hull_of(notched).corners.size(), 345u);
}

TEST(String, RejectsPinWithinPulley) {
  const Hull hull = hull_of(circle(7.0, 360));
  EXPECT_THROW(lower_string(hull, {{1.0, 2.0}, 1.0}, 0), InputError);
}

// ---- the joint as declared ------------------------------------------------------------------------------------------

/// Stiff and without friction.
DeclaredMechanism ideal(DeclaredMechanism mechanism) {
  mechanism.guides.mu = 0;
  mechanism.tendon.modulus = 1e8;
  return mechanism;
}

TEST(Rig, FollowsTargetMotion) {
  for (const DeclaredMechanism& mechanism : {testing::forearm(), testing::unsymmetric(), testing::linear_wrist()}) {
    const DeclaredMechanism rigid = ideal(mechanism);
    const transmission::Transmission law(rigid);
    for (const Row& row : run_of(make_joint(rigid), {})) {
      ASSERT_NEAR(row.theta, law.theta(row.alpha), 2e-6) << mechanism.name << " at " << degrees(row.alpha) << " deg";
    }
  }
}

/// α, θ and load of each row; deg, deg, N.
std::vector<std::array<double, 3>> read_log(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  std::vector<std::array<double, 3>> rows;
  while (std::getline(file, line)) {
    std::array<double, 4> values{};
    EXPECT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf", &values[0], &values[1], &values[2], &values[3]), 4);
    rows.push_back({values[1], values[2], values[3]});
  }
  return rows;
}

/// Rms difference of this rig without noise from data of another rig with 0.02° of noise, deg. The first row of a run
/// is omitted, since its history is unknown.
double difference(const std::string& name, const HiddenFaults& hidden, const std::vector<RunPlan>& plans) {
  const std::filesystem::path folder = std::filesystem::path(FUSEE_SOURCE_DIR) / "tests/data/rig" / name;
  const std::vector<Log> logs =
      log_runs(make_joint(read_mechanism(folder / "spec.toml").mechanism), hidden, plans, noiseless());
  double squares = 0;
  double rows = 0;
  for (std::size_t run = 0; run < logs.size(); ++run) {
    const auto other = read_log(folder / ("run_" + std::to_string(run + 1) + ".csv"));
    EXPECT_EQ(other.size(), logs[run].size());
    for (std::size_t row = 1; row < std::min(logs[run].size(), other.size()); ++row) {
      EXPECT_NEAR(degrees(logs[run][row].alpha), other[row][0], 1e-4);
      EXPECT_EQ(logs[run][row].load, other[row][2]);
      const double miss = degrees(logs[run][row].theta) - other[row][1];
      squares += miss * miss;
      rows += 1;
    }
  }
  return std::sqrt(squares / rows);
}

TEST(Rig, AgreesWithAnotherRig) {
  HiddenFaults soft, lash, small;
  soft.modulus = 9000;
  lash.backlash = radians(2.4);
  small.pulley_scale = -0.02;
  EXPECT_LT(difference("a_declared_right", {}, full_protocol(6)), 0.0204);
  EXPECT_LT(difference("b_stretch", soft, full_protocol(6)), 0.0204);
  EXPECT_LT(difference("c_backlash", lash, full_protocol(14)), 0.0207);
  EXPECT_LT(difference("e_one_sweep_only", small, single_protocol()), 0.0206);
  EXPECT_GT(difference("b_stretch", {}, full_protocol(6)), 0.1) << "the rig ignores its faults";
}

// ---- faults, by hand ------------------------------------------------------------------------------------------------

Log unloaded(const HiddenFaults& hidden) { return run_of(stiff(), hidden); }

TEST(Fault, EncoderInterpolationAdds) {
  const Log plain = unloaded({});
  const HiddenFaults hidden{.interpolation = 0.001};
  const Log log = unloaded(hidden);
  for (std::size_t row = 0; row < log.size(); ++row)
    EXPECT_NEAR(log[row].theta, plain[row].theta + 0.001 * std::sin(8 * plain[row].theta), 1e-12);
}

TEST(Fault, CoggingTurnsShaft) {
  const transmission::Transmission law(stiff().declared);
  const HiddenFaults hidden{.cogging = 0.004};
  for (const Row& row : unloaded(hidden))
    EXPECT_NEAR(row.theta, law.theta(row.alpha + 0.004 * std::sin(30 * row.alpha)), 3e-6);
}

/// No slip in the groove: only the free spans are compliant.
HiddenFaults held(HiddenFaults hidden = {}) {
  hidden.groove_friction = 1e3;
  return hidden;
}
/// No friction in the groove: the tendon slides up to the knot.
HiddenFaults sliding(HiddenFaults hidden = {}) {
  hidden.groove_friction = 0;
  return hidden;
}

/// θ at home under a tip force.
double theta_under(Bench& bench, double load) {
  Conditions at;
  at.load = load;
  return bench.to(0.0, 0.0, at);
}
double theta_under(const MadeJoint& joint, const HiddenFaults& hidden, double load) {
  Bench bench(joint, hidden);
  return theta_under(bench, load);
}

/// Both tendons taut, no friction.
DeclaredMechanism elastic() {
  DeclaredMechanism mechanism = testing::forearm();
  mechanism.guides.mu = 0;
  mechanism.tendon.pretension = 20;
  return mechanism;
}

/// Rotational stiffness at home by constant moment arms: Σ EA m²/l, N·mm/rad.
double stiffness_by_hand(const DeclaredMechanism& mechanism, double modulus) {
  const transmission::TransmissionPoint home = transmission::Transmission(mechanism).at_alpha(0.0);
  const double EA = modulus * 0.25 * k_pi * mechanism.tendon.diameter * mechanism.tendon.diameter;
  return EA * (home.t1.m * home.t1.m / home.t1.length + home.t2.m * home.t2.m / home.t2.length);
}

TEST(Fault, PulleyBedsIn) {
  const transmission::Transmission law(stiff().declared);
  const HiddenFaults hidden{.bedding = 0.02};
  const Log log = unloaded(hidden);
  const double half_stroke = 0.5 * (log[80].alpha - log[0].alpha);
  for (const std::size_t row : {0u, 40u, 80u, 160u, 320u}) {
    const double travel = half_stroke * static_cast<double>(row) / 40.0;
    EXPECT_NEAR(log[row].theta, law.theta(log[row].alpha + 0.02 * std::exp(-travel / half_stroke)), 3e-6) << row;
  }
}

TEST(Fault, ZeroWalksAtReversals) {
  const Log plain = unloaded({});
  const HiddenFaults hidden{.zero_walk = 0.01};
  const Log log = unloaded(hidden);
  const auto off = [&](std::size_t row) { return log[row].theta - plain[row].theta; };
  for (std::size_t stroke = 0; stroke < 4; ++stroke) {
    EXPECT_NEAR(off(80 * stroke + 1), off(80 * stroke + 79), 1e-12);
    if (stroke > 0) {
      EXPECT_GT(std::abs(off(80 * stroke + 1) - off(80 * stroke - 1)), 1e-5);
    }
  }
}

TEST(Fault, LoadStretchesTendons) {
  const MadeJoint joint = make_joint(elastic());
  for (const double modulus : {40000.0, 10000.0}) {
    Bench bench(joint, held({.modulus = modulus}));
    EXPECT_NEAR(theta_under(bench, 0.0), 0.0, 1e-9);
    const double by_hand = 3.0 * 100.0 / stiffness_by_hand(joint.declared, modulus);
    EXPECT_NEAR(theta_under(bench, 3.0), -by_hand, 0.01 * by_hand);
    EXPECT_GT(bench.tendon(1).upper_tension, 20.0);
    EXPECT_LT(bench.tendon(0).upper_tension, 20.0);
    EXPECT_NEAR(theta_under(bench, 0.0), 0.0, 1e-9) << "without friction the joint returns";
  }
}

TEST(Fault, GrooveFrictionStiffens) {
  const MadeJoint joint = make_joint(elastic());
  const transmission::TransmissionPoint home = transmission::Transmission(joint.declared).at_alpha(0.0);
  const double EA = section_stiffness(joint.declared.tendon);
  const auto under_load = [&](double friction) { return -theta_under(joint, {.groove_friction = friction}, 3.0); };
  double stiffness = 0;
  const Bench bench(joint, sliding());
  for (const std::size_t side : {0u, 1u}) {
    const transmission::TendonPoint& tendon = side == 0 ? home.t1 : home.t2;
    stiffness += EA * tendon.m * tendon.m / (tendon.length + bench.tendon(side).laid.length());
  }
  const double longer = 300.0 / stiffness;
  EXPECT_NEAR(under_load(0.0), longer, 0.01 * longer);
  EXPECT_NEAR(under_load(1e3), 300.0 / stiffness_by_hand(joint.declared, joint.declared.tendon.modulus), 0.01 * longer);
  EXPECT_LT(under_load(0.2), 0.9 * longer);
  EXPECT_GT(under_load(0.2), 1.01 * under_load(1e3));
}

TEST(Fault, SlipTurnsJoint) {
  const MadeJoint joint = make_joint(elastic());
  Bench bench(joint, sliding());
  Conditions at;
  at.load = 60.0;  // tendon 1 is slack
  const double before = bench.to(0.0, 0.0, at);
  EXPECT_EQ(bench.tendon(0).upper_tension, 0.0);
  const double arm = transmission::Transmission(joint.declared).at_theta(before).t2.m;
  at.let_go[1] = 0.2;
  EXPECT_NEAR(before - bench.to(0.0, 0.0, at), 0.2 / arm, 0.01 * 0.2 / arm);
}

TEST(Fault, PinFrictionReachesCapstanRatio) {
  DeclaredMechanism declared = testing::forearm();
  declared.guides.mu = 0.3;
  const MadeJoint joint = make_joint(declared);
  Bench bench(joint, {});
  Conditions at;
  const transmission::Transmission law(declared);
  for (int step = 1; step <= 60; ++step) {
    const double alpha = 0.01 * step;
    bench.to(alpha, alpha, at);
    const transmission::TransmissionPoint point = law.at_theta(bench.theta());
    for (const std::size_t side : {0u, 1u}) {
      const double limit = 0.3 * (side == 0 ? point.t1.wrap : point.t2.wrap);
      const double used = std::log(bench.tendon(side).lower_tension / bench.tendon(side).upper_tension);
      EXPECT_LE(std::abs(used), limit * 1.0001);
      // Tendon 2 is pulled down over its pin, tendon 1 is pulled up.
      if (step > 30) {
        EXPECT_NEAR(used, side == 1 ? limit : -limit, 1e-3 * limit);
      }
    }
  }
}

/// Work of motor and load over the second of two cycles of ±0.5 rad under 5 N.
struct CycleWork {
  double motor = 0, load = 0;
};
CycleWork work_of_a_cycle(const MadeJoint& joint, const HiddenFaults& hidden) {
  Bench bench(joint, hidden);
  const auto motor_torque = [&](double alpha) {
    double torque = 0;
    for (const std::size_t side : {0u, 1u}) {
      const BenchTendon& tendon = bench.tendon(side);
      const Vec2 pin = tendon.pin.centre - tendon.axis;
      const double turn = tendon.sign * alpha;
      const Circle seen{
          {std::cos(turn) * pin.x() - std::sin(turn) * pin.y(), std::sin(turn) * pin.x() + std::cos(turn) * pin.y()},
          tendon.pin.radius};
      torque += tendon.sign * tendon.lower_tension * lower_string(tendon.hull, seen, tendon.corner).arm;
    }
    return torque;
  };
  constexpr int quarter = 200;
  const auto alpha_at = [](int step) { return 0.5 * std::sin(0.5 * k_pi * step / quarter); };
  CycleWork work;
  Conditions at;
  at.load = 5.0;
  bench.to(0.0, 0.0, at);
  for (int step = 1; step <= 8 * quarter; ++step) {
    const double before = motor_torque(alpha_at(step - 1));
    const double theta = bench.theta();
    bench.to(alpha_at(step), alpha_at(step), at);
    if (step <= 4 * quarter) continue;
    work.motor += 0.5 * (before + motor_torque(alpha_at(step))) * (alpha_at(step) - alpha_at(step - 1));
    work.load += at.load * 100.0 * (bench.theta() - theta);
  }
  return work;
}

TEST(Fault, PinFrictionDissipatesWork) {
  const MadeJoint joint = make_joint(elastic());
  for (const double mu : {0.0, 0.2}) {
    const HiddenFaults hidden{.friction = mu};
    const CycleWork work = work_of_a_cycle(joint, held(hidden));
    EXPECT_NEAR(work.load, 0.0, 1e-3);
    // Both tendons over their pins, four times the swing a cycle.
    const transmission::TransmissionPoint home = transmission::Transmission(joint.declared).at_alpha(0.0);
    const double swing = transmission::Transmission(joint.declared).theta(0.5);
    const double by_hand = 20.0 * mu * (home.t1.wrap * home.t1.m + home.t2.wrap * home.t2.m) * 4.0 * swing;
    EXPECT_NEAR(work.motor, by_hand, 0.1 * by_hand + 0.05);
  }
}

TEST(Fault, StickingBearingHolds) {
  const MadeJoint joint = make_joint(elastic());
  Bench bench(joint, held({.bearing = 100, .bearing_stick = 50}));
  EXPECT_EQ(theta_under(bench, 1.4), 0.0);  // 140 N mm
  const double by_hand = (300.0 - 150.0) / stiffness_by_hand(joint.declared, joint.declared.tendon.modulus);
  EXPECT_NEAR(theta_under(bench, 3.0), -by_hand, 0.01 * by_hand);
}

TEST(Fault, HardeningTendonMeetsDeclaredStiffness) {
  const MadeJoint joint = make_joint(elastic());
  Bench hard(joint, {.hardening = 1e-3}), plain(joint, {});
  EXPECT_NEAR(theta_under(hard, 0.0), 0.0, 1e-9);
  EXPECT_NEAR(theta_under(hard, 0.5) / theta_under(plain, 0.5), 1.0, 0.01);
  EXPECT_LT(theta_under(hard, 60.0) / theta_under(plain, 60.0), 0.95);
}

TEST(Fault, LumpMovesJointLocally) {
  const HiddenFaults hidden{.lump = 0.1, .lump_at = radians(40), .lump_width = radians(5)};
  const transmission::Transmission law(stiff().declared);
  const double arm = law.at_alpha(radians(40)).t2.m;
  double most = 0, far = 0;
  for (const Row& row : unloaded(hidden)) {
    const double moved = row.theta - law.theta(row.alpha);
    double& where = std::abs(row.alpha - radians(40)) > radians(25) ? far : most;
    where = std::max(where, std::abs(moved));
  }
  EXPECT_NEAR(most, 0.1 / arm, 0.06 * 0.1 / arm);
  EXPECT_LT(far, 3e-6);
}

// ---- sensors and protocols ------------------------------------------------------------------------------------------

TEST(Random, IsSplitmix64) {
  Random random(0);
  EXPECT_EQ(random.bits(), 0xE220A8397B1DCDAFULL);
  EXPECT_EQ(random.bits(), 0x6E789E6AA1B965F4ULL);
}

struct NoiseFigures {
  double rms = 0, lag1 = 0;
};

NoiseFigures noise_of(const SensorPlan& sensors) {
  const Log plain = unloaded({});
  const Log noisy = run_of(stiff(), {}, sensors);
  double squares = 0, products = 0;
  for (std::size_t row = 0; row < plain.size(); ++row) {
    const double now = noisy[row].theta - plain[row].theta;
    squares += now * now;
    if (row > 0) products += now * (noisy[row - 1].theta - plain[row - 1].theta);
  }
  return {std::sqrt(squares / static_cast<double>(plain.size())), products / squares};
}

TEST(Sensors, NoiseHasSizeAndColour) {
  SensorPlan sensors;
  const NoiseFigures white = noise_of(sensors);
  EXPECT_NEAR(degrees(white.rms), 0.02, 0.0025);
  EXPECT_NEAR(white.lag1, 0.0, 0.15);
  sensors.colour = 0.8;
  const NoiseFigures coloured = noise_of(sensors);
  EXPECT_NEAR(degrees(coloured.rms), 0.02, 0.005);
  EXPECT_NEAR(coloured.lag1, 0.8, 0.1);
}

TEST(Sensors, CoarseSensorHasSteps) {
  SensorPlan sensors;
  sensors.quantum = radians(0.05);
  for (const Row& row : run_of(stiff(), {}, sensors)) {
    const double steps = degrees(row.theta) / 0.05;
    EXPECT_NEAR(steps, std::round(steps), 1e-9);
  }
}

TEST(Rig, IsRepeatable) {
  const HiddenFaults hidden{.zero_walk = 0.001};
  SensorPlan sensors;
  const auto text = [&] { return csv_text(run_of(stiff(), hidden, sensors), true); };
  const std::string once = text();
  EXPECT_EQ(once, text());
  sensors.seed = 2;
  EXPECT_NE(once, text());
}

TEST(Rig, RunFollowsPlan) {
  const Log log = log_runs(stiff(), {}, {{0.0, radians(30.0), 2, 4.0}}, noiseless())[0];
  ASSERT_EQ(log.size(), 1u + 4 * (80 + 10));
  EXPECT_NEAR((log[1].alpha - log[0].alpha) / (log[1].time - log[0].time), radians(30.0), 1e-9);
  EXPECT_EQ(log[80].alpha, log[90].alpha);
  EXPECT_NEAR(log[90].time - log[80].time, 4.0, 1e-9);
  EXPECT_LT(log[91].alpha, log[90].alpha);
}

TEST(Programme, StaircaseHoldsAnglesUnderEachLoad) {
  RunPlan plan;
  plan.manner = Manner::staircase;
  plan.levels = {0.0, 5.0, 10.0};
  plan.holds = 4;
  plan.cycles = 1;
  const Log log = rig::run_of({}, plan, soft());
  std::set<long> angles;
  for (const Row& row : log) angles.insert(std::lround(1e6 * row.alpha));
  EXPECT_EQ(angles.size(), 4u);
  // Seven holds there and back, five levels at each, three rows a level, and the first row.
  EXPECT_EQ(log.size(), 1u + 7 * 5 * 3);
  for (const double load : plan.levels)
    EXPECT_GT(std::count_if(log.begin(), log.end(), [&](const Row& row) { return row.load == load; }), 20);
  EXPECT_LT(log[12].theta, log[2].theta) << "the load turns the joint back";
}

TEST(Programme, EndsAlternate) {
  RunPlan plan;
  plan.manner = Manner::ends;
  plan.holds = 3;
  plan.cycles = 1;
  const Log log = rig::run_of({}, plan, stiff());
  ASSERT_EQ(log.size(), 1u + 2 * 3 * 3);
  for (std::size_t i = 1; i < log.size(); i += 6) {
    EXPECT_LT(log[i].alpha, 0.0);
    EXPECT_GT(log[i + 3].alpha, 0.0);
  }
  EXPECT_LT(log.back().alpha, log[4].alpha);
}

TEST(Programme, LoadChangesBetweenCycles) {
  RunPlan plan;
  plan.cycles = 2;
  plan.levels = {0.0, 6.0};
  const Log log = rig::run_of({}, plan, soft());
  EXPECT_EQ(log[100].load, 0.0);
  EXPECT_EQ(log[163].load, 6.0);
  EXPECT_EQ(log[161].alpha, log[160].alpha) << "the motor stands while the load is hung";
}

TEST(Programme, RandomIsWithinBoundsAndRepeatable) {
  std::set<std::size_t> runs;
  std::set<Manner> manners;
  for (std::uint64_t seed = 1; seed < 60; ++seed) {
    Random random(seed), again(seed);
    const Programme one = random_programme(random, stiff());
    const Programme two = random_programme(again, stiff());
    EXPECT_EQ(one.runs.size(), two.runs.size());
    EXPECT_EQ(one.sensors.noise, two.sensors.noise);
    EXPECT_GE(degrees(one.sensors.noise), 0.005);
    EXPECT_LE(degrees(one.sensors.noise), 0.05);
    runs.insert(one.runs.size());
    for (const RunPlan& run : one.runs) manners.insert(run.manner);
  }
  EXPECT_EQ(*runs.begin(), 2u);
  EXPECT_EQ(*runs.rbegin(), 7u);
  EXPECT_EQ(manners.size(), 3u);
}

TEST(Rig, FilesAreReadByFusee) {
  const std::vector<Log> logs = log_runs(stiff(), {}, full_protocol(6.0));
  measurement::Measurement measurement;
  const fusee::measurement::Run run = measurement::parse_run(csv_text(logs[1], true), "run_2.csv", {}, measurement);
  EXPECT_EQ(run.samples.size(), logs[1].size());
  EXPECT_TRUE(run.has_time && run.has_load && run.has_temperature);
  EXPECT_EQ(run.strokes.size(), 6u);
  EXPECT_NEAR(run.mean_load, 6.0, 1e-9);
  EXPECT_NEAR(degrees(run.speed), 12.0, 0.01);
}

TEST(Rig, SharesNoEquationWithProduct) {
  for (const char* name : {"string_geometry.h", "string_geometry.cpp", "groove_chain.h", "groove_chain.cpp", "bench.h",
                           "bench.cpp", "rig.h", "rig.cpp"}) {
    std::ifstream file(std::filesystem::path(FUSEE_SOURCE_DIR) / "tests/rig" / name);
    std::stringstream text;
    text << file.rdbuf();
    EXPECT_THAT(text.str(), HasSubstr("namespace fusee::rig")) << name;
    EXPECT_THAT(text.str(), Not(HasSubstr("calibration/"))) << name;
    EXPECT_THAT(text.str(), Not(HasSubstr("transmission/"))) << name;
  }
}

}  // namespace
}  // namespace fusee::rig
