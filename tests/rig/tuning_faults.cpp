#include <algorithm>
#include <cmath>

#include "rig/fault_shapes.h"
#include "rig/faults.h"

namespace fusee::rig {
namespace tuning_list {

using namespace short_names;

// ---- what acts ------------------------------------------------------------------------------------------------------

/// A gear whose teeth do not divide a turn of the motor: numbers amplitude, phase.
double gear_wave(const Moment& now, const N& n, N&) {
  return n[0] * (std::sin(3.7 * now.alpha + n[1]) - std::sin(n[1]));
}

/// A set screw that holds until the shaft has wound up by n[0], then jumps back by it.
double jumping_hub(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.alpha, 0.0};
  memory[1] += now.alpha - memory[0];
  memory[0] = now.alpha;
  memory[1] = std::fmod(memory[1], n[0]);
  return -memory[1];
}

/// Beyond n[0] rad/s of rising α the motor's counter loses n[1] of what it should count.
double lost_counts(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0};
  if (now.alpha_speed > n[0]) memory[0] += n[1] * now.alpha_speed * now.seconds;
  return memory[0];
}

/// From α = n[1] on tendon 2 winds on its own turns, further out by n[0].
double on_its_own_turns(const Moment& now, const N& n, N&) { return n[0] * std::max(0.0, now.alpha - n[1]); }

/// Tendon 2 climbs n[0] up its groove's flank at α = n[1], and only while it is wound in.
double climbing(const Moment& now, const N& n, N&) {
  return now.direction > 0 ? n[0] * bump((now.alpha - n[1]) / radians(6.0)) : 0.0;
}

/// A flat n[0] deep on tendon 2's pin, under the tendon about θ = n[1].
double flat(const Moment& now, const N& n, N&) {
  const double x = (now.theta - n[1]) / radians(6.0);
  return -n[0] * std::max(0.0, 1.0 - x * x);
}

/// A knot pulls tight by up to n[0] the first time it is pulled; n[1] N beyond home's tension for most of it.
template <std::size_t side>
double tightening(const Moment& now, const N& n, N& memory) {
  const double tension = now.tension[side];
  if (tension <= 0) return memory.empty() ? 0.0 : -n[0] * (1.0 - std::exp(-(memory[1] - memory[0]) / n[1]));
  if (memory.empty()) memory = {tension, tension};
  memory[1] = std::max(memory[1], tension);
  return -n[0] * (1.0 - std::exp(-(memory[1] - memory[0]) / n[1]));
}

/// The joint's axis lies against its hole, n[0] off the middle, where the forces push it.
template <std::size_t side>
double loose_axis(const Moment& now, const N& n, N& memory) {
  const Vec2 force = force_on_axis(now);
  if (force.norm() < 1e-9) return 0.0;
  const Vec2 push = force.normalized();
  if (memory.empty()) memory = {push.x(), push.y()};
  return nearer<side>(now, n[0] * (push - Vec2(memory[0], memory[1])));
}

/// Tendons tied to a ring that slides along the link: n[0] further out at half a radian.
template <std::size_t side>
double sliding_ring(const Moment& now, const N& n, N&) {
  const double out = n[0] * now.theta * now.theta / 0.25;
  return nearer<side>(now, out * Vec2(std::sin(now.theta), std::cos(now.theta)));
}

/// Grease in the joint: n[0] N·mm·s.
double grease(const Moment& now, const N& n, N&) { return -n[0] * now.theta_speed; }

/// A place in the bearing that rubs: n[0] N·mm at θ = n[1].
double rubbing_place(const Moment& now, const N& n, N&) { return n[0] * bump((now.theta - n[1]) / radians(4.0)); }

/// A sensor whose zero goes with its temperature: n[0] per K.
double warm_zero(const Moment& now, const N& n, N&) { return n[0] * now.warmth; }

/// A load cell that shows too little: the load is greater by the share n[0].
double wrong_cell(const Moment& now, const N& n, N&) { return n[0] * now.load; }

// ---- what is wrong --------------------------------------------------------------------------------------------------

// clang-format off
std::vector<Fault> drive_faults() {
  return {
      {.name = "motor_cogging", .first = 0.005, .most = 0.2,
       .set = [](H& h, double s, const C&, const J&) { h.cogging = s; },
       .kin = {"motor_sensor_harmonic"}},  // a wave of the motor's shaft
      {.name = "gearbox_error", .first = 0.005, .most = 0.2,
       .set = [](H& h, double s, const C& c, const J&) { h.shaft.push_back({"gear_wave", {s, c.angle}, gear_wave}); },
       .kin = {"motor_sensor_harmonic"}},  // over half a turn 3.7 a turn is four
      {.name = "jumping_hub", .first = 0.01, .most = 0.2,
       .set = [](H& h, double s, const C&, const J&) { h.shaft.push_back({"jumping_hub", {s}, jumping_hub}); },
       .kin = {"backlash"}},  // lost motion between shaft and pulley
      {.name = "lost_counts", .first = 1e-3, .most = 0.05,
       .set = [](H& h, double s, const C&, const J&) { h.shaft.push_back({"lost_counts", {radians(50.0), s}, lost_counts}); },
       .kin = {"motor_offset"}},  // what the motor's sensor is off by ever after
      {.name = "bedding_in", .first = 0.02, .most = 0.3,
       .set = [](H& h, double s, const C& c, const J&) { h.bedding = c.sign * s; }},
  };
}

std::vector<Fault> tendon_faults() {
  return {
      {.name = "lump", .first = 0.1, .most = 3.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.lump = c.sign * s, h.lump_width = radians(7.0), h.lump_at = alpha_within(c, j);
       }},
      {.name = "on_its_own_turns", .first = 0.2, .most = 4.0,
       .set = [](H& h, double s, const C& c, const J& j) { h.longer[1].push_back({"on_its_own_turns", {s, alpha_within(c, j)}, on_its_own_turns}); }},
      {.name = "climbing_flank", .first = 0.1, .most = 3.0,
       .set = [](H& h, double s, const C& c, const J& j) { h.longer[1].push_back({"climbing", {s, alpha_within(c, j)}, climbing}); }},
      {.name = "flat_on_pin", .first = 0.1, .most = 3.0,
       .set = [](H& h, double s, const C& c, const J& j) { h.longer[1].push_back({"flat", {s, theta_within(c, j)}, flat}); }},
      {.name = "tightening_knots", .first = 0.1, .most = 1.5,
       .set = [](H& h, double s, const C&, const J& j) {
         const double pull = j.declared.tendon.pretension;
         h.longer[0].push_back({"tightening", {s, pull}, tightening<0>});
         h.longer[1].push_back({"tightening", {s, pull}, tightening<1>});
       },
       .kin = {"tendon_slip"}},  // material let go at a knot
      // Softer than declared where it is slack, stiffer where it is taut.
      {.name = "hardening_tendon", .first = 3.0, .most = 60.0,
       .set = [](H& h, double s, const C&, const J& j) {
         const Tendon& tendon = j.declared.tendon;
         h.hardening = tendon.pretension / (tendon.modulus * 0.25 * k_pi * tendon.diameter * tendon.diameter);
         h.modulus = tendon.modulus / (1.0 + s);
       },
       .kin = {"tendon_stretch"}},
  };
}

std::vector<Fault> link_faults() {
  return {
      {.name = "sticking_bearing", .first = 20.0, .most = 4000.0,
       .set = [](H& h, double s, const C&, const J&) { h.bearing = s, h.bearing_stick = 0.6 * s; },
       .kin = {"joint_friction"}},
      {.name = "rubbing_place", .first = 50.0, .most = 8000.0,
       .set = [](H& h, double s, const C& c, const J& j) { h.dry.push_back({"rubbing_place", {s, theta_within(c, j)}, rubbing_place}); },
       .kin = {"joint_friction"}},
      {.name = "grease", .first = 100.0, .most = 1e6,
       .set = [](H& h, double s, const C&, const J&) { h.torque.push_back({"grease", {s}, grease}); },
       .kin = {"sensor_lag"}},  // behind stretch it is a filter: time constant by stiffness
      {.name = "loose_axis", .first = 0.1, .most = 1.5,
       .set = [](H& h, double s, const C&, const J&) {
         h.longer[0].push_back({"loose_axis", {s}, loose_axis<0>});
         h.longer[1].push_back({"loose_axis", {s}, loose_axis<1>});
       },
       // What holds the link in balance about the axis pulls at its end, so the axis lies off along the link.
       .kin = {"joint_length", "guide_position"}},
      {.name = "sliding_ring", .first = 0.2, .most = 5.0,
       .set = [](H& h, double s, const C& c, const J&) {
         h.longer[0].push_back({"sliding_ring", {c.sign * s}, sliding_ring<0>});
         h.longer[1].push_back({"sliding_ring", {c.sign * s}, sliding_ring<1>});
       },
       .kin = {"joint_length"}},
  };
}

std::vector<Fault> sensor_faults() {
  return {
      {.name = "encoder_interpolation", .first = 0.002, .most = 0.05,
       .set = [](H& h, double s, const C&, const J&) { h.interpolation = s; },
       .kin = {"joint_sensor_harmonic"}},  // its eighth
      {.name = "walking_zero", .first = 0.001, .most = 0.03,
       .set = [](H& h, double s, const C&, const J&) { h.zero_walk = s; }},
      {.name = "warm_zero", .first = 1e-4, .most = 0.01,
       .set = [](H& h, double s, const C& c, const J&) { h.reading.push_back({"warm_zero", {c.sign * s}, warm_zero}); },
       .kin = {"zero_offset", "thermal_expansion"}},  // a zero that is off, with the temperature
      {.name = "wrong_load_cell", .first = 0.3, .most = 1.5,
       .set = [](H& h, double s, const C& c, const J&) { h.load.push_back({"wrong_cell", {c.sign > 0 ? s : -0.5 * s}, wrong_cell}); },
       .kin = {"tendon_stretch"}},  // turned further, or less far, by a newton
  };
}
// clang-format on

}  // namespace tuning_list

std::vector<Fault> tuning_faults() {
  using namespace tuning_list;
  return joined({drive_faults(), tendon_faults(), link_faults(), sensor_faults()});
}

}  // namespace fusee::rig
