// What faults do on the rig and in fusee's forward model, which share no equation: each fault's own part of the
// reading, with the truth's numbers in both.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <ostream>
#include <string>

#include "fusee/joint/joint_model.h"
#include "fusee/joint/simulate.h"
#include "fusee/mechanism/file.h"
#include "rig/rig.h"
#include "rig/string_geometry.h"
#include "support/mechanisms.h"

namespace fusee::rig {
namespace {

struct SameFault {
  const char* name;
  void (*hide)(Hidden&);
  void (*say)(Imperfections&);
  double share;  ///< of the action that may be missed, rms: what was measured, and a little room
};

void PrintTo(const SameFault& fault, std::ostream* out) { *out << fault.name; }

/// A motor's wave as the rig writes it: amplitude (sin(n α + phase) − sin phase).
constexpr double k_wave = radians(0.4), k_phase = 0.7;

const std::vector<SameFault> k_faults{
    {"as_declared_but_for_stretch", [](Hidden& h) { h.modulus = 5000; },
     [](Imperfections& at) { at.tendon.stretch = 8000.0 / 5000.0 - 1; }, 0.004},
    {"motor_sensor_harmonic",
     [](Hidden& h) { h.motor_harmonic = k_wave, h.motor_harmonic_phase = k_phase, h.motor_harmonic_order = 3; },
     [](Imperfections& at) {
       at.motor.wave_sin = k_wave * std::cos(k_phase), at.motor.wave_cos = k_wave * std::sin(k_phase);
       at.motor.wave_order = 3;
     },
     0.001},
    {"joint_sensor_harmonic",
     [](Hidden& h) { h.joint_harmonic = k_wave, h.joint_harmonic_phase = k_phase, h.joint_harmonic_order = 2; },
     [](Imperfections& at) {
       at.sensor.wave_sin = k_wave * std::cos(k_phase), at.sensor.wave_cos = k_wave * std::sin(k_phase);
     },
     0.001},
    {"delay", [](Hidden& h) { h.lag = 0.05; }, [](Imperfections& at) { at.sensor.lag = 0.05; }, 0.004},
    {"filter", [](Hidden& h) { h.lag_filter = 0.05; },
     [](Imperfections& at) { at.sensor.lag = 0.05, at.sensor.first_order = 1; }, 0.004},
    {"left_pin", [](Hidden& h) { h.pin_outward[0] = 1.2, h.pin_down[0] = -0.6; },
     [](Imperfections& at) {
       at.pins.left = {1.2, -0.6};
     },
     0.012},
    {"right_pin", [](Hidden& h) { h.pin_outward[1] = -0.8, h.pin_down[1] = 1.0; },
     [](Imperfections& at) {
       at.pins.right = {-0.8, 1.0};
     },
     0.004},
    {"frame_compliance", [](Hidden& h) { h.frame_give = 5e-3; }, [](Imperfections& at) { at.pins.give = 5e-3; }, 0.01},
    {"soft_frame", [](Hidden& h) { h.frame_give = 0.04; }, [](Imperfections& at) { at.pins.give = 0.04; }, 0.01},
    {"joint_friction", [](Hidden& h) { h.bearing = 60; }, [](Imperfections& at) { at.joint.friction = 60; }, 0.015},
    {"creep", [](Hidden& h) { h.creep = 0.15; }, [](Imperfections& at) { at.tendon.creep = 0.15; }, 0.08},
    {"slack", [](Hidden& h) { h.slack = 1.0; },
     [](Imperfections& at) { at.tendon.slack = 1.0, at.tendon.pretension = -5; }, 0.002},
};

class Same : public ::testing::TestWithParam<SameFault> {};

std::vector<double> flat(const std::vector<Log>& logs) {
  std::vector<double> theta;
  for (const Log& log : logs) {
    for (const Row& row : log) theta.push_back(row.theta);
  }
  return theta;
}

std::vector<double> flat(const Readings& readings) {
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

/// Holds a fault's part of the reading, and the whole reading, by the rig against the model's.
void expect_same(const DeclaredMechanism& declared, const SameFault& fault, double load) {
  const MadeJoint joint = make_joint(declared);
  Hidden hidden;
  fault.hide(hidden);
  SensorPlan silent;
  silent.noise = 0;
  MotionPlan motion;
  motion.rows_per_stroke = 60;
  motion.loaded_first = true;  // as the model, which does not know what happened before a run, comes to its first row
  const std::vector<RunPlan> runs = full_protocol(load);
  const std::vector<Log> faulty = log_runs(joint, hidden, runs, silent, motion);
  BenchLog log;
  for (const Log& run : faulty) {
    BenchRun& bench = log.emplace_back();
    bench.has_load = true;
    for (const Row& row : run) bench.rows.push_back({row.time, row.alpha, row.load, row.temperature});
  }
  Imperfections at;
  fault.say(at);
  const std::vector<double> shown = less(flat(faulty), flat(log_runs(joint, {}, runs, silent, motion)));
  const std::vector<double> said = less(flat(predict(declared, at, log)), flat(predict(declared, {}, log)));
  const double size = rms(shown, std::vector<double>(shown.size(), 0.0));
  const double miss = rms(shown, said);
  EXPECT_GT(degrees(size), 0.01);
  EXPECT_LT(miss, fault.share * size) << degrees(size) << " deg, missed " << degrees(miss);
  EXPECT_LT(degrees(rms(flat(faulty), flat(predict(declared, at, log)))), 0.005);
}

TEST_P(Same, FaultDoesTheSameInBoth) {
  DeclaredMechanism declared = testing::forearm();
  declared.tendon.modulus = 8000;
  expect_same(declared, GetParam(), 10);
}

/// Of the joints that people build, each with a load that its tendons bear beside their pretension.
struct WideFault {
  const char* profile;
  double load;
  SameFault fault;
};

void PrintTo(const WideFault& fault, std::ostream* out) { *out << fault.profile << " " << fault.fault.name; }

void make_drum_larger(Hidden& h) { h.drum_radius = 0.15; }
void say_drum_larger(Imperfections& at) { at.joint.drum.radius = 0.15; }
void put_drum_off(Hidden& h) { h.drum_runout = 0.12, h.drum_runout_phase = 0.8; }
void say_drum_off(Imperfections& at) {
  at.joint.drum.across = 0.12 * std::cos(0.8), at.joint.drum.along = 0.12 * std::sin(0.8);
}
void put_drum_further_off(Hidden& h) { h.drum_runout = 0.4, h.drum_runout_phase = 4.5; }
void say_drum_further_off(Imperfections& at) {
  at.joint.drum.across = 0.4 * std::cos(4.5), at.joint.drum.along = 0.4 * std::sin(4.5);
}
void move_ends(Hidden& h) { h.end_moved = {Vec2(1.0, -0.7), Vec2(-0.6, 0.9)}; }
void say_ends_moved(Imperfections& at) {
  at.joint.end1 = {1.0, -0.7};
  at.joint.end2 = {-0.6, 0.9};
}
void rub_idlers(Hidden& h) { h.bearing_friction = 0.8; }
void say_idlers_rub(Imperfections& at) { at.pins.bearing_friction = 0.8; }

void rub_in_sheaths(Hidden& h) { h.sheath_friction = 0.2; }
void say_sheaths_rub(Imperfections& at) { at.sheath.friction = 0.2; }
void slide_in_sheaths(Hidden& h) { h.sheath_friction = -0.15; }
void say_sheaths_slide(Imperfections& at) { at.sheath.friction = -0.15; }
void soften_sheaths(Hidden& h) { h.sheath_give = 0.015; }
void say_sheaths_soft(Imperfections& at) { at.sheath.give = 0.015; }

const std::vector<WideFault> k_wide_faults{
    {"finger_mcp", 0.7, {"drum_radius", make_drum_larger, say_drum_larger, 0.02}},
    {"finger_mcp", 0.7, {"drum_runout", put_drum_off, say_drum_off, 0.02}},
    {"finger_mcp", 0.7, {"drum_further_off", put_drum_further_off, say_drum_further_off, 0.02}},
    {"finger_pip", 0.8, {"drum_radius", make_drum_larger, say_drum_larger, 0.02}},
    {"finger_pip", 0.8, {"drum_runout", put_drum_off, say_drum_off, 0.02}},
    {"finger_pip", 0.8, {"attachments", move_ends, say_ends_moved, 0.02}},
    {"ankle_exo", 20, {"attachments", move_ends, say_ends_moved, 0.02}},
    {"elbow_idlers", 2.5, {"drum_radius", make_drum_larger, say_drum_larger, 0.02}},
    {"elbow_idlers", 2.5, {"drum_runout", put_drum_off, say_drum_off, 0.02}},
    {"elbow_idlers", 2.5, {"attachments", move_ends, say_ends_moved, 0.02}},
    {"elbow_idlers", 2.5, {"idler_friction", rub_idlers, say_idlers_rub, 0.05}},
    {"wrist_sheath", 2, {"sheath_friction", rub_in_sheaths, say_sheaths_rub, 0.05}},
    {"wrist_sheath", 2, {"sheath_slippery", slide_in_sheaths, say_sheaths_slide, 0.05}},
    {"wrist_sheath", 2, {"sheath_stiffness", soften_sheaths, say_sheaths_soft, 0.05}},
    {"wrist_sheath",
     2,
     {"pulley_scale", [](Hidden& h) { h.pulley_scale = 0.01; }, [](Imperfections& at) { at.pulley.scale = 0.01; },
      0.02}},
};

class SameWide : public ::testing::TestWithParam<WideFault> {};

TEST_P(SameWide, FaultDoesTheSameInBoth) {
  const std::string file = std::string(FUSEE_SOURCE_DIR) + "/profiles/" + GetParam().profile + ".toml";
  DeclaredMechanism declared = read_mechanism(file).mechanism;
  declared.load = {};
  expect_same(declared, GetParam().fault, GetParam().load);
}

INSTANTIATE_TEST_SUITE_P(Fault, SameWide, ::testing::ValuesIn(k_wide_faults), [](const auto& fault) {
  return std::string(fault.param.profile) + "_" + fault.param.fault.name;
});

/// A string wound on the polygon that was made, against the model's paths: what is free and what lies on the pulley.
struct Wound {
  double free = 0;
  double on_pulley = 0;
};

Wound wound_string(const MadeJoint& joint, Side side, double alpha) {
  const DeclaredMechanism& declared = joint.declared;
  const double sign = mirror_sign(side);
  Polygon corners;
  for (const OutlinePoint& point : (side == Side::left ? joint.p1 : joint.p2).points)
    corners.push_back(Vec2(side == Side::left ? -point.position.x() : point.position.x(), point.position.y()));
  const Hull hull = hull_of(corners);
  const Vec2 pin(side == Side::left ? declared.guides.EB : declared.guides.ED, declared.pulley.EF);
  const double radius = declared.guides.radius + 0.5 * declared.tendon.diameter;
  std::ptrdiff_t corner = first_look(hull, {pin, radius});
  LowerString string;
  for (int i = 0; i <= 40; ++i) {
    const double c = std::cos(sign * alpha * i / 40), s = std::sin(sign * alpha * i / 40);
    string = lower_string(hull, {{c * pin.x() - s * pin.y(), s * pin.x() + c * pin.y()}, radius}, corner);
    corner = string.corner;
  }
  return {string.length, string.arc};
}

TEST(Paths, EndWhereAWoundStringDoes) {
  const MadeJoint joint = make_joint(testing::forearm());
  const JointModel model = joint_model(joint.declared);
  // Of a curve of this radius a corner is that far from the next: a string meets the one before or after.
  constexpr double corners = 0.1;
  for (const double share : {-1.0, -0.5, 0.5, 1.0}) {
    const double alpha = share > 0 ? share * joint.alpha_max : -share * joint.alpha_min;
    for (const Side side : {Side::left, Side::right}) {
      const std::size_t i = side == Side::left ? 0 : 1;
      const Wound home = wound_string(joint, side, 0.0), there = wound_string(joint, side, alpha);
      const LowerPath from = model.lower(0.0)[i], to = model.lower(alpha)[i];
      EXPECT_NEAR(to.wound - from.wound, there.on_pulley - home.on_pulley, corners) << i << " " << alpha;
      EXPECT_NEAR(to.reach, there.free, corners) << i << " " << alpha;
      EXPECT_NEAR(to.wound - from.wound + to.reach - from.reach,
                  there.on_pulley - home.on_pulley + there.free - home.free, 1e-4);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Fault, Same, ::testing::ValuesIn(k_faults),
                         [](const auto& fault) { return std::string(fault.param.name); });

}  // namespace
}  // namespace fusee::rig
