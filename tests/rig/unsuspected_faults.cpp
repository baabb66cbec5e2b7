// A thirteenth split that is kept aside: what goes wrong with tendon joints on real benches, by a fourteenth hand that
// saw neither how calibration infers nor what it makes of the other splits. Nothing is tuned on these; they are run
// once.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "rig/fault_shapes.h"
#include "rig/faults.h"
#include "rig/random.h"

namespace fusee::rig {
namespace unsuspected {

using namespace short_names;

double number_of(const C& c) { return std::floor(1e6 * c.angle); }
/// +1, −1, or 0.
double sign_of(double x) { return (x > 0 ? 1.0 : 0.0) - (x < 0 ? 1.0 : 0.0); }
/// How far the motor has gone since it was last asked.
double gone(const Moment& now, double& last) {
  const double way = std::abs(now.alpha - last);
  last = now.alpha;
  return way;
}
double mean_tension(const Moment& now) { return 0.5 * (std::max(0.0, now.tension[0]) + std::max(0.0, now.tension[1])); }
double fraction(double x) { return x - std::floor(x); }

// ---- motor, gearbox, shaft ------------------------------------------------------------------------------------------

/// The pulley is driven through a wall by a ring of magnets, whose torque is a sine of how far one half lags: under a
/// load the shaft goes back by the arc sine of its share in n[1] N, at which it would fall out of step (all but that is
/// kept to), times n[0] rad, one over the pairs of poles. In practice 1/20 … 1/4. What stretches does so in proportion:
/// this the more the nearer it comes to its end, and to both sides alike.
double leaning_magnets(const Moment& now, const N& n, N&) {
  return -n[0] * std::asin(std::clamp(now.load / n[1], -0.98, 0.98));
}

/// A direct drive held in proportion to its error, whose force for an ampere is not the same all round: n[2] waves a
/// turn, n[3] round at home. Where it is weaker the error must be greater for the same load: the shaft goes back by
/// n[0] more at n[1] N, and where it is stronger by as much less. In practice 0.1 … 2 deg. (What it goes back by on an
/// average is left out.) Cogging is there without a load: this changes its side with that.
double force_not_even(const Moment& now, const N& n, N&) {
  return -n[0] * now.load / n[1] * std::sin(n[2] * now.alpha + n[3]);
}

/// A gear wheel of two halves, with a spring between that takes up all play, until a load to the side n[2] beats it
/// at n[1] N: within another quarter of that the halves close, and the shaft falls back by n[0], the whole of the play.
/// In practice 0.2 … 2 deg. Play is met at each reversal, a belt goes on giving: this is one step of the load, to one
/// side, and the same both ways.
double split_gear(const Moment& now, const N& n, N&) {
  return -n[2] * n[0] * std::clamp((n[2] * now.load / n[1] - 1.0) / 0.25, 0.0, 1.0);
}

/// A strain wave gear rubs within as it is wound up: its twist stays behind the load, n[0] at most, to the side from
/// which the load came, and is turned over when that has changed by twice n[2] of n[1] N. In practice 0.02 … 0.5 deg.
/// (What it twists in proportion is left out.) Play goes by the motor's way: this by the load's, and it tells unloaded
/// runs after one load from those after the other. `memory`: the load that it has followed to.
double rubbing_within(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0};
  const double load = now.load / n[1];
  return n[0] * (load - behind(load, n[2], memory[0])) / n[2];
}

/// A worm whose thrust bearing is at its far end gets shorter as it cools, and screws the wheel back: n[0] rad for each
/// K. In practice 5e-5 … 3e-3 (a printed wheel). At any place and under any load the same.
double shrinking_worm(const Moment& now, const N& n, N&) { return n[0] * now.warmth; }

/// A vee belt sinks into its smaller wheel as it pulls, whichever way: that wheel is smaller under a load, by the share
/// n[0] at n[1] N, and so is the shaft's way from home. In practice 0.001 … 0.03. What gives does so to the side of the
/// load: this is a ratio, the same under both loads.
double sinking_belt(const Moment& now, const N& n, N&) { return -n[0] * now.alpha * std::abs(now.load) / n[1]; }

/// The pulley's shaft runs in a wide plain bush full of oil. At rest it lies on the bottom; as it turns, it is carried
/// up to the side and, faster, to the middle: half a circle (Sommerfeld). With ε = 1 / (1 + speed / n[1]) of the gap it
/// stands 2 ε √(1 − ε²) of n[0] mm to the side: all of that at a speed of 0.41 n[1] rad/s, less when slower and when
/// faster; one tendon's way is longer by it and the other's shorter, and after a reversal the other way about. In
/// practice 0.02 … 0.5 mm. An axle that climbs in a dry hole does so at any speed.
template <std::size_t side>
double carried_by_oil(const Moment& now, const N& n, N&) {
  constexpr double sign = side == 1 ? 1.0 : -1.0;
  const double low = 1.0 / (1.0 + std::abs(now.alpha_speed) / n[1]);
  return sign * n[0] * sign_of(now.alpha_speed) * 2.0 * low * std::sqrt(1.0 - low * low);
}

// ---- tendons, pins, frame -------------------------------------------------------------------------------------------

/// A tendon of nickel and titanium changes its crystals from n[1] N on, over another n[3], and is n[0] mm longer when
/// all are changed; they change back from that n[3] above n[2] N, which is less, down to n[2]. In practice 0.2 … 5 mm.
/// Stretch is the same pulled and let go, and knots never come back: this comes back, but late. `memory`: the share
/// changed.
template <std::size_t side>
double changing_crystals(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0};
  const auto share = [&](double from) { return std::clamp((now.tension[side] - from) / n[3], 0.0, 1.0); };
  return n[0] * (memory[0] = std::clamp(memory[0], share(n[1]), share(n[2])));
}

/// A thin panel that carries the pins is not quite flat and pops over like the bottom of an oil can when a load of
/// n[1] N comes to the side n[2], by n[0] mm; it stays there without a load, and pops back under a third of that to the
/// other side. In practice 0.05 … 1 mm. A frame gives in proportion: this has two places, and remembers. `memory`: 1
/// where it has popped over.
template <std::size_t side>
double oil_can(const Moment& now, const N& n, N& memory) {
  constexpr double sign = side == 1 ? -1.0 : 1.0;
  if (memory.empty()) memory = {0.0};
  const double load = n[2] * now.load / n[1];
  if (load >= 1.0) memory[0] = 1.0;
  if (load <= -1.0 / 3.0) memory[0] = 0.0;
  return sign * n[2] * n[0] * memory[0];
}

/// The lock nut of a pin's adjusting screw is shaken loose (Junker) as the motor runs fast: the screw backs off, and
/// the tendon's way is shorter by n[0] mm for each rad at 1 rad/s, more with the square of the speed (up to 3). In
/// practice 1e-4 … 0.05 mm. What works loose by the way, by loads or reversals does so as much in slow runs. `memory`:
/// α, way times the speed's square.
double shaken_lock_nut(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.alpha, 0.0};
  memory[1] += gone(now, memory[0]) * std::pow(std::min(3.0, std::abs(now.alpha_speed)), 2);
  return -n[0] * memory[1];
}

/// Whoever hangs the weight on lets it fall the last finger's breadth, and at each such jerk the ferrule on a tendon
/// slips by n[0] mm; n[1] N is the least that counts as one. In practice 0.02 … 0.5 mm. A slip has one moment: this one
/// in every loaded run, and none while the load stays on. `memory`: 1 under a load, jerks so far.
double jerked_ferrule(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0, 0.0};
  const double loaded = std::abs(now.load) > n[1] ? 1.0 : 0.0;
  if (loaded > memory[0]) memory[1] += 1.0;
  memory[0] = loaded;
  return n[0] * memory[1];
}

/// A flat tape on a crowned drum wanders sideways as a belt does, to the one side while it is wound and to the other
/// while it is let go, and its way is longer there by n[0] mm, here shorter; it takes n[1] rad for 63 % of that. In
/// practice 0.05 … 0.5 mm. Play is taken up at once and then stays: this loop opens all along the stroke. `memory`: α,
/// where it runs.
double wandering_tape(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.alpha, 0.0};
  const double way = gone(now, memory[0]);
  return n[0] * followed(now.direction, way, n[1], memory[1]);
}

/// Steel wires on pins of soft steel without a drop of oil: both are torn (galling), and they rub by n[0] N·mm more at
/// n[1] N in both in the end; it comes with the work, 63 % of it in n[2] rad under that pull. In practice 100 … 3000
/// N·mm. A capstan rubs from the begin, a seal swells by the clock. `memory`: α, work.
double galling(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.alpha, 0.0};
  const double pull = mean_tension(now) / n[1];
  memory[1] += pull * gone(now, memory[0]);
  return n[0] * pull * (1.0 - std::exp(-memory[1] / n[2]));
}

/// A spiral spring in a tendon, put there as a buffer, gives by n[0] mm for n[2] N, the pretension, until its coils
/// touch at n[1] N: from there on it is a rod. In practice 0.2 … 5 mm. A spring that is drawn open gives beyond a pull
/// only, a tendon hardens evenly.
template <std::size_t side>
double buffer_spring(const Moment& now, const N& n, N&) {
  return n[0] * (std::clamp(now.tension[side], 0.0, n[1]) / n[2] - 1.0);
}

/// From θ = n[2] on to the side n[3] the tendon on the far side is bent over the edge of the link's cover: its bend
/// grows evenly over n[4], and it rubs by up to n[0] N·mm at n[1] N. In practice 50 … 2000 N·mm. A place that rubs is
/// passed and does so under any pull, a pin's bend is nearly as great anywhere.
double edge_of_cover(const Moment& now, const N& n, N&) {
  const double pull = std::max(0.0, now.tension[n[3] > 0 ? 0 : 1]) / n[1];
  return n[0] * pull * std::clamp(n[3] * (now.theta - n[2]) / n[4], 0.0, 1.0);
}

// ---- joint ----------------------------------------------------------------------------------------------------------

/// A bearing's ball was left in a hollow part across the link and rolls to its lower end: over when the joint was
/// beyond n[1], back when it was beyond that on the other side: n[0] N·mm to the side where it lies (< 0: the link
/// hangs, and that is the side away from which it went). In practice 5 … 300 N·mm. A weight that is fixed has a lever
/// by the place, water flows as the link turns: this lies at either end, and where depends on the way there. `memory`:
/// its side, 0 in the middle before; θ before.
double rolling_ball(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0, 0.0};
  if (std::abs(memory[1]) > n[1]) memory[0] = sign_of(memory[1]);
  memory[1] = now.theta;
  return n[0] * memory[0] * std::cos(now.theta);
}

/// The outer ring of the joint's bearing is loose in its seat and creeps round in it, a rad for every n[1] rad of the
/// motor either way; as it is not as thick all round, the axis goes round a circle of n[0] mm, n[2] on in that at
/// first. In practice 0.01 … 0.2 mm. What runs out goes to and fro with the joint: this goes on and on. `memory`: α,
/// way.
template <std::size_t side>
double creeping_ring(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.alpha, 0.0};
  memory[1] += gone(now, memory[0]);
  const double round = n[2] + memory[1] / n[1];
  const Vec2 moved(std::cos(round) - std::cos(n[2]), std::sin(round) - std::sin(n[2]));
  return nearer<side>(now, n[0] * moved);
}

/// The joint's axle was taken from a lamp and has a ball catch with n[1] notches a turn, which draws the link to the
/// nearest one, n[0] N·mm at most; n[2] round at home. In practice 50 … 1000 N·mm. A motor that cogs turns the shaft,
/// whatever pulls; a sensor with a wave shows more than is there: this moves the link, by as much as the tendons give.
double notches(const Moment& now, const N& n, N&) { return -n[0] * std::sin(n[1] * now.theta + n[2]); }

/// The joint is tried under water, for a swimming robot, and the link drags with the square of its speed: n[0] N·mm
/// when the motor goes with 1 rad/s. In practice 20 … 500 N·mm, a paddle 3000. A bearing drags as much at any speed,
/// thick grease in proportion or less, this hardly at all in slow runs.
double under_water(const Moment& now, const N& n, N&) { return -n[0] * now.alpha_speed * std::abs(now.alpha_speed); }

/// A window is open and gusts push the link to one side, by n[0] N·mm on an average of a long time: the square of a
/// wind that comes and goes by chance within n[1] s; n[2] numbers it. In practice 5 … 200 N·mm. A fan comes round with
/// its period; noise is another one in every row. `memory`: wind, steps so far.
double gusts(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0, 0.0};
  const double left = std::exp(-std::max(0.0, now.seconds) / n[1]);
  memory[0] = left * memory[0] + std::sqrt(1.0 - left * left) * numbered(n[2] + memory[1]++, 149).normal();
  return n[0] * memory[0] * memory[0];
}

/// The nut at the end of the axle is taken round by the link: it tightens by all of a way to +θ and is loosened by four
/// fifths of a way back only, and the joint rubs by n[0] N·mm for each rad. In practice 50 … 2000 N·mm. A thread that
/// the axle sits in goes by the place; a seal by the clock: this has both a side and a past. `memory`: θ, tightened by.
double tightening_nut(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.theta, 0.0};
  const double way = now.theta - memory[0];
  memory[0] = now.theta;
  memory[1] = std::max(0.0, memory[1] + (way > 0 ? way : 0.8 * way));
  return n[0] * memory[1];
}

// ---- load -----------------------------------------------------------------------------------------------------------

/// Load by compressed air from a small tank: its pressure falls evenly as it leaks, and every n[1] s the compressor
/// cuts in and fills it at once; the load is wrong by the share n[0] from top to bottom, right on an average. n[2] of a
/// period has gone when the session begins. In practice 0.02 … 0.3, every 8 … 60 s. A pull that wavers is a wave, what
/// runs down does so once.
double refilled_tank(const Moment& now, const N& n, N&) {
  return now.load * n[0] * (0.5 - fraction(now.time / n[1] + n[2]));
}

/// Load by air through a throttle that is nearly shut: it comes on and goes off with the time constant n[0] s while
/// what is logged is what was set. In practice 0.2 … 10 s. What gives late under a load ends elsewhere; this ends
/// where it should, and what was set before acts on in the next run. `memory`: what acts.
double through_throttle(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0};
  if (!(n[0] > 0)) return 0.0 * (memory[0] = now.load);
  return followed(now.load, std::max(0.0, now.seconds), n[0], memory[0]) - now.load;
}

/// A motor for a load, fed by a voltage and not by a current: as it is turned it is a dynamo too, and pulls less when
/// it goes along and more when it is dragged back, by n[0] N at 1 rad/s of the pulley. In practice 0.2 … 5 N. Grease
/// drags without a load as well.
double dynamo(const Moment& now, const N& n, N&) { return now.load != 0 ? n[0] * now.alpha_speed : 0.0; }

/// Load by a cylinder that hangs on a can of liquid gas: its pressure goes with the warmth, the share n[0] for each K.
/// In practice 0.003 (no liquid) … 0.03. A cell whose zero drifts is as wrong without a load; a bag that drips loses a
/// weight and not a share, and to a different end.
double vapour(const Moment& now, const N& n, N&) { return now.load * std::clamp(n[0] * now.warmth, -0.95, 0.95); }

// ---- joint's sensor, log --------------------------------------------------------------------------------------------

/// A sunbeam comes through the blinds and passes over the sensor's photo diodes: off by n[0] at the session's n[1]th
/// second, n[2] s wide. In practice 0.05 … 3 deg, 5 … 60 s. A zero that walks or warms does not come back.
double sunbeam(const Moment& now, const N& n, N&) { return n[0] * bump((now.time - n[1]) / n[2]); }

/// The sensor measures every n[0] s on a beat of its own, and whoever asks between is told the last one: up to that
/// old, 37 % of it when the session begins. In practice 5 … 200 ms. A late sensor is as late in every row: this by
/// another time in each, on an average by half.
double own_beat(const Moment& now, const N& n, N&) {
  if (!(n[0] > 0)) return 0.0;
  return -now.theta_speed * n[0] * fraction(now.time / n[0] + 0.37);
}

/// What the maker's sensor shows is made straight by a polynomial of the fifth degree through too few points: it swings
/// by n[0] to both sides, as the polynomial of Chebyshev does, five noughts within n[2] to either side of θ = n[1], and
/// runs away beyond. In practice 0.02 … 1 deg. A sensor's wave goes round with a turn. Home is set to nought.
double polynomial(const Moment& now, const N& n, N&) {
  const auto swung = [&](double theta) {
    const double x = std::clamp((theta - n[1]) / n[2], -1.2, 1.2);
    return x * (5.0 + x * x * (16.0 * x * x - 20.0));
  };
  return n[0] * (swung(now.theta) - swung(0.0));
}

/// Popcorn noise: one dirty transistor of the sensor's amplifier jumps by chance between two states, 0 and n[0], in
/// each for n[1] s on an average; n[2] numbers it. In practice 0.02 … 0.5 deg, 0.1 … 30 s. Noise has no two places, and
/// a zero that walks does not come back to one. `memory`: when, state, rows so far.
double popcorn(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.time, 0.0, 0.0};
  const double since = std::max(0.0, now.time - memory[0]);
  memory[0] = now.time;
  const double other = 0.5 * (1.0 - std::exp(-2.0 * since / n[1]));
  if (numbered(n[2] + memory[2]++, 151).share() < other) memory[1] = 1.0 - memory[1];
  return n[0] * memory[1];
}

/// A laser looks at a sand-cast rim: what is shown goes up and down with its grain, n[0] (standard deviation) at points
/// n[1] apart and straight between them, by chance, but the same whenever that place comes by; n[2] numbers the rim. In
/// practice 0.02 … 0.3 deg, every 0.5 … 3. Noise is another one in each pass, waves have a period. Home is set to
/// nought.
double grain_of_rim(const Moment& now, const N& n, N&) {
  const auto grain = [&](double theta) {
    const double x = std::clamp(theta / n[1], -4e3, 4e3) + 5e3;
    const double before = std::floor(x);
    const auto at = [&](double point) { return numbered(n[2] + point, 157).normal(); };
    return at(before) + (x - before) * (at(before + 1.0) - at(before));
  };
  return n[0] * (grain(now.theta) - grain(0.0));
}

/// One computer makes the motor's steps and reads the sensor when it has time left, and what is read waits in a queue:
/// with x the share of its time that steps take, all of it at n[1] rad/s, a row is n[0] x / (1 − x) s old (x up to
/// 0.9). In practice 5 … 200 ms. A late sensor is so by the same time at any speed.
double busy_computer(const Moment& now, const N& n, N&) {
  const double busy = std::min(0.9, std::abs(now.alpha_speed) / n[1]);
  return -now.theta_speed * n[0] * busy / (1.0 - busy);
}

/// The gear of the sensor has a hair spring against its play, which has run down before the end of the range: beyond θ
/// = n[1] to the side n[2] there is a play of n[0] in what is shown, and none before. In practice 0.1 … 2 deg.
/// `memory`: what is shown.
double spring_run_down(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.theta};
  if (!(n[2] * (now.theta - n[1]) > 0)) return 0.0 * (memory[0] = now.theta);
  behind(now.theta, 0.5 * n[0], memory[0]);
  memory[0] = n[2] > 0 ? std::max(memory[0], n[1]) : std::min(memory[0], n[1]);  // up to there it is held
  return memory[0] - now.theta;
}

/// Somebody sets the span of the sensor's amplifier before every run, by a screw and a mark: what is shown is too much
/// by a share that is drawn for the run, n[0] (standard deviation); n[1] numbers who. In practice 0.001 … 0.03. A wrong
/// gain is the same in all runs.
double span_set_anew(const Moment& now, const N& n, N&) {
  return n[0] * now.theta * numbered(n[1] + static_cast<double>(now.run), 163).normal();
}

/// The clock of the sensor's computer is made to follow the motor's by a loop that hunts: the stamps are early and late
/// in turn by up to n[0] s, once in n[1] s, n[2] on in that when the session begins. In practice 5 … 100 ms, 20 … 120
/// s. A clock that drifts or is set right is late to one side.
double hunting_clock(const Moment& now, const N& n, N&) {
  return -now.theta_speed * n[0] * std::sin(k_two_pi * now.time / n[1] + n[2]);
}

/// Some turns of a wire-wound potentiometer touch one another: from θ = n[1] on what is shown stands still for n[0],
/// and lacks that ever after. In practice 0.1 … 2 deg. A bad entry of a table is wrong at its place only, play depends
/// on the way. Home is set to nought.
double shorted_turns(const Moment& now, const N& n, N&) {
  const auto lacks = [&](double theta) { return std::clamp(theta - n[1], 0.0, std::max(0.0, n[0])); };
  return lacks(0.0) - lacks(now.theta);
}

// ---- what is wrong --------------------------------------------------------------------------------------------------

/// In both tendons, as it stands in the function.
template <auto first, auto second>
void in_both(H& h, const char* name, const N& numbers) {
  h.longer[0].push_back({name, numbers, first});
  h.longer[1].push_back({name, numbers, second});
}

// clang-format off
std::vector<Fault> drive_faults() {
  return {
      {.name = "magnets_for_coupling_leaning", .first = 0.02, .most = 0.25,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.shaft.push_back({"leaning_magnets", {s, (2.0 + 2.0 * c.share) * pretension(j)}, leaning_magnets});
       },
       .kin = {"tendon_stretch"}},  // under small loads
      {.name = "motor_of_uneven_force", .first = 0.01, .most = 0.15,
       .set = [](H& h, double s, const C& c, const J& j) {
         const N numbers = {s, pretension(j), 3.0 + std::floor(11.9 * c.share), c.angle};
         h.shaft.push_back({"force_not_even", numbers, force_not_even});
       }},
      {.name = "split_gear_pushed_open", .first = 0.01, .most = 0.12,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.shaft.push_back({"split_gear", {s, (0.2 + 0.4 * c.share) * pretension(j), c.sign}, split_gear});
       }},
      {.name = "strain_wave_gear_rubbing_within", .first = 5e-3, .most = 0.08,
       .set = [](H& h, double s, const C&, const J& j) {
         h.shaft.push_back({"rubbing_within", {s, pretension(j), 0.1}, rubbing_within});
       }},
      {.name = "worm_shrinking_in_cold", .first = 5e-4, .most = 0.01,
       .set = [](H& h, double s, const C& c, const J&) {
         h.shaft.push_back({"shrinking_worm", {c.sign * s}, shrinking_worm});
       },
       .kin = {"thermal_expansion"}},  // of tendons that are not as warm as each other
      {.name = "vee_belt_sinking_into_its_wheel", .first = 0.01, .most = 0.15,
       .set = [](H& h, double s, const C&, const J& j) {
         h.shaft.push_back({"sinking_belt", {s, pretension(j)}, sinking_belt});
       }},
      {.name = "shaft_carried_aside_by_oil", .first = 0.1, .most = 1.5,
       .set = [](H& h, double s, const C& c, const J&) {
         const N numbers = {c.sign * s, 0.2 + 1.8 * c.share};
         in_both<carried_by_oil<0>, carried_by_oil<1>>(h, "carried_by_oil", numbers);
       }},
  };
}

std::vector<Fault> tendon_faults() {
  return {
      {.name = "tendon_changing_its_crystals", .first = 0.3, .most = 3.0,
       .set = [](H& h, double s, const C&, const J& j) {
         const N numbers = {s, 1.25 * pretension(j), 0.95 * pretension(j), 0.4 * pretension(j)};
         in_both<changing_crystals<0>, changing_crystals<1>>(h, "changing_crystals", numbers);
       }},
      {.name = "panel_popping_like_an_oil_can", .first = 0.2, .most = 2.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const N numbers = {s, (0.2 + 0.3 * c.share) * pretension(j), c.sign};
         in_both<oil_can<0>, oil_can<1>>(h, "oil_can", numbers);
       }},
      {.name = "lock_nut_shaken_loose", .first = 0.01, .most = 0.15,
       .set = [](H& h, double s, const C& c, const J&) {
         h.longer[c.sign > 0 ? 1 : 0].push_back({"shaken_lock_nut", {s}, shaken_lock_nut});
       }},
      {.name = "ferrule_slipping_at_each_jerk", .first = 0.2, .most = 3.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.longer[c.sign > 0 ? 1 : 0].push_back({"jerked_ferrule", {s, 0.05 * pretension(j)}, jerked_ferrule});
       },
       .kin = {"tendon_slip"}},  // several of them
      {.name = "tape_wandering_on_its_drum", .first = 0.2, .most = 2.5,
       .set = [](H& h, double s, const C& c, const J&) {
         h.longer[c.sign > 0 ? 1 : 0].push_back({"wandering_tape", {s, 0.3 + 0.7 * c.share}, wandering_tape});
       }},
      {.name = "wires_and_pins_galling", .first = 500.0, .most = 8000.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.dry.push_back({"galling", {s, pretension(j), 5.0 + 20.0 * c.share}, galling});
       },
       .kin = {"capstan_friction"}},  // in the end
      {.name = "buffer_spring_closing_up", .first = 0.15, .most = 2.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const N numbers = {s, (1.1 + 0.8 * c.share) * pretension(j), pretension(j)};
         in_both<buffer_spring<0>, buffer_spring<1>>(h, "buffer_spring", numbers);
       },
       .kin = {"tendon_stretch"}},  // up to a pull
      {.name = "tendon_over_edge_of_cover", .first = 500.0, .most = 10000.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const N numbers = {s, pretension(j), theta_within(c, j), c.sign, 0.3};
         h.dry.push_back({"edge_of_cover", numbers, edge_of_cover});
       }},
  };
}

std::vector<Fault> joint_faults() {
  return {
      {.name = "ball_rolling_in_hollow_link", .first = 200.0, .most = 5000.0,
       .set = [](H& h, double s, const C& c, const J&) {
         h.torque.push_back({"rolling_ball", {c.sign * s, radians(2.0 + 8.0 * c.share)}, rolling_ball});
       }},
      {.name = "bearing_ring_creeping_round", .first = 0.1, .most = 1.0,
       .set = [](H& h, double s, const C& c, const J&) {
         const N numbers = {s, 4.0 + 12.0 * c.share, c.angle};
         in_both<creeping_ring<0>, creeping_ring<1>>(h, "creeping_ring", numbers);
       }},
      {.name = "axle_with_ball_catch", .first = 200.0, .most = 3000.0,
       .set = [](H& h, double s, const C& c, const J&) {
         h.torque.push_back({"notches", {s, 12.0 + std::floor(18.9 * c.share), c.angle}, notches});
       }},
      {.name = "link_moved_under_water", .first = 500.0, .most = 8000.0,
       .set = [](H& h, double s, const C&, const J&) { h.torque.push_back({"under_water", {s}, under_water}); }},
      {.name = "gusts_through_a_window", .first = 200.0, .most = 3000.0,
       .set = [](H& h, double s, const C& c, const J&) {
         h.torque.push_back({"gusts", {c.sign * s, 1.0 + 5.0 * c.share, number_of(c)}, gusts});
       }},
      {.name = "axle_nut_tightening_itself", .first = 500.0, .most = 8000.0,
       .set = [](H& h, double s, const C&, const J&) { h.dry.push_back({"tightening_nut", {s}, tightening_nut}); }},
      {.name = "compressor_refilling_its_tank", .first = 0.1, .most = 0.8,
       .set = [](H& h, double s, const C& c, const J&) {
         const N numbers = {s, 8.0 + 32.0 * c.share, c.angle / k_two_pi};
         h.load.push_back({"refilled_tank", numbers, refilled_tank});
       }},
      {.name = "air_for_load_throttled", .first = 1.0, .most = 12.0,
       .set = [](H& h, double s, const C&, const J&) {
         h.load.push_back({"through_throttle", {s}, through_throttle});
       }},
      {.name = "motor_for_load_a_dynamo", .first = 1.0, .most = 15.0,
       .set = [](H& h, double s, const C&, const J&) { h.load.push_back({"dynamo", {s}, dynamo}); }},
      {.name = "gas_for_load_cooling", .first = 0.01, .most = 0.08,
       .set = [](H& h, double s, const C&, const J&) { h.load.push_back({"vapour", {s}, vapour}); }},
  };
}

std::vector<Fault> sensor_faults() {
  return {
      {.name = "sunbeam_passing_sensor", .first = 0.01, .most = 0.15,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"sunbeam", {c.sign * s, 10.0 + 40.0 * c.share, 8.0}, sunbeam});
       }},
      {.name = "sensor_on_its_own_beat", .first = 0.05, .most = 0.8,
       .set = [](H& h, double s, const C&, const J&) { h.reading.push_back({"own_beat", {s}, own_beat}); },
       .kin = {"sensor_lag"}},  // on an average
      {.name = "polynomial_of_too_high_degree", .first = 4e-3, .most = 0.05,
       .set = [](H& h, double s, const C& c, const J& j) {
         const Joint& joint = j.declared.joint;
         const N numbers = {c.sign * s, 0.5 * (joint.theta_min + joint.theta_max),
                            0.5 * (joint.theta_max - joint.theta_min)};
         h.reading.push_back({"polynomial", numbers, polynomial});
       }},
      {.name = "popcorn_in_amplifier", .first = 8e-3, .most = 0.1,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"popcorn", {c.sign * s, 1.0 + 9.0 * c.share, number_of(c)}, popcorn});
       }},
      {.name = "laser_on_grainy_rim", .first = 3e-3, .most = 0.04,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"grain_of_rim", {s, radians(0.5 + 3.0 * c.share), number_of(c)}, grain_of_rim});
       }},
      {.name = "computer_busy_with_steps", .first = 0.05, .most = 0.8,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"busy_computer", {s, 2.0 + 2.0 * c.share}, busy_computer});
       },
       .kin = {"sensor_lag"}},  // in fast runs
      {.name = "hair_spring_run_down", .first = 8e-3, .most = 0.1,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.reading.push_back({"spring_run_down", {s, theta_within(c, j), c.sign}, spring_run_down});
       }},
      {.name = "span_set_before_each_run", .first = 5e-3, .most = 0.06,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"span_set_anew", {s, number_of(c)}, span_set_anew});
       },
       .kin = {"joint_sensor_gain"}},  // another one in each run
      {.name = "clock_hunting_for_the_other", .first = 0.03, .most = 0.4,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"hunting_clock", {s, 20.0 + 60.0 * c.share, c.angle}, hunting_clock});
       }},
      {.name = "shorted_turns_in_potentiometer", .first = 0.01, .most = 0.12,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.reading.push_back({"shorted_turns", {s, theta_within(c, j)}, shorted_turns});
       }},
  };
}
// clang-format on

}  // namespace unsuspected

std::vector<Fault> unsuspected_faults() {
  using namespace unsuspected;
  return joined({drive_faults(), tendon_faults(), joint_faults(), sensor_faults()});
}

}  // namespace fusee::rig
