// The rig and fusee's forward model, which share no equation, agree on the effect of each fault on the reading.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>

#include "fusee/joint.h"
#include "fusee/mechanism_file.h"
#include "rig/rig.h"
#include "support/mechanisms.h"

namespace fusee::rig {
namespace {

struct SameFault {
  const char* name;
  void (*hide)(HiddenFaults&);
  void (*imitate)(Imperfections&);
  double share;  ///< largest difference per effect, rms: the measured one with a margin
};

void PrintTo(const SameFault& fault, std::ostream* out) { *out << fault.name; }

/// A motor's wave as the rig writes it: amplitude (sin(n α + phase) − sin phase).
constexpr double k_wave = radians(0.4), k_phase = 0.7;

// clang-format off
const std::vector<SameFault> k_faults{
    {"as_declared_but_for_stretch", [](HiddenFaults& h) { h.modulus = 5000; }, [](Imperfections& at) { at.tendon.stretch = 8000.0 / 5000.0 - 1; }, 0.004},
    {"motor_sensor", [](HiddenFaults& h) { h.motor_offset = 0.01, h.motor_eccentricity = 0.02, h.motor_eccentricity_phase = k_phase; },
     [](Imperfections& at) { at.motor = {0.01, 0.02 * std::cos(k_phase), 0.02 * std::sin(k_phase)}; }, 0.001},
    {"motor_sensor_harmonic", [](HiddenFaults& h) { h.motor_harmonic = k_wave, h.motor_harmonic_phase = k_phase, h.motor_harmonic_order = 3; },
     [](Imperfections& at) { at.motor = {0, 0, 0, k_wave * std::cos(k_phase), k_wave * std::sin(k_phase), 3}; }, 0.001},
    {"backlash", [](HiddenFaults& h) { h.backlash = 0.03; }, [](Imperfections& at) { at.shaft.backlash = 0.03; }, 0.004},
    {"joint_sensor", [](HiddenFaults& h) { h.zero = 0.01, h.gain = 0.02, h.joint_eccentricity = 0.003, h.joint_eccentricity_phase = 0.4; },
     [](Imperfections& at) {
       at.sensor.zero = 0.01, at.sensor.gain = 0.02;
       at.sensor.eccentricity_sin = 0.003 * std::cos(0.4), at.sensor.eccentricity_cos = 0.003 * std::sin(0.4);
     }, 0.001},
    {"joint_sensor_harmonic", [](HiddenFaults& h) { h.joint_harmonic = k_wave, h.joint_harmonic_phase = k_phase, h.joint_harmonic_order = 2; },
     [](Imperfections& at) { at.sensor.wave_sin = k_wave * std::cos(k_phase), at.sensor.wave_cos = k_wave * std::sin(k_phase); }, 0.001},
    {"delay", [](HiddenFaults& h) { h.lag = 0.05; }, [](Imperfections& at) { at.sensor.lag = 0.05; }, 0.004},
    {"filter", [](HiddenFaults& h) { h.lag_filter = 0.05; }, [](Imperfections& at) { at.sensor.lag = 0.05, at.sensor.first_order = 1; }, 0.004},
    {"radius_offset", [](HiddenFaults& h) { h.radius_offset = 0.3; }, [](Imperfections& at) { at.pulley.outline.offset = 0.3; }, 0.01},
    {"pulley_scale", [](HiddenFaults& h) { h.pulley_scale = -0.02; }, [](Imperfections& at) { at.pulley.scale = -0.02; }, 0.01},
    {"pulley_runout", [](HiddenFaults& h) { h.runout_x = 0.3, h.runout_y = -0.2; },
     [](Imperfections& at) { at.pulley.outline.runout_x = 0.3, at.pulley.outline.runout_y = -0.2; }, 0.01},
    {"profile_error", [](HiddenFaults& h) { h.profile_error = 0.2, h.profile_harmonic = 3, h.profile_phase = 0.5; },
     [](Imperfections& at) { at.pulley.outline = {0, 0, 0, -0.2 * std::sin(0.5), 0.2 * std::cos(0.5), 3}; }, 0.01},
    {"guide_radius", [](HiddenFaults& h) { h.guide_radius = 1.0; }, [](Imperfections& at) { at.pins.radius = 1.0; }, 0.01},
    {"left_pin", [](HiddenFaults& h) { h.pin_outward[0] = 1.2, h.pin_down[0] = -0.6; }, [](Imperfections& at) { at.pins.left = {1.2, -0.6}; }, 0.012},
    {"right_pin", [](HiddenFaults& h) { h.pin_outward[1] = -0.8, h.pin_down[1] = 1.0; }, [](Imperfections& at) { at.pins.right = {-0.8, 1.0}; }, 0.004},
    {"frame_compliance", [](HiddenFaults& h) { h.frame_compliance = 5e-3; }, [](Imperfections& at) { at.pins.compliance = 5e-3; }, 0.01},
    {"soft_frame", [](HiddenFaults& h) { h.frame_compliance = 0.04; }, [](Imperfections& at) { at.pins.compliance = 0.04; }, 0.01},
    {"joint_length", [](HiddenFaults& h) { h.joint_length = 1.5; }, [](Imperfections& at) { at.joint.length = 1.5; }, 0.01},
    {"joint_friction", [](HiddenFaults& h) { h.bearing = 60; }, [](Imperfections& at) { at.joint.friction = 60; }, 0.015},
    {"gravity", [](HiddenFaults& h) { h.gravity = 300, h.gravity_direction = 0.8; }, [](Imperfections& at) { at.joint.weight = {300 * std::sin(0.8), -300 * std::cos(0.8)}; }, 0.01},
    {"thermal_expansion", [](HiddenFaults& h) { h.expansion = 1e-4; }, [](Imperfections& at) { at.tendon.thermal1 = 0.3e-4, at.tendon.thermal2 = 1e-4; }, 0.02},
    {"creep", [](HiddenFaults& h) { h.creep = 0.15; }, [](Imperfections& at) { at.tendon.creep = 0.15; }, 0.08},
    {"slack", [](HiddenFaults& h) { h.slack = 1.0; }, [](Imperfections& at) { at.tendon.slack = 1.0, at.tendon.pretension = -5; }, 0.002},
};
// clang-format on

class SameModel : public ::testing::TestWithParam<SameFault> {};

std::vector<double> flat(const std::vector<Log>& logs) {
  std::vector<double> theta;
  for (const Log& log : logs) {
    for (const Row& row : log) theta.push_back(row.theta);
  }
  return theta;
}

std::vector<double> flat(const joint::Readings& readings) {
  std::vector<double> theta;
  for (const std::vector<double>& run : readings) theta.insert(theta.end(), run.begin(), run.end());
  return theta;
}

double rms(const std::vector<double>& one, const std::vector<double>& other) {
  double squares = 0;
  for (std::size_t i = 0; i < one.size(); ++i) squares += (one[i] - other[i]) * (one[i] - other[i]);
  return std::sqrt(squares / static_cast<double>(one.size()));
}

std::vector<double> less(std::vector<double> one, const std::vector<double>& other) {
  for (std::size_t i = 0; i < one.size(); ++i) one[i] -= other[i];
  return one;
}

/// Compares a fault's effect on the reading, and the whole reading, of rig and model.
void expect_same(const DeclaredMechanism& declared, const SameFault& fault, double load) {
  const MadeJoint joint = make_joint(declared);
  HiddenFaults hidden;
  fault.hide(hidden);
  SensorPlan silent;
  silent.noise = 0;
  MotionPlan motion;
  motion.rows_per_stroke = 60;
  motion.loaded_first = true;  // as in the model, which knows no history before a run
  const std::vector<RunPlan> runs = full_protocol(load);
  const std::vector<Log> faulty = log_runs(joint, hidden, runs, silent, motion);
  joint::BenchLog log;
  for (const Log& run : faulty) {
    joint::BenchRun& bench = log.emplace_back();
    bench.has_load = bench.has_temperature = true;
    for (const Row& row : run) bench.rows.push_back({row.time, row.alpha, row.load, row.temperature});
  }
  Imperfections at;
  fault.imitate(at);
  const std::vector<double> simulated = less(flat(faulty), flat(log_runs(joint, {}, runs, silent, motion)));
  const std::vector<double> predicted =
      less(flat(joint::predict(declared, at, log)), flat(joint::predict(declared, {}, log)));
  const double size = rms(simulated, std::vector<double>(simulated.size(), 0.0));
  const double miss = rms(simulated, predicted);
  EXPECT_GT(degrees(size), 0.01);
  EXPECT_LT(miss, fault.share * size) << degrees(size) << " deg, missed " << degrees(miss);
  EXPECT_LT(degrees(rms(flat(faulty), flat(joint::predict(declared, at, log)))), 0.005);
}

TEST_P(SameModel, FaultActsAlike) {
  DeclaredMechanism declared = testing::forearm();
  declared.tendon.modulus = 8000;
  expect_same(declared, GetParam(), 10);
}

/// A fault on a joint of profiles/, with a load that its tendons bear.
struct WideFault {
  const char* profile;
  double load;
  SameFault fault;
};

void PrintTo(const WideFault& fault, std::ostream* out) { *out << fault.profile << " " << fault.fault.name; }

// clang-format off
const SameFault k_larger_drum{"drum_radius", [](HiddenFaults& h) { h.drum_radius = 0.15; }, [](Imperfections& at) { at.joint.drum.radius = 0.15; }, 0.02};
const SameFault k_drum_off{"drum_runout", [](HiddenFaults& h) { h.drum_runout = 0.12, h.drum_runout_phase = 0.8; },
                           [](Imperfections& at) { at.joint.drum = {0, 0.12 * std::cos(0.8), 0.12 * std::sin(0.8)}; }, 0.02};
const SameFault k_drum_further_off{"drum_further_off", [](HiddenFaults& h) { h.drum_runout = 0.4, h.drum_runout_phase = 4.5; },
                                   [](Imperfections& at) { at.joint.drum = {0, 0.4 * std::cos(4.5), 0.4 * std::sin(4.5)}; }, 0.02};
const SameFault k_moved_ends{"attachments", [](HiddenFaults& h) { h.end_moved = {Vec2(1.0, -0.7), Vec2(-0.6, 0.9)}; },
                             [](Imperfections& at) { at.joint.end1 = {1.0, -0.7}, at.joint.end2 = {-0.6, 0.9}; }, 0.02};

const std::vector<WideFault> k_wide_faults{
    {"finger_mcp", 0.7, k_larger_drum}, {"finger_mcp", 0.7, k_drum_off}, {"finger_mcp", 0.7, k_drum_further_off},
    {"finger_pip", 0.8, k_larger_drum}, {"finger_pip", 0.8, k_drum_off}, {"finger_pip", 0.8, k_moved_ends},
    {"elbow_idlers", 2.5, k_larger_drum}, {"elbow_idlers", 2.5, k_drum_off}, {"elbow_idlers", 2.5, k_moved_ends}, {"ankle_exo", 20, k_moved_ends},
    {"elbow_idlers", 2.5, {"idler_friction", [](HiddenFaults& h) { h.bearing_friction = 0.8; }, [](Imperfections& at) { at.pins.bearing_friction = 0.8; }, 0.05}},
    {"wrist_sheath", 2, {"sheath_friction", [](HiddenFaults& h) { h.sheath_friction = 0.2; }, [](Imperfections& at) { at.sheath.friction = 0.2; }, 0.05}},
    {"wrist_sheath", 2, {"sheath_slippery", [](HiddenFaults& h) { h.sheath_friction = -0.15; }, [](Imperfections& at) { at.sheath.friction = -0.15; }, 0.05}},
    {"wrist_sheath", 2, {"sheath_stiffness", [](HiddenFaults& h) { h.sheath_compliance = 0.015; }, [](Imperfections& at) { at.sheath.compliance = 0.015; }, 0.05}},
    {"wrist_sheath", 2, {"pulley_scale", [](HiddenFaults& h) { h.pulley_scale = 0.01; }, [](Imperfections& at) { at.pulley.scale = 0.01; }, 0.02}},
};
// clang-format on

class WideJoints : public ::testing::TestWithParam<WideFault> {};

TEST_P(WideJoints, FaultActsAlike) {
  const std::string file = std::string(FUSEE_SOURCE_DIR) + "/profiles/" + GetParam().profile + ".toml";
  DeclaredMechanism declared = read_mechanism(file).mechanism;
  declared.load = {};
  expect_same(declared, GetParam().fault, GetParam().load);
}

INSTANTIATE_TEST_SUITE_P(Fault, WideJoints, ::testing::ValuesIn(k_wide_faults), [](const auto& fault) {
  return std::string(fault.param.profile) + "_" + fault.param.fault.name;
});

INSTANTIATE_TEST_SUITE_P(Fault, SameModel, ::testing::ValuesIn(k_faults),
                         [](const auto& fault) { return std::string(fault.param.name); });

}  // namespace
}  // namespace fusee::rig
