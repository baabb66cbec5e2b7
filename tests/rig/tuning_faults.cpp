// Unmodelled faults that thresholds may be tuned on, and those of used-up held-out sets whose joints stay in the
// regression list of CMakeLists.txt.
#include <algorithm>
#include <cmath>

#include "rig/fault_shapes.h"
#include "rig/faults.h"

namespace fusee::rig {
namespace tuning_list {

using namespace short_names;

// ---- actions --------------------------------------------------------------------------------------------------------

/// A gear whose teeth do not divide a turn of the motor. Numbers: amplitude, phase.
double gear_wave(const Moment& now, const N& n, N&) {
  return n[0] * (std::sin(3.7 * now.alpha + n[1]) - std::sin(n[1]));
}

/// A set screw that holds until the shaft has wound up by n[0], then jumps back by it.
double jumping_hub(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.alpha, 0.0};
  memory[1] = std::fmod(memory[1] + (now.alpha - memory[0]), n[0]);
  memory[0] = now.alpha;
  return -memory[1];
}

/// Beyond n[0] rad/s of rising α the motor's counter loses the share n[1] of its counts.
double lost_counts(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0};
  if (now.alpha_speed > n[0]) memory[0] += n[1] * now.alpha_speed * now.seconds;
  return memory[0];
}

/// From α = n[1] on the tendon winds on its own turns, further out by n[0].
double on_its_own_turns(const Moment& now, const N& n, N&) { return n[0] * std::max(0.0, now.alpha - n[1]); }

/// The tendon climbs n[0] up its groove's flank at α = n[1], and only while it is wound in.
double climbing(const Moment& now, const N& n, N&) {
  return now.direction > 0 ? n[0] * bump((now.alpha - n[1]) / radians(6.0)) : 0.0;
}

/// A flat n[0] deep on the tendon's pin, under the tendon about θ = n[1].
double flat(const Moment& now, const N& n, N&) {
  const double x = (now.theta - n[1]) / radians(6.0);
  return -n[0] * std::max(0.0, 1.0 - x * x);
}

/// A knot tightens by up to n[0] under the largest pull so far; n[1] N beyond the first pull for 63 % of it.
double tightening(const Moment& now, const N& n, N& memory) {
  const double tension = now.tension[now.side];
  if (tension <= 0) return memory.empty() ? 0.0 : -n[0] * (1.0 - std::exp(-(memory[1] - memory[0]) / n[1]));
  if (memory.empty()) memory = {tension, tension};
  memory[1] = std::max(memory[1], tension);
  return -n[0] * (1.0 - std::exp(-(memory[1] - memory[0]) / n[1]));
}

/// The joint's axis rests against its hole, n[0] off the middle, on the side to which the forces push it.
double loose_axis(const Moment& now, const N& n, N& memory) {
  const Vec2 force = force_on_axis(now);
  if (force.norm() < 1e-9) return 0.0;
  const Vec2 push = force.normalized();
  if (memory.empty()) memory = {push.x(), push.y()};
  return longer_by(now, n[0] * (push - Vec2(memory[0], memory[1])));
}

/// Tendons tied to a ring that slides along the link: n[0] further out at half a radian.
double sliding_ring(const Moment& now, const N& n, N&) {
  const double out = n[0] * now.theta * now.theta / 0.25;
  return longer_by(now, out * Vec2(std::sin(now.theta), std::cos(now.theta)));
}

/// Grease in the joint: n[0] N·mm·s.
double grease(const Moment& now, const N& n, N&) { return -n[0] * now.theta_speed; }

/// A place in the bearing that rubs: n[0] N·mm at θ = n[1].
double rubbing_place(const Moment& now, const N& n, N&) { return n[0] * bump((now.theta - n[1]) / radians(4.0)); }

/// A sensor whose zero drifts by n[0] per K.
double warm_zero(const Moment& now, const N& n, N&) { return n[0] * now.warmth; }

/// A load cell that reads too little: the load is greater by the share n[0].
double wrong_cell(const Moment& now, const N& n, N&) { return n[0] * now.load; }

/// A flexure as joint: its centre moves along its middle line by n[0] mm at n[1] rad, with θ², and takes the link
/// along.
double wandering_flexure(const Moment& now, const N& n, N&) {
  const double far = now.theta / n[1];
  return longer_by(now, n[0] * far * far * Vec2(std::sin(0.5 * now.theta), std::cos(0.5 * now.theta)));
}

/// A drum without groove: the tendon leaves it square at α = n[1] alone; n[2] from there its way is n[0] mm longer,
/// with the square of the distance.
double aslant_off_drum(const Moment& now, const N& n, N&) {
  const auto squared = [&](double alpha) { return (alpha - n[1]) * (alpha - n[1]) / (n[2] * n[2]); };
  return n[0] * (squared(now.alpha) - squared(0.0));
}

/// Soft fibres on polished pins: friction with the pull to the power of 2/3 (Hertz, Howell), n[0] N·mm at n[1] N each.
double howells_law(const Moment& now, const N& n, N&) {
  const auto rubs = [&](double tension) { return std::pow(std::max(0.0, tension) / n[1], 2.0 / 3.0); };
  return 0.5 * n[0] * (rubs(now.tension[0]) + rubs(now.tension[1]));
}

/// A draw-wire sensor with a weak spring: towards n[2] it follows at once; the other way it omits the share n[0] of any
/// motion above n[1] rad/s, and catches up at that speed. Memory: time, wire pulled out, wire shown.
double drawn_wire(const Moment& now, const N& n, N& memory) {
  const double out = n[2] * now.theta;
  if (memory.empty()) memory = {now.time, out, out};
  const double since = now.time - memory[0], in = std::max(0.0, memory[1] - out);
  const double drawn = std::max(in, n[1] * since) - n[0] * std::max(0.0, in - n[1] * since);
  memory = {now.time, out, std::max(out, memory[2] - drawn)};
  return n[2] * memory[2] - now.theta;
}

/// The sensor is compensated by a thermometer on the motor: off by n[0] once that has long run at 1 rad/s, with the
/// square of the speed, with the time constant n[1] s. Memory: time, warmth of the motor.
double wrong_thermometer(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.time, 0.0};
  const double since = now.time - memory[0];
  memory[0] = now.time;
  return n[0] * followed(now.alpha_speed * now.alpha_speed, since, n[1], memory[1]);
}

/// A knot that lets go n[0] mm whenever its pull rises beyond n[1] N, by as much as it rises. Memory: pull, let go.
double creeping_knot(const Moment& now, const N& n, N& memory) {
  const double tension = now.tension[now.side];
  if (memory.empty()) memory = {tension, 0.0};
  memory[1] += std::max(0.0, std::max(tension, n[1]) - std::max(memory[0], n[1])) / n[1];
  memory[0] = tension;
  return -n[0] * memory[1];
}

// ---- tables ---------------------------------------------------------------------------------------------------------

// clang-format off
const std::vector<Fault>& drive_faults() {
  static const std::vector<Fault> faults = {
      {.name = "motor_cogging", .first = 0.005, .most = 0.2,
       .set = [](H& h, double s, const C&, const J&) { h.cogging = s; },
       .kin = {"motor_sensor_harmonic"}},  // a wave of the motor's shaft
      acting("gearbox_error", 0.005, 0.2, Place::shaft, gear_wave, [](const D& d) -> N { return {d.size, d.angle}; },
             {"motor_sensor_harmonic"}),  // over half a turn 3.7 a turn is four
      acting("jumping_hub", 0.01, 0.2, Place::shaft, jumping_hub, [](const D& d) -> N { return {d.size}; },
             {"backlash"}),  // lost motion between shaft and pulley
      acting("lost_counts", 1e-3, 0.05, Place::shaft, lost_counts, [](const D& d) -> N { return {radians(50.0), d.size}; },
             {"motor_offset"}),  // an offset of the motor's sensor ever after
      {.name = "bedding_in", .first = 0.02, .most = 0.3,
       .set = [](H& h, double s, const C& c, const J&) { h.bedding = c.sign * s; }},
  };
  return faults;
}

const std::vector<Fault>& tendon_faults() {
  static const std::vector<Fault> faults = {
      {.name = "lump", .first = 0.1, .most = 3.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.lump = c.sign * s, h.lump_width = radians(7.0), h.lump_at = Draw{c, s, j}.alpha_within();
       }},
      acting("on_its_own_turns", 0.2, 4.0, Place::tendon_2, on_its_own_turns, [](const D& d) -> N { return {d.size, d.alpha_within()}; }),
      acting("climbing_flank", 0.1, 3.0, Place::tendon_2, climbing, [](const D& d) -> N { return {d.size, d.alpha_within()}; }),
      acting("flat_on_pin", 0.1, 3.0, Place::tendon_2, flat, [](const D& d) -> N { return {d.size, d.theta_within()}; }),
      acting("tightening_knots", 0.1, 1.5, Place::both_tendons, tightening, [](const D& d) -> N { return {d.size, d.pretension()}; },
             {"tendon_slip"}),  // tendon let go at a knot
      // Softer than declared where it is slack, stiffer where it is taut.
      {.name = "hardening_tendon", .first = 3.0, .most = 60.0,
       .set = [](H& h, double s, const C&, const J& j) {
         const Tendon& tendon = j.declared.tendon;
         h.hardening = tendon.pretension / (tendon.modulus * 0.25 * k_pi * tendon.diameter * tendon.diameter);
         h.modulus = tendon.modulus / (1.0 + s);
       },
       .kin = {"tendon_stretch"}},
  };
  return faults;
}

const std::vector<Fault>& link_faults() {
  static const std::vector<Fault> faults = {
      {.name = "sticking_bearing", .first = 20.0, .most = 4000.0,
       .set = [](H& h, double s, const C&, const J&) { h.bearing = s, h.bearing_stick = 0.6 * s; },
       .kin = {"joint_friction"}},
      acting("rubbing_place", 50.0, 8000.0, Place::dry_friction, rubbing_place, [](const D& d) -> N { return {d.size, d.theta_within()}; },
             {"joint_friction"}),
      acting("grease", 100.0, 1e6, Place::joint_torque, grease, [](const D& d) -> N { return {d.size}; },
             {"sensor_lag"}),  // with the tendons' compliance a first-order lag
      // Whatever balances the link about its axis pulls at its end, so the axis is displaced along the link.
      acting("loose_axis", 0.1, 1.5, Place::both_tendons, loose_axis, [](const D& d) -> N { return {d.size}; },
             {"joint_length", "guide_position"}),
      acting("sliding_ring", 0.2, 5.0, Place::both_tendons, sliding_ring, [](const D& d) -> N { return {d.sign * d.size}; },
             {"joint_length"}),
  };
  return faults;
}

const std::vector<Fault>& sensor_faults() {
  static const std::vector<Fault> faults = {
      {.name = "encoder_interpolation", .first = 0.002, .most = 0.05,
       .set = [](H& h, double s, const C&, const J&) { h.interpolation = s; },
       .kin = {"joint_sensor_harmonic"}},  // its eighth
      {.name = "walking_zero", .first = 0.001, .most = 0.03,
       .set = [](H& h, double s, const C&, const J&) { h.zero_walk = s; }},
      acting("warm_zero", 1e-4, 0.01, Place::reading, warm_zero, [](const D& d) -> N { return {d.sign * d.size}; },
             {"zero_offset", "thermal_expansion"}),  // a zero offset, with the temperature
      acting("wrong_load_cell", 0.3, 1.5, Place::load, wrong_cell, [](const D& d) -> N { return {d.sign > 0 ? d.size : -0.5 * d.size}; },
             {"tendon_stretch"}),  // more, or less, rotation per newton
  };
  return faults;
}
// clang-format on

}  // namespace tuning_list

std::vector<Fault> tuning_faults() {
  using namespace tuning_list;
  return joined({drive_faults(), tendon_faults(), link_faults(), sensor_faults()});
}

std::vector<Fault> regression_faults() {
  using namespace tuning_list;
  // clang-format off
  return {
      acting("turns_side_by_side", 0.1, 1.5, Place::one_tendon, aslant_off_drum,
             [](const D& d) -> N { return {d.size, d.alpha_within(), 0.5 * (d.joint.alpha_max - d.joint.alpha_min)}; }),
      acting("creeping_knot", 0.02, 0.5, Place::tendon_2, creeping_knot,
             [](const D& d) -> N { return {d.size, 1.3 * d.pretension()}; }, {"tendon_slip"}),  // let go bit by bit
      acting("flexure_wandering", 0.2, 2.0, Place::both_tendons, wandering_flexure, [](const D& d) -> N {
               const Joint& joint = d.joint.declared.joint;
               return {d.sign * d.size, std::max(joint.theta_max, -joint.theta_min)};
             }),
      acting("fibres_rubbing_by_howells_law", 300.0, 8000.0, Place::dry_friction, howells_law,
             [](const D& d) -> N { return {d.size, d.pretension()}; }, {"capstan_friction"}),  // less than in proportion
      acting("wire_drawn_in_too_slowly", 0.1, 1.0, Place::reading, drawn_wire,
             [](const D& d) -> N { return {d.size, radians(2.0 + 8.0 * d.share), d.sign}; }),
      acting("thermometer_glued_to_motor", 0.01, 0.5, Place::reading, wrong_thermometer,
             [](const D& d) -> N { return {d.sign * d.size, 10.0 + 50.0 * d.share}; }),
  };
  // clang-format on
}

}  // namespace fusee::rig
