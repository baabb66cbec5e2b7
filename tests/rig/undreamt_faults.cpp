// A twelfth split that is kept aside: what goes wrong with tendon joints on real benches, by a thirteenth hand that saw
// neither how calibration infers nor what it makes of the other splits. Nothing is tuned on these; they are run once.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "rig/fault_shapes.h"
#include "rig/faults.h"
#include "rig/random.h"

namespace fusee::rig {
namespace undreamt {

using namespace short_names;

double number_of(const C& c) { return std::floor(1e6 * c.angle); }
/// Of a chord over an arc: nothing at both ends of each span, 1 in its middle; `x` in spans.
double sagged(double x) {
  const double within = x - std::floor(x);
  return 4.0 * within * (1.0 - within);
}
/// +1, −1, or 0.
double sign_of(double x) { return (x > 0 ? 1.0 : 0.0) - (x < 0 ? 1.0 : 0.0); }

// ---- motor, gearbox, shaft ------------------------------------------------------------------------------------------

/// A motor whose controller was set to be gentle: the shaft comes after the command, which is what is logged, as a
/// filter of the first order, n[0] s. In practice 10 … 300 ms. A sensor that is late leaves the joint where it should
/// be: this is late by the motor's way, and its end of a stroke is cut off. `memory`: the command, by how much behind.
double gentle_controller(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.alpha, 0.0};
  const double speed = now.seconds > 0 ? (now.alpha - memory[0]) / now.seconds : 0.0;
  memory[0] = now.alpha;
  if (!(n[0] > 0)) return 0.0;
  return -followed(speed * n[0], now.seconds, n[0], memory[1]);
}

/// The motor stands on rubber buffers, which give way late (Kelvin and Voigt): its body turns before the load by n[0]
/// for n[1] N, with the time constant n[2] s. In practice 0.1 … 3 deg at full load, 3 … 30 s. A clutch that creeps
/// never ends, a coupling's spider gives at once, a tendon that creeps does so by its own pull and the decade: this
/// goes by the load, to an end, and comes back.
double rubber_mounts(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0};
  return -n[0] * followed(now.load / n[1], now.seconds, n[2], memory[0]);
}

/// A belt between motor and pulley gives with both its spans as long as both are taut; beyond n[1] N one of them hangs,
/// and it is half as stiff: the shaft goes back by n[0] more for each n[1] N beyond. In practice 0.1 … 2 deg at full
/// load. (What it gives up to there is left out.) Stretch is in proportion from the first newton on, what slips stays.
double one_span_slack(const Moment& now, const N& n, N&) {
  return -n[0] * std::copysign(std::max(0.0, std::abs(now.load) / n[1] - 1.0), now.load);
}

/// The pulley is turned by a hydraulic line with an air bubble in it. That is pressed together by a load (Boyle), and
/// grows the faster under the other: the shaft goes back by n[0] x / (1 + x), x the load by the n[1] N of the line's
/// own pressure, four fifths of it at most the other way. In practice 0.5 … 10 deg. What stretches gives as much either
/// way.
double bubble_in_line(const Moment& now, const N& n, N&) {
  const double x = std::max(-0.8, now.load / n[1]);
  return -n[0] * x / (1.0 + x);
}

/// The motor's disc is not cut about its middle, and a table makes up for that, but for the angle of n[0] s ago: a wave
/// of the height n[1], n[2] a turn, is taken off too late, so that there stays one in proportion to the speed. n[3]
/// round at home. In practice 1 … 50 ms, 0.5 … 2 deg. A wave of the sensor is as high at any speed, and a late sensor
/// is as late anywhere: this is their product.
double corrected_too_late(const Moment& now, const N& n, N&) {
  const double x = n[2] * now.alpha + n[3];
  return n[1] * (std::sin(x) - std::sin(x - n[2] * now.alpha_speed * n[0]));
}

// ---- pulley, tendons, frame -----------------------------------------------------------------------------------------

/// A flat tape for a tendon, n[0] mm thick, that winds on itself from the first turn on, as a film on its reel: its
/// radius grows evenly with what is wound (Archimedes), and the way with the square. In practice 0.1 … 0.6 mm. Turns
/// that lie on others from one place on make a corner, a wrong radius a straight line: this is round all over.
double tape_on_itself(const Moment& now, const N& n, N&) { return n[0] * now.alpha * now.alpha / (2.0 * k_two_pi); }

/// One disc of the pulley sits askew on the shaft and wobbles to and fro: the tendon leaves it to one side, and its way
/// is longer by the square of that, n[0] mm at most (z² / 2 L), n[1] round at home. In practice 0.02 … 0.5 mm. A
/// runout is once a turn; this twice, and never a way less than that of a straight one.
double wobbling_disc(const Moment& now, const N& n, N&) {
  return n[0] * (std::pow(std::sin(now.alpha + n[1]), 2) - std::pow(std::sin(n[1]), 2));
}

/// A chain of beads for a tendon, as on a blind, in a wheel with n[1] pockets: between two of them it lies straight, a
/// polygon in the place of a circle, and its way is longer by up to n[0] mm, with a corner at each pocket; n[2] round
/// at home. In practice 0.02 … 0.3 mm. Cogs and teeth make sines, and do so in both tendons.
double chain_of_beads(const Moment& now, const N& n, N&) {
  const double phase = n[2] / k_two_pi;
  return n[0] * (sagged(n[1] * now.alpha / k_two_pi + phase) - sagged(phase));
}

/// One link of a chain is rusted stiff, and where it comes off the pulley, at α = n[1] (n[2] wide), it stands off bent
/// until it is pulled straight: a way longer by n[0] mm without a pull, by half of that under n[3] N. In practice 0.1 …
/// 2 mm. A lump is as high under any pull; what is softer where it is slack is so at any place.
template <std::size_t side>
double stiff_link(const Moment& now, const N& n, N&) {
  return n[0] * bump((now.alpha - n[1]) / n[2]) / (1.0 + std::max(0.0, now.tension[side]) / n[3]);
}

/// The clamp that holds a tendon on the pulley strikes the frame near the stroke's end, whenever the motor comes beyond
/// α = n[1], and is driven back a little: the tendon is n[0] mm longer with each blow. n[2]: it must have been as far
/// away before it is struck again. In practice 0.01 … 0.3 mm a blow. Slip is one moment, knots and turnbuckles go by
/// pulls or by the way: this counts the visits to a place. `memory`: whether it may be struck, blows so far.
double struck_clamp(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {1.0, 0.0};
  if (memory[0] > 0 && now.alpha > n[1]) memory[0] = 0.0, memory[1] += 1.0;
  if (now.alpha < n[1] - n[2]) memory[0] = 1.0;
  return -n[0] * memory[1];
}

/// Soft fibres on polished pins do not rub in proportion to their pull but with its power of two thirds, by the area
/// that they touch with (Hertz; Howell): n[0] N·mm of dry friction on the joint at n[1] N in both. In practice 50 …
/// 2000 N·mm (nylon). A capstan's is in proportion: this is too great where a tendon is nearly slack, and too small
/// under a load.
double howells_law(const Moment& now, const N& n, N&) {
  const auto rubs = [&](double tension) { return std::pow(std::max(0.0, tension) / n[1], 2.0 / 3.0); };
  return 0.5 * n[0] * (rubs(now.tension[0]) + rubs(now.tension[1]));
}

/// The pulley is pressed on the motor's shaft and gets warm by what that does: it grows, and winds n[0] mm more for a
/// radian when the motor has long gone with 1 rad/s, and with the square of that, n[1] s late. In practice 0.005 … 0.1
/// mm (printed). A pulley that shrinks as the room cools goes one way only, a wrong scale is as wrong in every run:
/// this comes with fast ones.
template <std::size_t side>
double pulley_warmed(const Moment& now, const N& n, N& memory) {
  constexpr double sign = side == 1 ? 1.0 : -1.0;
  if (memory.empty()) memory = {0.0};
  return sign * n[0] * now.alpha * followed(now.alpha_speed * now.alpha_speed, now.seconds, n[1], memory[0]);
}

/// The pulley's stand is held by one guy wire. A load of n[1]'s sign leans on that, and nothing is seen; one to
/// the other side lets it hang, and the stand gives way: one tendon's way is longer by n[0] mm at n[2] N, the other's
/// shorter. In practice 0.05 … 1 mm. A frame gives to either side, and by what its tendons pull.
template <std::size_t side>
double guyed_stand(const Moment& now, const N& n, N&) {
  constexpr double sign = side == 1 ? -1.0 : 1.0;
  return -sign * n[1] * n[0] * std::max(0.0, -n[1] * now.load) / n[2];
}

// ---- joint ----------------------------------------------------------------------------------------------------------

/// A link of printed plastic shrinks along its length as it cools: its end comes nearer to the axis by n[0] mm for each
/// K. In practice 0.002 … 0.03 mm/K. A link too short is so in all runs, and what expands in a tendon does as much at
/// any place: this is their product.
template <std::size_t side>
double shrinking_link(const Moment& now, const N& n, N&) {
  return nearer<side>(now, n[0] * now.warmth * Vec2(std::sin(now.theta), std::cos(now.theta)));
}

/// A joint full of thick grease that is thinned by shear: it drags with a power of the speed, n[0] N·mm at n[1] rad/s
/// and three quarters of that at half (0.4). In practice 50 … 3000 N·mm. A bearing rubs as much at any speed, oil in
/// proportion to it: this lies between them.
double shear_thinned(const Moment& now, const N& n, N&) {
  return n[0] * std::pow(std::abs(now.theta_speed) / n[1], 0.4);
}

/// The joint's seal is of the wrong rubber and swells in the oil that somebody gave it before the session: dry friction
/// that grows to n[0] N·mm with the time constant n[1] s. In practice 50 … 2000 N·mm, one to five minutes. A bearing
/// runs in by its way and gets better, a seal that sets is torn off: this only grows, by the clock.
double swelling_seal(const Moment& now, const N& n, N&) { return n[0] * (1.0 - std::exp(-now.time / n[1])); }

/// A magnet in the link passes a plate of copper, and is braked by the currents that it drives there: n[0] N·mm·s about
/// θ = n[1], n[2] wide. In practice 20 … 2000 N·mm·s. Grease drags anywhere, a place that rubs does so at any speed,
/// and a catch of iron holds at rest: this is place times speed.
double braked_by_copper(const Moment& now, const N& n, N&) {
  return -n[0] * now.theta_speed * bump((now.theta - n[1]) / n[2]);
}

/// Two magnets for a buffer push the link back from the end of its range, θ = n[1] to the side n[2]: n[0] N·mm where
/// they nearly touch, and with the fourth power of the distance less, n[3] rad between them there. In practice 100 …
/// 5000 N·mm. A stop begins at a place: this never begins, and is steep at the end alone.
double repelling_magnets(const Moment& now, const N& n, N&) {
  const double apart = std::max(0.0, n[2] * (n[1] - now.theta));
  return -n[2] * n[0] * std::pow(n[3] / (n[3] + apart), 4);
}

/// A fan that turns its head blows on the link each time it looks that way: n[0] N·mm where it strikes that broadside,
/// at home, every 2 π / n[1] s, n[2] on in that when the session begins. In practice 10 … 500 N·mm, every 6 … 20 s. Who
/// breathes pushes and pulls in turn: this comes in short gusts to one side, and less of it where the link has turned.
double swinging_fan(const Moment& now, const N& n, N&) {
  return n[0] * std::exp(6.0 * (std::cos(n[1] * now.time + n[2]) - 1.0)) * std::cos(now.theta);
}

// ---- load -----------------------------------------------------------------------------------------------------------

/// An air cylinder pulls in the place of a weight, and its seal sticks after each reversal, the more the shorter ago:
/// n[0] N against the way, down to 1/e within n[1] rad of the motor. In practice 0.5 … 10 N. A wheel under the cord
/// rubs all the way and in proportion: this is a jerk at each begin, as great under half the load, and none without.
/// `memory`: the way, α, and how far since it turned.
double sticking_cylinder(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.direction, now.alpha, 0.0};
  memory[2] = now.direction == memory[0] ? memory[2] + std::abs(now.alpha - memory[1]) : 0.0;
  memory[0] = now.direction, memory[1] = now.alpha;
  return now.load == 0 ? 0.0 : n[0] * now.direction * std::exp(-memory[2] / n[1]);
}

/// The load is pulled by a coil in a field, driven by a fixed voltage: it gets hot with the square of its current, that
/// is, of the load, its resistance rises by the share n[0] when n[1] N have long pulled, n[2] s late, and it pulls
/// less. In practice 0.05 … 0.6, 10 … 60 s. A cell that creeps loses its share of any load alike: this of a great one
/// more, and the coil is still warm when it is switched on the other way round.
double hot_coil(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0};
  const double warmer = n[0] * followed(std::pow(now.load / n[1], 2), now.seconds, n[2], memory[0]);
  return -now.load * warmer / (1.0 + warmer);
}

/// Whoever takes the weight off leaves its cord with the empty hanger on the link: n[0] N to the side of the last load,
/// in all that is logged as unloaded after it. In practice 0.2 … 5 N. A pan that was never counted hangs there with the
/// load only: this without it only, and never before the first.
double hanger_left_on(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0};
  if (now.load != 0) memory[0] = sign_of(now.load);
  return now.load == 0 ? n[0] * memory[0] : 0.0;
}

/// A cylinder that is filled, shut and read once at home pulls as a spring of air: a radian against it presses the air
/// together by the share n[0], and it pulls the harder by Boyle's law. In practice 0.02 … 0.5. A weight's lever is a
/// wave of the angle, a band of rubber is softer on the way back: this bends upwards, and is the same both ways.
double shut_air(const Moment& now, const N& n, N&) {
  const double left = std::max(0.25, 1.0 - n[0] * sign_of(now.load) * now.theta);
  return now.load * (1.0 / left - 1.0);
}

// ---- joint's sensor, log --------------------------------------------------------------------------------------------

/// A slide gauge for a sensor, driven by a crank on the joint through a rod, n[0]: the crank by it, and reckoned as if
/// the rod were endless: off by the rod's own leaning, 1 − √(1 − n²cos²) by n, most of it at θ = n[1], where the crank
/// stands across. In practice 0.02 … 0.3. A wave twice a turn, but sharper. Home is set to nought.
double short_rod(const Moment& now, const N& n, N&) {
  if (!(n[0] > 0)) return 0.0;
  const auto leaned = [&](double x) { return (1.0 - std::sqrt(1.0 - std::pow(n[0] * std::cos(x), 2))) / n[0]; };
  return leaned(-n[1]) - leaned(now.theta - n[1]);
}

/// Two converters take turns, one reads while the other settles, and their zeros are n[0] apart: every other row is too
/// high by half of it, and those between too low. In practice 0.05 … 1 deg. Noise is of chance: this is of the row.
double converters_in_turn(const Moment&, const N& n, N& memory) {
  if (memory.empty()) memory = {1.0};
  memory[0] = -memory[0];
  return -0.5 * n[0] * memory[0];
}

/// At the session's n[1]th second the clock of the joint's computer is set right by the network, and its rows are from
/// n[0] s earlier ever after. In practice 20 … 500 ms. A late sensor is so from the begin, a clock that drifts more and
/// more.
double clock_set_right(const Moment& now, const N& n, N&) { return now.time > n[1] ? -n[0] * now.theta_speed : 0.0; }

/// Whenever the motor starts, or turns round, it draws a surge from the supply that the joint's sensor hangs on: what
/// is shown is off by n[0], to one side whichever way it starts, and comes back with the time constant n[1] s. In
/// practice 0.05 … 2 deg, 0.3 … 2 s. What rings or runs on does so to the side of the way. `memory`: the way, 0 at
/// rest; when.
double surge_at_starts(const Moment& now, const N& n, N& memory) {
  const double way = sign_of(now.alpha_speed);
  if (memory.empty()) memory = {0.0, -1e9};
  if (way != memory[0] && way != 0) memory[1] = now.time;
  memory[0] = way;
  return n[0] * std::exp((memory[1] - now.time) / n[1]);
}

/// The sensor's disc is taken off after each run and clamped on again, every time as far off its middle, n[0], and to
/// another side; n[1] numbers who. In practice 0.1 … 3 deg. An eccentric sensor has the same wave in all runs, a body
/// that is clamped by eye another zero: here home is set, and the wave is another one.
double clamped_anew(const Moment& now, const N& n, N&) {
  const double side = k_two_pi * numbered(n[1] + static_cast<double>(now.run), 131).share();
  return n[0] * (std::sin(now.theta + side) - std::sin(side));
}

/// A broken wire in the sensor's cable, that closes or opens with the bend: beyond θ = n[1] to the side n[2] it is
/// open, and what is shown drifts by n[0] with the time constant n[3] s, as its capacitor is filled; back there, it is
/// right at once. In practice 0.2 … 10 deg, 0.5 … 5 s. A rail holds what is shown at a height: this goes by how long
/// the joint has been there. `memory`: when, share of it.
double opened_by_bending(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.time, 0.0};
  const double since = now.time - memory[0];
  memory[0] = now.time;
  if (!(n[2] * (now.theta - n[1]) > 0)) return memory[1] = 0.0;
  return n[0] * followed(1.0, since, n[3], memory[1]);
}

/// A sensor that bends its angle is made straight by a table with an entry every n[2] rad (one at θ = n[1]), and
/// between them by chords: right at each, and off by n[0] halfway, to the same side in all. In practice 0.02 … 0.5 deg,
/// every 5 … 15. Waves go to both sides, and have no corners. Home is set to nought.
double chords_of_table(const Moment& now, const N& n, N&) {
  return n[0] * (sagged((now.theta - n[1]) / n[2]) - sagged(-n[1] / n[2]));
}

/// A zero that goes by chance, now up and now down, as a drop of resin on a strain gauge: a random walk by the clock,
/// n[0] (standard deviation) after a second and ten times that after a hundred; n[1] numbers it. In practice 0.002 …
/// 0.1 deg. One that walks does so at reversals, tapes and warmth to one side. `memory`: when, rows so far, off by.
double walk_by_chance(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.time, 0.0, 0.0};
  const double since = std::max(0.0, now.time - memory[0]);
  memory[0] = now.time;
  memory[2] += std::sqrt(since) * numbered(n[1] + memory[1]++, 137).normal();
  return n[0] * memory[2];
}

// ---- what is wrong --------------------------------------------------------------------------------------------------

/// The same in both tendons, or of opposite sign, as it stands in the function.
template <auto first, auto second>
void in_both(H& h, const char* name, const N& numbers) {
  h.longer[0].push_back({name, numbers, first});
  h.longer[1].push_back({name, numbers, second});
}

// clang-format off
std::vector<Fault> drive_faults() {
  return {
      {.name = "controller_too_gentle", .first = 0.02, .most = 0.4,
       .set = [](H& h, double s, const C&, const J&) {
         h.shaft.push_back({"gentle_controller", {s}, gentle_controller});
       },
       .kin = {"sensor_lag"}},  // geared
      {.name = "motor_on_rubber_mounts", .first = 0.01, .most = 0.15,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.shaft.push_back({"rubber_mounts", {s, pretension(j), 3.0 + 24.0 * c.share}, rubber_mounts});
       },
       .kin = {"creep"}},  // late, under a load
      {.name = "one_span_of_belt_slack", .first = 0.01, .most = 0.1,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.shaft.push_back({"one_span_slack", {s, (0.3 + 0.4 * c.share) * pretension(j)}, one_span_slack});
       },
       .kin = {"tendon_stretch"}},  // beyond a load
      {.name = "bubble_in_hydraulic_line", .first = 0.02, .most = 0.2,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.shaft.push_back({"bubble_in_line", {s, (1.5 + 1.5 * c.share) * pretension(j)}, bubble_in_line});
       },
       .kin = {"tendon_stretch"}},  // under small loads
      {.name = "wave_corrected_too_late", .first = 0.02, .most = 0.3,
       .set = [](H& h, double s, const C& c, const J&) {
         const N numbers = {s, 0.03, 1.0 + std::floor(2.9 * c.share), c.angle};
         h.shaft.push_back({"corrected_too_late", numbers, corrected_too_late});
       }},
  };
}

std::vector<Fault> tendon_faults() {
  return {
      {.name = "tape_wound_on_itself", .first = 0.3, .most = 5.0,
       .set = [](H& h, double s, const C& c, const J&) {
         h.longer[c.sign > 0 ? 1 : 0].push_back({"tape_on_itself", {s}, tape_on_itself});
       }},
      {.name = "disc_wobbling_on_shaft", .first = 0.1, .most = 2.0,
       .set = [](H& h, double s, const C& c, const J&) {
         h.longer[c.sign > 0 ? 1 : 0].push_back({"wobbling_disc", {s, c.angle}, wobbling_disc});
       },
       .kin = {"profile_error"}},  // two waves a turn, in one groove
      {.name = "chain_of_beads_for_tendon", .first = 0.1, .most = 1.0,
       .set = [](H& h, double s, const C& c, const J&) {
         const N numbers = {s, 8.0 + std::floor(9.0 * c.share), c.angle};
         h.longer[c.sign > 0 ? 1 : 0].push_back({"chain_of_beads", numbers, chain_of_beads});
       }},
      {.name = "stiff_link_in_chain", .first = 0.4, .most = 5.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const N numbers = {s, alpha_within(c, j), 0.12, pretension(j)};
         h.longer[1].push_back({"stiff_link", numbers, stiff_link<1>});
       }},
      {.name = "clamp_struck_at_end_of_stroke", .first = 0.1, .most = 1.5,
       .set = [](H& h, double s, const C& c, const J& j) {
         const double range = j.alpha_max - j.alpha_min;
         const N numbers = {s, j.alpha_max - 0.2 * range, 0.1 * range};
         h.longer[c.sign > 0 ? 1 : 0].push_back({"struck_clamp", numbers, struck_clamp});
       }},
      {.name = "fibres_rubbing_by_howells_law", .first = 300.0, .most = 8000.0,
       .set = [](H& h, double s, const C&, const J& j) {
         h.dry.push_back({"howells_law", {s, pretension(j)}, howells_law});
       },
       .kin = {"capstan_friction"}},  // less than in proportion
      {.name = "pulley_warmed_by_motor", .first = 0.3, .most = 4.0,
       .set = [](H& h, double s, const C& c, const J&) {
         in_both<pulley_warmed<0>, pulley_warmed<1>>(h, "pulley_warmed", {s, 10.0 + 50.0 * c.share});
       },
       .kin = {"pulley_scale"}},  // after fast runs
      {.name = "stand_guyed_on_one_side", .first = 0.2, .most = 2.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         in_both<guyed_stand<0>, guyed_stand<1>>(h, "guyed_stand", {s, c.sign, pretension(j)});
       },
       .kin = {"frame_compliance"}},  // to one side
  };
}

std::vector<Fault> joint_faults() {
  return {
      {.name = "link_shrinking_in_cold", .first = 0.02, .most = 0.5,
       .set = [](H& h, double s, const C&, const J&) {
         in_both<shrinking_link<0>, shrinking_link<1>>(h, "shrinking_link", {s});
       },
       .kin = {"joint_length"}},  // more and more
      {.name = "grease_thinned_by_shear", .first = 300.0, .most = 8000.0,
       .set = [](H& h, double s, const C&, const J&) { h.dry.push_back({"shear_thinned", {s, 0.5}, shear_thinned}); },
       .kin = {"joint_friction"}},  // with a power of the speed that is small
      {.name = "seal_swelling_in_oil", .first = 500.0, .most = 8000.0,
       .set = [](H& h, double s, const C& c, const J&) {
         h.dry.push_back({"swelling_seal", {s, 60.0 + 120.0 * c.share}, swelling_seal});
       },
       .kin = {"joint_friction"}},  // in the end
      {.name = "magnet_passing_copper", .first = 500.0, .most = 20000.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.torque.push_back({"braked_by_copper", {s, theta_within(c, j), 0.12}, braked_by_copper});
       }},
      {.name = "magnets_repelling_at_end", .first = 1000.0, .most = 20000.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const N numbers = {s, end_of_range(c, j), c.sign, 0.15 + 0.2 * c.share};
         h.torque.push_back({"repelling_magnets", numbers, repelling_magnets});
       }},
      {.name = "fan_swinging_past_link", .first = 300.0, .most = 8000.0,
       .set = [](H& h, double s, const C& c, const J&) {
         h.torque.push_back({"swinging_fan", {c.sign * s, 0.3 + 0.7 * c.share, c.angle}, swinging_fan});
       }},
      {.name = "cylinder_for_weight_sticking", .first = 2.0, .most = 20.0,
       .set = [](H& h, double s, const C& c, const J&) {
         h.load.push_back({"sticking_cylinder", {s, 0.05 + 0.3 * c.share}, sticking_cylinder});
       }},
      {.name = "coil_for_weight_growing_hot", .first = 0.1, .most = 1.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.load.push_back({"hot_coil", {s, pretension(j), 10.0 + 50.0 * c.share}, hot_coil});
       }},
      {.name = "hanger_left_on_after_load", .first = 1.0, .most = 10.0,
       .set = [](H& h, double s, const C&, const J&) { h.load.push_back({"hanger_left_on", {s}, hanger_left_on}); }},
      {.name = "cylinder_of_shut_air", .first = 0.1, .most = 1.0,
       .set = [](H& h, double s, const C&, const J&) { h.load.push_back({"shut_air", {s}, shut_air}); }},
  };
}

std::vector<Fault> sensor_faults() {
  return {
      {.name = "slide_gauge_on_short_rod", .first = 0.05, .most = 0.5,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.reading.push_back({"short_rod", {s, theta_within(c, j)}, short_rod});
       },
       .kin = {"joint_sensor_harmonic"}},  // two waves a turn
      {.name = "two_converters_in_turn", .first = 5e-3, .most = 0.06,
       .set = [](H& h, double s, const C&, const J&) {
         h.reading.push_back({"converters_in_turn", {s}, converters_in_turn});
       }},
      {.name = "clock_set_right_midway", .first = 0.05, .most = 0.8,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"clock_set_right", {s, 10.0 + 30.0 * c.share}, clock_set_right});
       },
       .kin = {"sensor_lag"}},  // from a moment on
      {.name = "surge_at_every_start", .first = 0.01, .most = 0.15,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"surge_at_starts", {c.sign * s, 0.3 + 1.7 * c.share}, surge_at_starts});
       }},
      {.name = "disc_clamped_anew_in_every_run", .first = 0.01, .most = 0.2,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"clamped_anew", {s, number_of(c)}, clamped_anew});
       },
       .kin = {"joint_sensor_eccentricity"}},  // another one in each run
      {.name = "wire_opening_when_bent", .first = 5e-3, .most = 0.15,
       .set = [](H& h, double s, const C& c, const J& j) {
         const N numbers = {s, theta_within(c, j), c.sign, 0.5 + 4.5 * c.share};
         h.reading.push_back({"opened_by_bending", numbers, opened_by_bending});
       }},
      {.name = "table_of_few_entries", .first = 4e-3, .most = 0.04,
       .set = [](H& h, double s, const C& c, const J& j) {
         const N numbers = {c.sign * s, theta_within(c, j), radians(5.0 + 10.0 * c.share)};
         h.reading.push_back({"chords_of_table", numbers, chords_of_table});
       }},
      {.name = "zero_walking_by_chance", .first = 1e-3, .most = 0.01,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"walk_by_chance", {s, number_of(c)}, walk_by_chance});
       }},
  };
}
// clang-format on

}  // namespace undreamt

std::vector<Fault> undreamt_faults() {
  using namespace undreamt;
  return joined({drive_faults(), tendon_faults(), joint_faults(), sensor_faults()});
}

}  // namespace fusee::rig
