// Held-out set 13: faults of real tendon joints, by someone who saw neither the inference nor its results on other
// sets. Run once, never tuned on. Ranges in brackets are those met in practice.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "rig/fault_shapes.h"
#include "rig/faults.h"
#include "rig/random.h"

namespace fusee::rig {
namespace heldout_13 {

using namespace short_names;

/// A number that stands for all that is drawn by chance in one joint.
double chance(const D& d) { return std::floor(1e6 * d.angle); }
double mean_tension(const Moment& now) { return 0.5 * (std::max(0.0, now.tension[0]) + std::max(0.0, now.tension[1])); }
double fraction(double x) { return x - std::floor(x); }

// ---- motor, gearbox, shaft ------------------------------------------------------------------------------------------

/// A magnetic coupling lags by the arc sine of its load over n[1] N, the load at which it slips; n[0] rad times that
/// (one over the pole pairs: 1/20 … 1/4).
double leaning_magnets(const Moment& now, const N& n, N&) {
  return -n[0] * std::asin(std::clamp(now.load / n[1], -0.98, 0.98));
}

/// A proportionally controlled direct drive whose torque constant has n[2] waves a turn, phase n[3]: its error under
/// n[1] N varies by n[0] rad (0.1 … 2 deg).
double force_not_even(const Moment& now, const N& n, N&) {
  return -n[0] * now.load / n[1] * std::sin(n[2] * now.alpha + n[3]);
}

/// A split anti-backlash gear: a load to the side n[2] beats its spring between n[1] N and 1.25 n[1] N, and the shaft
/// falls back by the play n[0] rad (0.2 … 2 deg).
double split_gear(const Moment& now, const N& n, N&) {
  return -n[2] * n[0] * std::clamp((n[2] * now.load / n[1] - 1.0) / 0.25, 0.0, 1.0);
}

/// Hysteresis of a strain wave gear's twist: n[0] rad to either side (0.02 … 0.5 deg), reversed once the load has
/// changed by twice n[2] of n[1] N. Memory: the load followed.
double rubbing_within(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0};
  const double load = now.load / n[1];
  return n[0] * (load - behind(load, n[2], memory[0])) / n[2];
}

/// A worm shortens as it cools and turns its wheel: n[0] rad/K (5e-5 … 3e-3, printed).
double shrinking_worm(const Moment& now, const N& n, N&) { return n[0] * now.warmth; }

/// A vee belt sinks into its smaller wheel under load of either sign: the ratio changes by n[0] at n[1] N (0.001 …
/// 0.03).
double sinking_belt(const Moment& now, const N& n, N&) { return -n[0] * now.alpha * std::abs(now.load) / n[1]; }

/// A plain bearing with oil: the shaft's centre follows Sommerfeld's half circle, 2 ε √(1 − ε²) n[0] mm to the side
/// with ε = 1 / (1 + speed / n[1]); one tendon gets longer, the other shorter (0.02 … 0.5 mm).
double carried_by_oil(const Moment& now, const N& n, N&) {
  const double low = 1.0 / (1.0 + std::abs(now.alpha_speed) / n[1]);
  return apart(now) * n[0] * sign_of(now.alpha_speed) * 2.0 * low * std::sqrt(1.0 - low * low);
}

// ---- tendons, pins, frame -------------------------------------------------------------------------------------------

/// A superelastic tendon is n[0] mm longer (0.2 … 5) once transformed: from n[1] N over n[3] N, and back from n[2] +
/// n[3] down to n[2] N. Memory: the share transformed.
double changing_crystals(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0};
  const auto share = [&](double from) { return std::clamp((now.tension[now.side] - from) / n[3], 0.0, 1.0); };
  return n[0] * (memory[0] = std::clamp(memory[0], share(n[1]), share(n[2])));
}

/// A panel that carries the pins snaps over by n[0] mm (0.05 … 1) at n[1] N to the side n[2], and back at a third of
/// that to the other side. Memory: 1 while it is over.
double oil_can(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0};
  const double load = n[2] * now.load / n[1];
  if (load >= 1.0) memory[0] = 1.0;
  if (load <= -1.0 / 3.0) memory[0] = 0.0;
  return -apart(now) * n[2] * n[0] * memory[0];
}

/// A lock nut works loose by vibration (Junker): n[0] mm shorter per rad at 1 rad/s, with the square of the speed up to
/// 3 rad/s (1e-4 … 0.05 mm). Memory: α, path times speed squared.
double shaken_lock_nut(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.alpha, 0.0};
  memory[1] += motor_path(now, memory[0]) * std::pow(std::min(3.0, std::abs(now.alpha_speed)), 2);
  return -n[0] * memory[1];
}

/// A ferrule slips n[0] mm (0.02 … 0.5) whenever a load above n[1] N is put on. Memory: 1 under load, times so far.
double jerked_ferrule(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0, 0.0};
  const double loaded = std::abs(now.load) > n[1] ? 1.0 : 0.0;
  if (loaded > memory[0]) memory[1] += 1.0;
  memory[0] = loaded;
  return n[0] * memory[1];
}

/// A tape on a crowned drum wanders to one side while wound in, to the other while let out: ±n[0] mm (0.05 … 0.5), with
/// the constant n[1] rad of path. Memory: α, place.
double wandering_tape(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.alpha, 0.0};
  const double path = motor_path(now, memory[0]);
  return n[0] * followed(now.direction, path, n[1], memory[1]);
}

/// Galling of dry steel on steel: friction of n[0] N·mm at n[1] N in both (100 … 3000) in the end, 63 % of it after
/// n[2] rad under that pull. Memory: α, work.
double galling(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.alpha, 0.0};
  const double pull = mean_tension(now) / n[1];
  memory[1] += pull * motor_path(now, memory[0]);
  return n[0] * pull * (1.0 - std::exp(-memory[1] / n[2]));
}

/// A compression spring in the tendon: n[0] mm per n[2] N, the pretension (0.2 … 5), until its coils touch at n[1] N.
double buffer_spring(const Moment& now, const N& n, N&) {
  return n[0] * (std::clamp(now.tension[now.side], 0.0, n[1]) / n[2] - 1.0);
}

/// From θ = n[2] on to the side n[3] the far tendon bends over an edge, evenly over n[4]: friction of n[0] N·mm at n[1]
/// N (50 … 2000).
double edge_of_cover(const Moment& now, const N& n, N&) {
  const double pull = std::max(0.0, now.tension[n[3] > 0 ? 0 : 1]) / n[1];
  return n[0] * pull * std::clamp(n[3] * (now.theta - n[2]) / n[4], 0.0, 1.0);
}

// ---- joint ----------------------------------------------------------------------------------------------------------

/// A ball in a hollow link rolls to its lower end once |θ| exceeds n[1]: n[0] N·mm there (5 … 300). Memory: side, last
/// θ.
double rolling_ball(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0, 0.0};
  if (std::abs(memory[1]) > n[1]) memory[0] = sign_of(memory[1]);
  memory[1] = now.theta;
  return n[0] * memory[0] * std::cos(now.theta);
}

/// A bearing's outer ring creeps in its seat, a rad per n[1] rad of the motor's path from n[2] on: the axis moves on a
/// circle of n[0] mm (0.01 … 0.2). Memory: α, path.
double creeping_ring(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.alpha, 0.0};
  memory[1] += motor_path(now, memory[0]);
  const double round = n[2] + memory[1] / n[1];
  return longer_by(now, n[0] * Vec2(std::cos(round) - std::cos(n[2]), std::sin(round) - std::sin(n[2])));
}

/// A ball catch on the axle: n[1] notches a turn, phase n[2], up to n[0] N·mm towards the nearest (50 … 1000).
double notches(const Moment& now, const N& n, N&) { return -n[0] * std::sin(n[1] * now.theta + n[2]); }

/// Drag under water, with the square of the speed: n[0] N·mm at 1 rad/s of the motor (20 … 3000).
double under_water(const Moment& now, const N& n, N&) { return -n[0] * now.alpha_speed * std::abs(now.alpha_speed); }

/// Gusts: n[0] N·mm on average (5 … 200), the square of a wind with correlation time n[1] s; n[2]: its seed. Memory:
/// wind, steps.
double gusts(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0, 0.0};
  const double left = std::exp(-std::max(0.0, now.seconds) / n[1]);
  memory[0] = left * memory[0] + std::sqrt(1.0 - left * left) * numbered(n[2] + memory[1]++, 149).normal();
  return n[0] * memory[0] * memory[0];
}

/// An axle nut turns with the link: it tightens on the way to +θ and loosens by 4/5 on the way back; friction of n[0]
/// N·mm/rad (50 … 2000). Memory: θ, tightened by.
double tightening_nut(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.theta, 0.0};
  const double way = now.theta - memory[0];
  memory[0] = now.theta;
  memory[1] = std::max(0.0, memory[1] + (way > 0 ? way : 0.8 * way));
  return n[0] * memory[1];
}

// ---- load -----------------------------------------------------------------------------------------------------------

/// A pneumatic load from a leaking tank, refilled every n[1] s (8 … 60): it falls by the share n[0] (0.02 … 0.3) in
/// between, right on average; n[2]: phase.
double refilled_tank(const Moment& now, const N& n, N&) {
  return now.load * n[0] * (0.5 - fraction(now.time / n[1] + n[2]));
}

/// A pneumatic load through a throttle: it follows the logged one with the time constant n[0] s (0.2 … 10). Memory:
/// load.
double through_throttle(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0};
  if (!(n[0] > 0)) return 0.0 * (memory[0] = now.load);
  return followed(now.load, std::max(0.0, now.seconds), n[0], memory[0]) - now.load;
}

/// A voltage-driven motor as load: its pull changes by n[0] N at 1 rad/s of the pulley (0.2 … 5); none without a load.
double dynamo(const Moment& now, const N& n, N&) { return now.load != 0 ? n[0] * now.alpha_speed : 0.0; }

/// A cylinder on liquid gas: the load changes by the share n[0] per K (0.003 … 0.03).
double vapour(const Moment& now, const N& n, N&) { return now.load * std::clamp(n[0] * now.warmth, -0.95, 0.95); }

// ---- joint's sensor, log --------------------------------------------------------------------------------------------

/// A sunbeam passes over the photo diodes: n[0] (0.05 … 3 deg) at n[1] s, n[2] s wide (5 … 60).
double sunbeam(const Moment& now, const N& n, N&) { return n[0] * bump((now.time - n[1]) / n[2]); }

/// A sensor that samples every n[0] s (5 … 200 ms) and reports its last sample; phase 0.37.
double own_beat(const Moment& now, const N& n, N&) {
  if (!(n[0] > 0)) return 0.0;
  return -now.theta_speed * n[0] * fraction(now.time / n[0] + 0.37);
}

/// A linearisation by a polynomial of the fifth degree: Chebyshev's, ±n[0] (0.02 … 1 deg) within n[2] about θ = n[1],
/// running away beyond; zero at home.
double polynomial(const Moment& now, const N& n, N&) {
  const auto swung = [&](double theta) {
    const double x = std::clamp((theta - n[1]) / n[2], -1.2, 1.2);
    return x * (5.0 + x * x * (16.0 * x * x - 20.0));
  };
  return n[0] * (swung(now.theta) - swung(0.0));
}

/// Popcorn noise between 0 and n[0] (0.02 … 0.5 deg), each for n[1] s on average (0.1 … 30); n[2]: its seed. Memory:
/// time, state, rows.
double popcorn(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.time, 0.0, 0.0};
  const double since = std::max(0.0, now.time - memory[0]);
  memory[0] = now.time;
  const double other = 0.5 * (1.0 - std::exp(-2.0 * since / n[1]));
  if (numbered(n[2] + memory[2]++, 151).share() < other) memory[1] = 1.0 - memory[1];
  return n[0] * memory[1];
}

/// A laser on a rough rim: an error with standard deviation n[0] (0.02 … 0.3 deg) at points n[1] apart, linear between
/// them, the same in each pass; n[2]: its seed. Zero at home.
double grain_of_rim(const Moment& now, const N& n, N&) {
  const auto grain = [&](double theta) {
    const double x = std::clamp(theta / n[1], -4e3, 4e3) + 5e3;
    const double before = std::floor(x);
    const auto at = [&](double point) { return numbered(n[2] + point, 157).normal(); };
    return at(before) + (x - before) * (at(before + 1.0) - at(before));
  };
  return n[0] * (grain(now.theta) - grain(0.0));
}

/// One computer steps the motor and reads the sensor, whose rows queue: n[0] x / (1 − x) s old (5 … 200 ms), where the
/// load x of the computer is 1 at n[1] rad/s and at most 0.9.
double busy_computer(const Moment& now, const N& n, N&) {
  const double busy = std::min(0.9, std::abs(now.alpha_speed) / n[1]);
  return -now.theta_speed * n[0] * busy / (1.0 - busy);
}

/// The hair spring of the sensor's gear runs down at θ = n[1]: beyond, to the side n[2], there is play of n[0]
/// (0.1 … 2 deg) in the reading. Memory: the reading.
double spring_run_down(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.theta};
  if (!(n[2] * (now.theta - n[1]) > 0)) return 0.0 * (memory[0] = now.theta);
  behind(now.theta, 0.5 * n[0], memory[0]);
  memory[0] = n[2] > 0 ? std::max(memory[0], n[1]) : std::min(memory[0], n[1]);  // up to there it is held
  return memory[0] - now.theta;
}

/// The amplifier's span is set by hand before each run: a gain error with standard deviation n[0] (0.001 … 0.03); n[1]:
/// its seed.
double span_set_anew(const Moment& now, const N& n, N&) {
  return n[0] * now.theta * numbered(n[1] + static_cast<double>(now.run), 163).normal();
}

/// The sensor's clock hunts about the motor's: time stamps ±n[0] s (5 … 100 ms), period n[1] s (20 … 120), phase n[2].
double hunting_clock(const Moment& now, const N& n, N&) {
  return -now.theta_speed * n[0] * std::sin(k_two_pi * now.time / n[1] + n[2]);
}

/// Shorted turns of a potentiometer: the reading stands still for n[0] (0.1 … 2 deg) from θ = n[1] on, and lacks that
/// ever after; zero at home.
double shorted_turns(const Moment& now, const N& n, N&) {
  const auto lacks = [&](double theta) { return std::clamp(theta - n[1], 0.0, std::max(0.0, n[0])); };
  return lacks(0.0) - lacks(now.theta);
}

}  // namespace heldout_13

// clang-format off
std::vector<Fault> heldout_13_faults() {
  using namespace heldout_13;
  return {
      acting("magnets_for_coupling_leaning", 0.02, 0.25, Place::shaft, leaning_magnets,
             [](const D& d) -> N { return {d.size, (2.0 + 2.0 * d.share) * d.pretension()}; }, {"tendon_stretch"}),  // under small loads
      acting("motor_of_uneven_force", 0.01, 0.15, Place::shaft, force_not_even,
             [](const D& d) -> N { return {d.size, d.pretension(), 3.0 + std::floor(11.9 * d.share), d.angle}; }),
      acting("split_gear_pushed_open", 0.01, 0.12, Place::shaft, split_gear,
             [](const D& d) -> N { return {d.size, (0.2 + 0.4 * d.share) * d.pretension(), d.sign}; }),
      acting("strain_wave_gear_rubbing_within", 5e-3, 0.08, Place::shaft, rubbing_within,
             [](const D& d) -> N { return {d.size, d.pretension(), 0.1}; }),
      acting("worm_shrinking_in_cold", 5e-4, 0.01, Place::shaft, shrinking_worm,
             [](const D& d) -> N { return {d.sign * d.size}; }, {"thermal_expansion"}),  // of tendons that are not equally warm
      acting("vee_belt_sinking_into_its_wheel", 0.01, 0.15, Place::shaft, sinking_belt,
             [](const D& d) -> N { return {d.size, d.pretension()}; }),
      acting("shaft_carried_aside_by_oil", 0.1, 1.5, Place::both_tendons, carried_by_oil,
             [](const D& d) -> N { return {d.sign * d.size, 0.2 + 1.8 * d.share}; }),

      acting("tendon_changing_its_crystals", 0.3, 3.0, Place::both_tendons, changing_crystals,
             [](const D& d) -> N { return {d.size, 1.25 * d.pretension(), 0.95 * d.pretension(), 0.4 * d.pretension()}; }),
      acting("panel_popping_like_an_oil_can", 0.2, 2.0, Place::both_tendons, oil_can,
             [](const D& d) -> N { return {d.size, (0.2 + 0.3 * d.share) * d.pretension(), d.sign}; }),
      acting("lock_nut_shaken_loose", 0.01, 0.15, Place::one_tendon, shaken_lock_nut, [](const D& d) -> N { return {d.size}; }),
      acting("ferrule_slipping_at_each_jerk", 0.2, 3.0, Place::one_tendon, jerked_ferrule,
             [](const D& d) -> N { return {d.size, 0.05 * d.pretension()}; }, {"tendon_slip"}),  // several of them
      acting("tape_wandering_on_its_drum", 0.2, 2.5, Place::one_tendon, wandering_tape,
             [](const D& d) -> N { return {d.size, 0.3 + 0.7 * d.share}; }),
      acting("wires_and_pins_galling", 500.0, 8000.0, Place::dry_friction, galling,
             [](const D& d) -> N { return {d.size, d.pretension(), 5.0 + 20.0 * d.share}; }, {"capstan_friction"}),  // in the end
      acting("buffer_spring_closing_up", 0.15, 2.0, Place::both_tendons, buffer_spring,
             [](const D& d) -> N { return {d.size, (1.1 + 0.8 * d.share) * d.pretension(), d.pretension()}; }, {"tendon_stretch"}),  // up to a pull
      acting("tendon_over_edge_of_cover", 500.0, 10000.0, Place::dry_friction, edge_of_cover,
             [](const D& d) -> N { return {d.size, d.pretension(), d.theta_within(), d.sign, 0.3}; }),

      acting("ball_rolling_in_hollow_link", 200.0, 5000.0, Place::joint_torque, rolling_ball,
             [](const D& d) -> N { return {d.sign * d.size, radians(2.0 + 8.0 * d.share)}; }),
      acting("bearing_ring_creeping_round", 0.1, 1.0, Place::both_tendons, creeping_ring,
             [](const D& d) -> N { return {d.size, 4.0 + 12.0 * d.share, d.angle}; }),
      acting("axle_with_ball_catch", 200.0, 3000.0, Place::joint_torque, notches,
             [](const D& d) -> N { return {d.size, 12.0 + std::floor(18.9 * d.share), d.angle}; }),
      acting("link_moved_under_water", 500.0, 8000.0, Place::joint_torque, under_water, [](const D& d) -> N { return {d.size}; }),
      acting("gusts_through_a_window", 200.0, 3000.0, Place::joint_torque, gusts,
             [](const D& d) -> N { return {d.sign * d.size, 1.0 + 5.0 * d.share, chance(d)}; }),
      acting("axle_nut_tightening_itself", 500.0, 8000.0, Place::dry_friction, tightening_nut, [](const D& d) -> N { return {d.size}; }),

      acting("compressor_refilling_its_tank", 0.1, 0.8, Place::load, refilled_tank,
             [](const D& d) -> N { return {d.size, 8.0 + 32.0 * d.share, d.angle / k_two_pi}; }),
      acting("air_for_load_throttled", 1.0, 12.0, Place::load, through_throttle, [](const D& d) -> N { return {d.size}; }),
      acting("motor_for_load_a_dynamo", 1.0, 15.0, Place::load, dynamo, [](const D& d) -> N { return {d.size}; }),
      acting("gas_for_load_cooling", 0.01, 0.08, Place::load, vapour, [](const D& d) -> N { return {d.size}; }),

      acting("sunbeam_passing_sensor", 0.01, 0.15, Place::reading, sunbeam,
             [](const D& d) -> N { return {d.sign * d.size, 10.0 + 40.0 * d.share, 8.0}; }),
      acting("sensor_on_its_own_beat", 0.05, 0.8, Place::reading, own_beat, [](const D& d) -> N { return {d.size}; }, {"sensor_lag"}),  // on average
      acting("polynomial_of_too_high_degree", 4e-3, 0.05, Place::reading, polynomial, [](const D& d) -> N {
               const Joint& joint = d.joint.declared.joint;
               return {d.sign * d.size, 0.5 * (joint.theta_min + joint.theta_max), 0.5 * (joint.theta_max - joint.theta_min)};
             }),
      acting("popcorn_in_amplifier", 8e-3, 0.1, Place::reading, popcorn,
             [](const D& d) -> N { return {d.sign * d.size, 1.0 + 9.0 * d.share, chance(d)}; }),
      acting("laser_on_grainy_rim", 3e-3, 0.04, Place::reading, grain_of_rim,
             [](const D& d) -> N { return {d.size, radians(0.5 + 3.0 * d.share), chance(d)}; }),
      acting("computer_busy_with_steps", 0.05, 0.8, Place::reading, busy_computer,
             [](const D& d) -> N { return {d.size, 2.0 + 2.0 * d.share}; }, {"sensor_lag"}),  // in fast runs
      acting("hair_spring_run_down", 8e-3, 0.1, Place::reading, spring_run_down,
             [](const D& d) -> N { return {d.size, d.theta_within(), d.sign}; }),
      acting("span_set_before_each_run", 5e-3, 0.06, Place::reading, span_set_anew,
             [](const D& d) -> N { return {d.size, chance(d)}; }, {"joint_sensor_gain"}),  // another one in each run
      acting("clock_hunting_for_the_other", 0.03, 0.4, Place::reading, hunting_clock,
             [](const D& d) -> N { return {d.size, 20.0 + 60.0 * d.share, d.angle}; }),
      acting("shorted_turns_in_potentiometer", 0.01, 0.12, Place::reading, shorted_turns,
             [](const D& d) -> N { return {d.size, d.theta_within()}; }),
  };
}
// clang-format on

}  // namespace fusee::rig
