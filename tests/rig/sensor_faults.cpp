// Faults of the joint's sensor and of the log.
#include "rig/fault_table.h"

namespace fusee::rig::fault_table {

// clang-format off
std::vector<Fault> sensor_faults() { return {
  {.split = "named", .name = "zero_offset", .first = 0.002, .most = 0.05,
   .set = [](H& h, double s, const C& c, const J&) { h.zero = c.sign * s; },
   .kin = {"motor_offset"},
   .numbers = [](const H& h, const J&) -> Numbers { return {{"offset_deg", degrees(h.zero)}}; }},
  {.split = "named", .name = "joint_sensor_gain", .first = 0.005, .most = 0.1,
   .set = [](H& h, double s, const C& c, const J&) { h.gain = c.sign * s; },
   .kin = {"pulley_scale", "joint_length"},  // almost proportional to θ
   .numbers = [](const H& h, const J&) -> Numbers { return {{"gain_percent", percent(h.gain)}}; }},
  {.split = "named", .name = "joint_sensor_eccentricity", .first = 0.01, .most = 0.2,
   .set = [](H& h, double s, const C& c, const J&) { h.joint_eccentricity = s, h.joint_eccentricity_phase = c.angle; },
   .kin = {"joint_sensor_gain"},  // its slope over the range
   .numbers = [](const H& h, const J&) { return wave(h.joint_eccentricity, h.joint_eccentricity_phase); }},
  {.split = "named", .name = "joint_sensor_harmonic", .first = 0.005, .most = 0.2,
   .set = [](H& h, double s, const C& c, const J&) { h.joint_harmonic = s, h.joint_harmonic_phase = c.angle, h.joint_harmonic_order = order_of(c); },
   .kin = {"joint_sensor_eccentricity"},  // alike over a sixth of a turn
   .numbers = [](const H& h, const J&) { return wave(h.joint_harmonic, h.joint_harmonic_phase, h.joint_harmonic_order); }},
  {.split = "named", .name = "sensor_lag", .first = 0.02, .most = 0.5,
   .set = [](H& h, double s, const C& c, const J&) { (c.share < 0.5 ? h.lag : h.lag_filter) = s; },
   .numbers = [](const H& h, const J&) -> Numbers { return {{"lag_ms", 1e3 * (h.lag + h.lag_filter)}}; }},

  {.split = "tuning", .name = "encoder_interpolation", .first = 0.002, .most = 0.05,
   .set = [](H& h, double s, const C&, const J&) { h.interpolation = s; },
   .kin = {"joint_sensor_harmonic"}},  // order 8
  {.split = "tuning", .name = "walking_zero", .first = 0.001, .most = 0.03,
   .set = [](H& h, double s, const C&, const J&) { h.zero_walk = s; }},
  // The zero of the joint sensor drifts by n[0] rad/K.
  {.split = "tuning", .name = "warm_zero", .first = 1e-4, .most = 0.01,
   .kin = {"zero_offset", "thermal_expansion"},  // an offset that follows the temperature
   .place = Place::reading, .parameters = [](const D& d) -> N { return {d.sign * d.size}; },
   .act = [](const M& now, const N& n, N&) { return n[0] * now.warmth; }},
  // The load cell reads low: the load exceeds the logged one by the share n[0].
  {.split = "tuning", .name = "wrong_load_cell", .first = 0.3, .most = 1.5,
   .kin = {"tendon_stretch"},  // changes the rotation per newton
   .place = Place::load, .parameters = [](const D& d) -> N { return {d.sign > 0 ? d.size : -0.5 * d.size}; },
   .act = [](const M& now, const N& n, N&) { return n[0] * now.load; }},

  // A draw-wire sensor with a weak spring: in the direction n[2] it follows at once. In the other direction it omits
  // the share n[0] of any motion above n[1] rad/s, and catches up at that speed. Memory: time, wire pulled out, wire
  // shown.
  {.split = "regression", .name = "wire_drawn_in_too_slowly", .first = 0.1, .most = 1.0,
   .place = Place::reading, .parameters = [](const D& d) -> N { return {d.size, radians(2.0 + 8.0 * d.share), d.sign}; },
   .act = [](const M& now, const N& n, N& memory) {
     const double out = n[2] * now.theta;
     if (memory.empty()) memory = {now.time, out, out};
     const double since = now.time - memory[0], in = std::max(0.0, memory[1] - out);
     const double drawn = std::max(in, n[1] * since) - n[0] * std::max(0.0, in - n[1] * since);
     memory = {now.time, out, std::max(out, memory[2] - drawn)};
     return n[2] * memory[2] - now.theta;
   }},
  // The sensor is compensated by a thermometer on the motor: an error of n[0] rad in steady state at 1 rad/s, with the
  // square of the speed and the time constant n[1] s. Memory: time, warmth of the motor.
  {.split = "regression", .name = "thermometer_glued_to_motor", .first = 0.01, .most = 0.5,
   .place = Place::reading, .parameters = [](const D& d) -> N { return {d.sign * d.size, 10.0 + 50.0 * d.share}; },
   .act = [](const M& now, const N& n, N& memory) {
     if (memory.empty()) memory = {now.time, 0.0};
     const double since = now.time - memory[0];
     memory[0] = now.time;
     return n[0] * followed(now.alpha_speed * now.alpha_speed, since, n[1], memory[1]);
   }},

  // A sunbeam passes over the photo diodes: n[0] (0.05 … 3 deg) at n[1] s, n[2] s wide (5 … 60).
  {.split = "heldout_13", .name = "sunbeam_passing_sensor", .first = 0.01, .most = 0.15,
   .place = Place::reading, .parameters = [](const D& d) -> N { return {d.sign * d.size, 10.0 + 40.0 * d.share, 8.0}; },
   .act = [](const M& now, const N& n, N&) { return n[0] * bump((now.time - n[1]) / n[2]); }},
  // A sensor that samples every n[0] s (5 … 200 ms) and reports its last sample; phase 0.37.
  {.split = "heldout_13", .name = "sensor_on_its_own_beat", .first = 0.05, .most = 0.8,
   .kin = {"sensor_lag"},  // its mean delay
   .place = Place::reading, .act = [](const M& now, const N& n, N&) {
     if (!(n[0] > 0)) return 0.0;
     return -now.theta_speed * n[0] * fraction(now.time / n[0] + 0.37);
   }},
  // A linearisation by a polynomial of the fifth degree: Chebyshev's, ±n[0] (0.02 … 1 deg) within n[2] about θ = n[1],
  // running away beyond; zero at home.
  {.split = "heldout_13", .name = "polynomial_of_too_high_degree", .first = 4e-3, .most = 0.05,
   .place = Place::reading, .parameters = [](const D& d) -> N {
     const Joint& joint = d.joint.declared.joint;
     return {d.sign * d.size, 0.5 * (joint.theta_min + joint.theta_max), 0.5 * (joint.theta_max - joint.theta_min)};
   },
   .act = [](const M& now, const N& n, N&) {
     const auto swung = [&](double theta) {
       const double x = std::clamp((theta - n[1]) / n[2], -1.2, 1.2);
       return x * (5.0 + x * x * (16.0 * x * x - 20.0));
     };
     return n[0] * (swung(now.theta) - swung(0.0));
   }},
  // Popcorn noise between 0 and n[0] (0.02 … 0.5 deg), each for n[1] s on average (0.1 … 30); n[2]: its seed. Memory:
  // time, state, rows.
  {.split = "heldout_13", .name = "popcorn_in_amplifier", .first = 8e-3, .most = 0.1,
   .place = Place::reading, .parameters = [](const D& d) -> N { return {d.sign * d.size, 1.0 + 9.0 * d.share, chance(d)}; },
   .act = [](const M& now, const N& n, N& memory) {
     if (memory.empty()) memory = {now.time, 0.0, 0.0};
     const double since = std::max(0.0, now.time - memory[0]);
     memory[0] = now.time;
     const double other = 0.5 * (1.0 - std::exp(-2.0 * since / n[1]));
     if (numbered(n[2] + memory[2]++, 151).share() < other) memory[1] = 1.0 - memory[1];
     return n[0] * memory[1];
   }},
  // A laser on a rough rim: an error with standard deviation n[0] (0.02 … 0.3 deg) at points n[1] apart, linear between
  // them, the same in each pass; n[2]: its seed. Zero at home.
  {.split = "heldout_13", .name = "laser_on_grainy_rim", .first = 3e-3, .most = 0.04,
   .place = Place::reading, .parameters = [](const D& d) -> N { return {d.size, radians(0.5 + 3.0 * d.share), chance(d)}; },
   .act = [](const M& now, const N& n, N&) {
     const auto grain = [&](double theta) {
       const double x = std::clamp(theta / n[1], -4e3, 4e3) + 5e3;
       const double before = std::floor(x);
       const auto at = [&](double point) { return numbered(n[2] + point, 157).normal(); };
       return at(before) + (x - before) * (at(before + 1.0) - at(before));
     };
     return n[0] * (grain(now.theta) - grain(0.0));
   }},
  // One computer steps the motor and reads the sensor, whose rows queue: n[0] x / (1 − x) s old (5 … 200 ms), where the
  // load x of the computer is 1 at n[1] rad/s and at most 0.9.
  {.split = "heldout_13", .name = "computer_busy_with_steps", .first = 0.05, .most = 0.8,
   .kin = {"sensor_lag"},  // delay in fast runs
   .place = Place::reading, .parameters = [](const D& d) -> N { return {d.size, 2.0 + 2.0 * d.share}; },
   .act = [](const M& now, const N& n, N&) {
     const double busy = std::min(0.9, std::abs(now.alpha_speed) / n[1]);
     return -now.theta_speed * n[0] * busy / (1.0 - busy);
   }},
  // The hair spring of the sensor's gear is slack beyond θ = n[1] on the side n[2]: the reading has play of n[0] (0.1 …
  // 2 deg). Memory: the reading.
  {.split = "heldout_13", .name = "hair_spring_run_down", .first = 8e-3, .most = 0.1,
   .place = Place::reading, .parameters = [](const D& d) -> N { return {d.size, d.theta_within(), d.sign}; },
   .act = [](const M& now, const N& n, N& memory) {
     if (memory.empty()) memory = {now.theta};
     if (!(n[2] * (now.theta - n[1]) > 0)) return 0.0 * (memory[0] = now.theta);
     behind(now.theta, 0.5 * n[0], memory[0]);
     memory[0] = n[2] > 0 ? std::max(memory[0], n[1]) : std::min(memory[0], n[1]);  // the spring holds it up to n[1]
     return memory[0] - now.theta;
   }},
  // The amplifier's span is set by hand before each run: a gain error with standard deviation n[0] (0.001 … 0.03);
  // n[1]: its seed.
  {.split = "heldout_13", .name = "span_set_before_each_run", .first = 5e-3, .most = 0.06,
   .kin = {"joint_sensor_gain"},  // a different gain in each run
   .place = Place::reading, .parameters = [](const D& d) -> N { return {d.size, chance(d)}; },
   .act = [](const M& now, const N& n, N&) { return n[0] * now.theta * numbered(n[1] + static_cast<double>(now.run), 163).normal(); }},
  // The sensor's clock hunts about the motor's: time stamps ±n[0] s (5 … 100 ms), period n[1] s (20 … 120), phase n[2].
  {.split = "heldout_13", .name = "clock_hunting_for_the_other", .first = 0.03, .most = 0.4,
   .place = Place::reading, .parameters = [](const D& d) -> N { return {d.size, 20.0 + 60.0 * d.share, d.angle}; },
   .act = [](const M& now, const N& n, N&) { return -now.theta_speed * n[0] * std::sin(k_two_pi * now.time / n[1] + n[2]); }},
  // Shorted turns of a potentiometer: the reading stands still for n[0] (0.1 … 2 deg) from θ = n[1] on and is short by
  // that beyond. Zero at home.
  {.split = "heldout_13", .name = "shorted_turns_in_potentiometer", .first = 0.01, .most = 0.12,
   .place = Place::reading, .parameters = [](const D& d) -> N { return {d.size, d.theta_within()}; },
   .act = [](const M& now, const N& n, N&) {
     const auto lacks = [&](double theta) { return std::clamp(theta - n[1], 0.0, std::max(0.0, n[0])); };
     return lacks(0.0) - lacks(now.theta);
   }},
}; }
// clang-format on

}  // namespace fusee::rig::fault_table
