// A seventh split: what goes wrong with tendon joints on real benches, by an eighth hand that saw neither how
// calibration infers nor what it makes of the other splits. It was kept aside until 62 of its joints were run, and is
// tuned on since.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "rig/fault_shapes.h"
#include "rig/faults.h"
#include "rig/random.h"

namespace fusee::rig {
namespace untold {

using namespace short_names;

// ---- motor, gearbox, shaft ------------------------------------------------------------------------------------------

/// A stepper without damping swings about its steps near one speed, n[1] rad/s of the shaft, and pulls weakly there: it
/// is behind by n[0] in the middle of that band, which is n[2] wide. In practice 0.2 … 3 deg, 8 … 20 deg/s behind a
/// gear. Play is as wide at any speed and a late sensor later the faster: this is right in slow runs and in fast ones.
double resonant_stepper(const Moment& now, const N& n, N&) {
  return -n[0] * now.direction * bump((std::abs(now.alpha_speed) - n[1]) / n[2]);
}

/// The disc of the motor's encoder is pressed on too loosely, and its inertia carries it on whenever the speed changes
/// by more than n[1] rad/s at once: n[0] s times what is beyond. In practice 0.1 … 2 deg for 90 deg/s turned round,
/// from 20 … 60 deg/s on. What is shown goes on the old way, so that the shaft is ahead on the new one, where play and
/// lag are behind; slow runs have no loop.
double slipping_disc(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.alpha_speed, 0.0};
  const double change = now.alpha_speed - memory[0];
  memory = {now.alpha_speed, memory[1] + change - std::clamp(change, -n[1], n[1])};
  return n[0] * memory[1];
}

/// The gear's grease thickens as it cools, and a controller without an integrator leaves the shaft behind by what it
/// drags: n[0] s times the speed for every 10 K. In practice 5 … 100 ms. A late sensor is as late in the first run as
/// in the last; play that grows as it cools is as wide when slow.
double thickening_grease(const Moment& now, const N& n, N&) {
  return -n[0] * now.alpha_speed * std::max(0.0, -now.warmth) / 10.0;
}

// ---- pulley, tendon -------------------------------------------------------------------------------------------------

/// A tendon is tied into its groove too early: n[0] rad before the end of the stroke (α = n[2], and n[3] the way there
/// from) it is unwound to its knot, and from there on pulls at it straight, letting out n[1] sin x where a groove of
/// radius n[1] mm would let out n[1] x. In practice 10 … 80 deg. A radius is wrong over all the stroke, a turn too many
/// lies higher by its thickness at once: this begins with the cube.
double unwound(const Moment& now, const N& n, N&) {
  const double beyond = std::max(0.0, n[0] - n[3] * (now.alpha - n[2]));
  return n[1] * (beyond - std::sin(beyond));
}

/// One of both pulleys was sanded, or printed, by itself and is larger: n[0] mm, with the sign of its winding. In
/// practice 0.05 … 0.5 mm. If both are wrong alike, the joint goes further; here the tendons pull against each other on
/// one side of home and hang on the other, and what is wrong moves the joint by half.
double one_larger(const Moment& now, const N& n, N&) { return n[0] * now.alpha; }

/// A string that hums: the gear's teeth strike it faster the faster the motor turns, and where that is its own tone
/// (n[1] rad/s of the shaft at n[2] N, by the root of its tension), it swings, which takes n[0] mm of its length; it
/// needs 0.3 s to build up or to die away. In practice 0.05 … 0.4 mm (π² a² / 4 L: 2 … 5 mm to either side). Stretch
/// knows no speed and lag no tension: this shortens, the same both ways, where both fit.
template <std::size_t side>
double humming(const Moment& now, const N& n, N& memory) {
  constexpr double width = 0.5, builds_up = 0.3;
  if (memory.empty()) memory = {0.0, now.tension[side]};
  const double struck = std::abs(now.alpha_speed) / n[1];
  // The last pull decides: a string does not change its swing while the joint settles.
  const double off = (struck - std::sqrt(std::max(0.0, memory[1]) / n[2])) / width;
  const double swing = std::min(1.0, struck * struck) / (1.0 + off * off);
  memory[1] = now.tension[side];
  return n[0] * followed(swing, now.seconds, builds_up, memory[0]);
}

/// A stiff monofilament takes the bend of its pin where it stands still, with the time constant n[1] s, and keeps it as
/// a kink when that piece has gone on: its way is longer by n[0] mm until drawing it to and fro has straightened it,
/// down to 1/e within n[2] rad of the motor. In practice 0.05 … 0.5 mm (nylon), 1 … 20 s, 0.5 … 3 rad. Creep lengthens
/// what is pulled, and a braid shortens that was let loose: this shortens what rested under any pull, and only when
/// it moves off.
double set_at_rest(const Moment& now, const N& n, N& memory) {
  constexpr double on_pin = radians(6.0);
  if (memory.empty()) memory = {now.alpha, now.alpha, 0.0, 0.0};  // last, where it rested, its bend, older kinks
  const double way = std::abs(now.alpha - memory[0]), left = std::exp(-way / n[2]);
  memory[0] = now.alpha;
  memory[2] *= left, memory[3] *= left;
  const double still = bump((now.alpha - memory[1]) / on_pin);  // of that bend on the pin
  if (way > 0) return n[0] * (memory[3] + (1.0 - still) * memory[2]);
  memory[3] += (1.0 - still) * memory[2];
  memory[2] *= still;
  memory[1] = now.alpha;
  followed(1.0, now.seconds, n[1], memory[2]);
  return n[0] * memory[3];
}

/// A rope of steel near the end of its life: with every reversal another wire breaks on the pin, and what is left gives
/// n[0] mm/N more. In practice 0.5 … 10 % of its stretch. Stretch is the same in all runs, and a strand breaks once, at
/// a hard pull: this goes on and on, whatever the pull.
template <std::size_t side>
double breaking_wires(const Moment& now, const N& n, N& memory) {
  const double broken = reversals(now, memory);
  if (memory.size() < 3) memory.push_back(now.tension[side]);  // at home
  return -n[0] * broken * (now.tension[side] - memory[2]);
}

/// A hydraulic tensioner, as on a chain, that leaks: its piston is pressed in by n[0] mm/s under twice the pull of
/// home, and comes out again as fast where nothing pulls. In practice 0.005 … 0.1 mm/s. Creep slows down by the
/// logarithm and is the tendon's; paste yields from a threshold on and stays: this goes straight on, and comes back.
template <std::size_t side>
double leaking_tensioner(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.tension[side], 0.0};
  memory[1] += (now.tension[side] / memory[0] - 1.0) * now.seconds;
  return -n[0] * memory[1];
}

// ---- pins, frame ----------------------------------------------------------------------------------------------------

/// Pins run dry at rest, and the quicker the tendon the more oil it draws under itself: dry friction of n[0] N·mm on
/// the joint at n[1] N in both tendons, less and less of it up to n[2] rad/s of the motor and beyond. In practice 20 …
/// 1000 N·mm, 10 … 30 deg/s. A pin's friction is as large in fast runs, a bearing that sticks does not ask what pulls.
double on_oil(const Moment& now, const N& n, N&) {
  return n[0] * 0.5 * (now.tension[0] + now.tension[1]) / n[1] * bump(now.alpha_speed / n[2]);
}

/// A pin is knocked between two runs, and stands n[0] mm further right and n[1] mm further up from the run n[2] on.
/// n[3] rad: from upright, of the way from the pulley up to it. In practice 0.2 … 2 mm. A pin that was drawn wrong
/// stands there from the begin; tightening is as much at every θ.
template <std::size_t side>
double knocked_pin(const Moment& now, const N& n, N&) {
  if (static_cast<double>(now.run) < n[2]) return 0.0;
  return Vec2(n[0], n[1]).dot(now.pull[side] + Vec2(std::sin(n[3]), std::cos(n[3])));
}

/// The joint's axle is a thin screw held at one end, and bends: n[0] mm for a newton more than at home of what both
/// tendons and the load press it with. In practice 10⁻³ … 0.05 mm/N (M3 … M5 in metal or print). Tendons and pins give
/// each to its own pull, an axis with play lies off by the force's direction alone: here the load itself takes part.
template <std::size_t side>
double bending_axle(const Moment& now, const N& n, N& memory) {
  const Vec2 force = force_on_axis(now);
  if (memory.empty()) memory = {force.x(), force.y()};
  return nearer<side>(now, n[0] * (force - Vec2(memory[0], memory[1])));
}

// ---- joint, link, load ----------------------------------------------------------------------------------------------

/// An exoskeleton with somebody in it: a muscle that is stretched faster than n[1] rad/s, towards n[3], pulls back, by
/// up to n[0] N·mm, and relaxes with the time constant n[2] s. In practice 100 … 5000 N·mm, from 10 … 40 deg/s on, 0.2
/// … 1 s. Grease drags both ways and at any speed, and springs know none.
double reflex(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0};
  const double beyond = std::max(0.0, n[3] * now.theta_speed / n[1] - 1.0);
  return -n[3] * n[0] * followed(beyond / (1.0 + beyond), now.seconds, n[2], memory[0]);
}

/// A spring that draws a finger open, of which the file says nothing: n[0] N·mm/rad about θ = n[1]. In practice 50 …
/// 5000 N·mm/rad. A link's weight is a sine with its turning point anywhere: this is straight.
double return_spring(const Moment& now, const N& n, N&) { return -n[0] * (now.theta - n[1]); }

/// Water in a hollow link runs to the end that lies lower, all of it from n[2] rad beyond θ = n[1] on, and takes its
/// time, n[3] s: n[0] N·mm to that side. In practice 50 … 1000 N·mm (a spoonful, 50 mm), 0.5 … 5 s. A link's weight
/// pushes at once; a glove pulls back, and lets go at rest: this pushes on, and gets stronger there.
double water(const Moment& now, const N& n, N& memory) {
  const double lean = std::clamp((now.theta - n[1]) / n[2], -1.0, 1.0);
  if (memory.empty()) memory = {lean, lean};  // where it is, where it ran to last
  followed(memory[1], now.seconds, n[3], memory[0]);
  memory[1] = lean;
  return n[0] * memory[0];
}

/// The hook has a row of holes in the link, and nobody minds which: in every run the load's lever is longer or shorter
/// by the share n[0] (standard deviation; n[1] numbers who hangs it). In practice 0.02 … 0.2. A cell's gain is wrong
/// alike in all runs; a forgotten plate is in one, in newtons; homing is careless without a load too.
double another_hole(const Moment& now, const N& n, N&) {
  return now.load * std::max(-1.0, n[0] * numbered(n[1], now.run).normal());
}

/// The hook works itself out along the link, by the share n[0] of its lever with every reversal, until it is hung anew.
/// In practice 0.002 … 0.05. A hook that slides with the link's lean comes back with it, a bag that drips loses by the
/// clock: this gains by the stroke, and stops with the motor.
double walking_hook(const Moment& now, const N& n, N& memory) {
  if (now.load == 0) memory.clear();
  return n[0] * now.load * reversals(now, memory);
}

// ---- joint's sensor, log --------------------------------------------------------------------------------------------

/// An inclinometer on the link is shaken by the gear, and its amplifier rectifies what shakes it: it is off by n[0] at
/// 90 deg/s of the motor, with the square of the speed. In practice 0.02 … 1 deg. Lag turns round with the way: this
/// has one sign on both, and none at rest.
double shaken(const Moment& now, const N& n, N&) {
  const double haste = now.alpha_speed / radians(90.0);
  return n[0] * haste * haste;
}

/// A plug with a loose contact: every n[1] s it has, or has not, a resistance that shifts what is shown by n[0], two
/// times in five; n[2] numbers the plug. In practice 0.05 … 3 deg, 0.2 … 10 s. A zero that walks does so at reversals,
/// and steps that stay come once: this comes and goes by chance, in motion and at rest.
double loose_contact(const Moment& now, const N& n, N&) {
  return numbered(n[2] + std::floor(now.time / n[1]), 67).share() < 0.4 ? n[0] : 0.0;
}

/// The driver's switching gets into the sensor's wire by the current that holds the load: noise of n[0] (rms) at n[1]
/// N, in proportion. In practice 0.02 … 1 deg. Noise as it was declared knows no load, and sparks none either, but
/// speed.
double switching_noise(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0};
  memory[0] += 1.0;
  return n[0] * now.load / n[1] * numbered(memory[0], 71).normal();
}

/// Motor and sensor share their ground, which is lifted by the supply's current: what the motor takes out of it to
/// lift, or gives back, load times speed, shifts what is shown by n[0] for n[1] N at 1 rad/s. In practice 0.05 … 2 deg.
/// Lag has the same sign under either load, and stretch on either way: this turns round with both, and is nothing at
/// rest.
double lifted_ground(const Moment& now, const N& n, N&) { return n[0] * now.load / n[1] * now.alpha_speed; }

/// An output stage without bias: about its middle, θ = n[1], neither half carries and what is shown stands still over
/// n[0] to either side; from there on it is as much too little. In practice 0.05 … 2 deg. A worn track is bridged where
/// it ends, and the plateau comes from the way: here it stays lost, one step in all that is shown. Home is set to
/// nought.
double crossover(const Moment& now, const N& n, N&) {
  const auto lost = [&](double theta) { return std::clamp(theta - n[1], -n[0], n[0]); };
  return lost(0.0) - lost(now.theta);
}

/// A filter that is to hide tremble and not to be late: its time constant is n[0] s at rest, half of it at n[1] rad/s
/// of the joint, and so on. In practice 0.05 … 1 s, 2 … 15 deg/s. A late sensor is further behind the faster: this
/// comes to a bound, n[0] n[1], but takes long to arrive where the joint stands still.
double adaptive_filter(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.theta, now.time};
  const double since = now.time - memory[1];
  memory[1] = now.time;
  if (!(since > 0)) return memory[0] - now.theta;
  return followed(now.theta, since, n[0] / (1.0 + std::abs(now.theta_speed) / n[1]), memory[0]) - now.theta;
}

/// Gyroscope and inclinometer in one filter: what changes within n[1] s is the gyroscope's, whose scale is wrong by the
/// share n[0], what lasts is the inclinometer's, and right. In practice 0.005 … 0.05, 0.5 … 10 s. A gain is wrong
/// however slow the joint, a sensor that leaks loses what lasts: this is right at rest, and about the middle of a
/// stroke.
double scale_of_gyro(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.theta, now.time};
  const double since = now.time - memory[1];
  memory[1] = now.time;
  return n[0] * (now.theta - followed(now.theta, since, n[1], memory[0]));
}

// ---- what is wrong --------------------------------------------------------------------------------------------------

/// mm: of a tendon's groove, on an average.
double mean_radius(const J& joint, std::size_t side) {
  double sum = 0, points = 0;
  const auto add = [&](double x, double y) { sum += std::hypot(x, y), points += 1.0; };
  for (const OutlinePoint& point : (side == 0 ? joint.p1 : joint.p2).points)
    add(point.position.x(), point.position.y());
  for (const SpiralRow& row : joint.spirals[side].rows) add(row.x, row.y);
  return sum / points;
}

// clang-format off
std::vector<Fault> drive_faults() {
  return {
      {.name = "stepper_in_resonance", .first = 0.02, .most = 0.15,
       .set = [](H& h, double s, const C& c, const J&) {
         const double middle = radians(8.0 + 12.0 * c.share);
         h.shaft.push_back({"resonant_stepper", {s, middle, 0.3 * middle}, resonant_stepper});
       }},
      {.name = "motor_disc_slipping", .first = 0.01, .most = 0.05,
       .set = [](H& h, double s, const C& c, const J&) {
         h.shaft.push_back({"slipping_disc", {s, radians(20.0 + 40.0 * c.share)}, slipping_disc});
       }},
      {.name = "gear_grease_thickening", .first = 0.02, .most = 0.2,
       .set = [](H& h, double s, const C&, const J&) {
         h.shaft.push_back({"thickening_grease", {s}, thickening_grease});
       },
       .kin = {"sensor_lag"}},  // behind by the speed, more and more
  };
}

std::vector<Fault> tendon_faults() {
  return {
      {.name = "unwound_to_its_knot", .first = 0.5, .most = 1.5,
       .set = [](H& h, double s, const C& c, const J& j) {
         const bool second = c.sign > 0;
         const N numbers = {s, mean_radius(j, second ? 1 : 0), second ? j.alpha_min : j.alpha_max, c.sign};
         h.longer[second ? 1 : 0].push_back({"unwound", numbers, unwound});
       }},
      {.name = "one_pulley_larger", .first = 0.1, .most = 1.0,
       .set = [](H& h, double s, const C& c, const J&) {
         h.longer[c.sign > 0 ? 1 : 0].push_back({"one_larger", {c.sign * s}, one_larger});
       },
       .kin = {"radius_offset"}},  // half of it
      {.name = "humming_tendon", .first = 0.1, .most = 0.8,
       .set = [](H& h, double s, const C& c, const J& j) {
         const N numbers = {s, radians(10.0 + 20.0 * c.share), pretension(j)};
         const bool second = c.sign > 0;
         h.longer[second ? 1 : 0].push_back({"humming", numbers, second ? humming<1> : humming<0>});
       }},
      {.name = "tendon_set_at_rest", .first = 0.2, .most = 2.0,
       .set = [](H& h, double s, const C& c, const J&) {
         const N numbers = {s, 1.0 + 9.0 * c.share * c.share, 0.5 + 2.5 * c.share};
         h.longer[c.sign > 0 ? 1 : 0].push_back({"set_at_rest", numbers, set_at_rest});
       }},
      {.name = "wires_breaking_one_by_one", .first = 0.1, .most = 1.5,
       .set = [](H& h, double s, const C& c, const J& j) {
         const bool second = c.sign > 0;
         const auto act = second ? breaking_wires<1> : breaking_wires<0>;
         h.longer[second ? 1 : 0].push_back({"breaking_wires", {s * give(j)}, act});
       },
       .kin = {"tendon_stretch"}},  // a rope that is softer than declared, more and more
      {.name = "leaking_tensioner", .first = 0.01, .most = 0.3,
       .set = [](H& h, double s, const C& c, const J&) {
         const bool second = c.sign > 0;
         const auto act = second ? leaking_tensioner<1> : leaking_tensioner<0>;
         h.longer[second ? 1 : 0].push_back({"leaking_tensioner", {s}, act});
       },
       .kin = {"creep"}},  // lengthens slowly under what pulls, and comes back
  };
}

std::vector<Fault> frame_faults() {
  return {
      {.name = "tendon_floating_on_oil", .first = 200.0, .most = 6000.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.dry.push_back({"on_oil", {s, pretension(j), radians(10.0 + 20.0 * c.share)}, on_oil});
       },
       .kin = {"capstan_friction"}},  // of the same pins, in slow runs
      {.name = "pin_knocked_between_runs", .first = 0.3, .most = 2.5,
       .set = [](H& h, double s, const C& c, const J& j) {
         const auto [first, second] = ways_to_pins(j);
         const double run = c.share < 0.7 ? 1.0 : 2.0;
         const bool right = c.sign > 0;
         const N numbers = {s * std::cos(c.angle), s * std::sin(c.angle), run, right ? second : -first};
         h.longer[right ? 1 : 0].push_back({"knocked_pin", numbers, right ? knocked_pin<1> : knocked_pin<0>});
       },
       .kin = {"guide_position"}},  // of a pin, from a run on
      {.name = "axle_bending", .first = 5e-3, .most = 0.1,
       .set = [](H& h, double s, const C&, const J&) {
         h.longer[0].push_back({"bending_axle", {s}, bending_axle<0>});
         h.longer[1].push_back({"bending_axle", {s}, bending_axle<1>});
       },
       .kin = {"frame_compliance"}},  // a part of the frame that gives way, the joint's and not the pins'
  };
}

std::vector<Fault> link_faults() {
  return {
      {.name = "stretched_muscle", .first = 1000.0, .most = 15000.0,
       .set = [](H& h, double s, const C& c, const J&) {
         const N numbers = {s, radians(10.0 + 15.0 * c.share), 0.2 + 0.8 * c.angle / k_two_pi, c.sign};
         h.torque.push_back({"reflex", numbers, reflex});
       }},
      {.name = "forgotten_return_spring", .first = 500.0, .most = 20000.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.torque.push_back({"return_spring", {s, c.share * end_of_range(c, j)}, return_spring});
       },
       .kin = {"gravity"}},  // a load that turns with the joint
      {.name = "water_in_link", .first = 200.0, .most = 4000.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const double most_at = radians(5.0 + 10.0 * c.angle / k_two_pi);
         h.torque.push_back({"water", {s, 0.5 * theta_within(c, j), most_at, 0.5 + 4.5 * c.share}, water});
       },
       .kin = {"gravity"}},  // a weight in the link that nobody wrote down, if one that runs
      {.name = "hung_in_another_hole", .first = 0.1, .most = 0.4,
       .set = [](H& h, double s, const C& c, const J&) {
         h.load.push_back({"another_hole", {s, std::floor(1e6 * c.share)}, another_hole});
       }},
      {.name = "hook_working_outwards", .first = 0.03, .most = 0.15,
       .set = [](H& h, double s, const C&, const J&) { h.load.push_back({"walking_hook", {s}, walking_hook}); }},
  };
}

std::vector<Fault> sensor_faults() {
  return {
      {.name = "inclinometer_shaken", .first = 0.01, .most = 0.06,
       .set = [](H& h, double s, const C& c, const J&) { h.reading.push_back({"shaken", {c.sign * s}, shaken}); }},
      {.name = "loose_contact", .first = 5e-3, .most = 0.06,
       .set = [](H& h, double s, const C& c, const J&) {
         const N numbers = {c.sign * s, 0.5 + 5.5 * c.share, std::floor(1e6 * c.angle)};
         h.reading.push_back({"loose_contact", numbers, loose_contact});
       }},
      {.name = "noise_of_driver_under_load", .first = 5e-3, .most = 0.1,
       .set = [](H& h, double s, const C&, const J& j) {
         h.reading.push_back({"switching_noise", {s, pretension(j)}, switching_noise});
       }},
      {.name = "ground_lifted_by_power", .first = 5e-3, .most = 0.1,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.reading.push_back({"lifted_ground", {c.sign * s, pretension(j)}, lifted_ground});
       }},
      {.name = "crossover_of_amplifier", .first = 5e-3, .most = 0.06,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.reading.push_back({"crossover", {s, 0.5 * theta_within(c, j)}, crossover});
       }},
      {.name = "adaptive_smoothing", .first = 0.1, .most = 2.0,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"adaptive_filter", {s, radians(2.0 + 13.0 * c.share)}, adaptive_filter});
       },
       .kin = {"sensor_lag"}},  // shown late
      {.name = "gyro_scale_beside_inclinometer", .first = 0.01, .most = 0.15,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"scale_of_gyro", {c.sign * s, 0.5 + 9.5 * c.share * c.share}, scale_of_gyro});
       },
       .kin = {"joint_sensor_gain"}},  // of what moves, about the middle
  };
}
// clang-format on

}  // namespace untold

std::vector<Fault> untold_faults() {
  using namespace untold;
  return joined({drive_faults(), tendon_faults(), frame_faults(), link_faults(), sensor_faults()});
}

}  // namespace fusee::rig
