// A tenth split that is kept aside: what goes wrong with tendon joints on real benches, by an eleventh hand that saw
// neither how calibration infers nor what it makes of the other splits. Nothing is tuned on these; they are run once.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "fusee/transmission/transmission.h"
#include "rig/fault_shapes.h"
#include "rig/faults.h"
#include "rig/random.h"

namespace fusee::rig {
namespace unforeseen {

using namespace short_names;

/// What of `x` stands beyond its value in the session's first moment.
double since_home(double x, N& memory) {
  if (memory.empty()) memory = {x};
  return x - memory[0];
}

// ---- motor, gearbox, shaft ------------------------------------------------------------------------------------------

/// A gear whose teeth rub by what they carry, and a controller that holds by a spring's law: under a load of n[1] N, of
/// either sign, the shaft is behind by n[0] whichever way it goes, in proportion to the load; turned round within 2 deg
/// of the motor. In practice 0.1 … 2 deg. Play is as wide without a load, teeth that a load holds together have less of
/// it: this is nothing in an unloaded run.
double rubbing_gear(const Moment& now, const N& n, N& memory) {
  constexpr double turning = radians(1.0);
  if (memory.empty()) memory = {now.alpha};
  const double way = (now.alpha - behind(now.alpha, turning, memory[0])) / turning;
  return -n[0] * std::abs(now.load) / n[1] * way;
}

/// A hub pressed on its shaft frets: every reversal under a load works it on a little to the load's side, n[0] for n[1]
/// N, and it stays there. In practice 0.005 … 0.3 deg a reversal. Steps lost in turning do not ask for a load, a hub
/// that gives way all at once does so at a load of its own: this is load times reversals.
double fretting_hub(const Moment& now, const N& n, N& memory) {
  const double before = memory.empty() ? 0.0 : memory[1];
  const double turned = reversals(now, memory);
  if (memory.size() == 2) memory.push_back(0.0);
  memory[2] += (turned - before) * now.load / n[1];
  return -n[0] * memory[2];
}

/// Something large on the same supply starts every n[2] s, and for 0.6 s the voltage is low and the motor weak: a load
/// pushes the shaft back, by n[0] for n[1] N. In practice 0.2 … 5 deg, every 3 … 9 s. What a load does else it does all
/// the time, and what keeps to a clock needs no load.
double dipping_supply(const Moment& now, const N& n, N&) {
  constexpr double dip = 0.6;
  return std::fmod(now.time, n[2]) < dip ? -n[0] * now.load / n[1] : 0.0;
}

/// Each tendon has a motor of its own, and the second one is told by the first, n[0] s late: its tendon is wound, or
/// let out, by so much less. n[1] mm: its arm at home, with the sign of its winding. In practice 2 … 50 ms. A late
/// sensor leaves the tendons as tight as they are: here they pull against each other on one way, and hang on the other.
double late_follower(const Moment& now, const N& n, N&) { return -n[0] * n[1] * now.alpha_speed; }

// ---- pulley ---------------------------------------------------------------------------------------------------------

/// A printed pulley with few spokes, whose rim bends in between them: where the tendon comes off it, it gives n[0] mm/N
/// at most, halfway from spoke to spoke, n[1] of them in a turn, n[2] from one of them at home. In practice 0.1 … 3
/// times the tendon's stretch. A profile is as wrong under any pull, stretch as much at any place: this is their
/// product.
template <std::size_t side>
double spoked_rim(const Moment& now, const N& n, N& memory) {
  return -n[0] * since_home(now.tension[side], memory) * 0.5 * (1.0 - std::cos(n[1] * now.alpha + n[2]));
}

/// The printer lost a step between both grooves: all of tendon 2's lies n[0] mm off the axis, n[1] round from the way
/// to its pin. In practice 0.1 … 1 mm. A pulley that runs out does so with both grooves, and tendon 1 lets out what
/// tendon 2 takes in; here they pull against each other.
double shifted_layer(const Moment& now, const N& n, N&) {
  return -n[0] * (std::cos(now.alpha + n[1]) - std::cos(n[1]));
}

/// A drum without a groove, on which the turns come to lie side by side: its tendon comes off square at α = n[1] alone,
/// and n[2] from there runs so far aslant that its way is longer by n[0] mm, with the square. In practice 0.02 … 0.5 mm
/// (z² / 2 L: 2 … 8 mm aside). A radius makes a way that is straight in α, a profile one that comes again.
double aslant_off_drum(const Moment& now, const N& n, N&) {
  const auto squared = [&](double alpha) { return (alpha - n[1]) * (alpha - n[1]) / (n[2] * n[2]); };
  return n[0] * (squared(now.alpha) - squared(0.0));
}

/// One cord for both tendons, laid round the pulley and tied nowhere: as soon as one side pulls e^n[1] times as hard as
/// the other it slips round to it, n[0] mm for each further e (rough spots hold it again), and stays there until the
/// other side pulls as hard. n[2] N: less is none. In practice 0.05 … 2 mm, n[1] 0.8 … 1.6 (friction times angle). Slip
/// of a knot is one tendon's, and for good; what gives comes back without the load.
template <std::size_t side>
double slipping_round(const Moment& now, const N& n, N& memory) {
  constexpr double sign = side == 1 ? -1.0 : 1.0;
  if (memory.empty()) memory = {0.0};
  const double ratio = std::log(std::max(n[2], now.tension[1]) / std::max(n[2], now.tension[0]));
  return sign * n[0] * behind(ratio, n[1], memory[0]);
}

// ---- tendons, sheaths, pins -----------------------------------------------------------------------------------------

/// A turnbuckle of brass in the middle of a tendon that runs level: it hangs through by its weight, and takes n[0] mm
/// of the tendon at n[1] N, with the inverse square of the pull down to a third of that, where it lies on the frame. In
/// practice 0.005 … 0.3 mm (F² L / 8 T²). Stretch is even; this is nearly all where the tendon is about to go slack.
template <std::size_t side>
double hanging_turnbuckle(const Moment& now, const N& n, N& memory) {
  const double pull = std::max(now.tension[side] / n[1], 1.0 / 3.0);
  return n[0] * since_home(1.0 / (pull * pull), memory);
}

/// A second cord beside a tendon, in case that tears, tied a little longer: from n[1] N on it helps, and the tendon
/// stretches n[0] mm/N less. In practice 0.2 … 0.6 of its stretch. A tendon that hardens does so all along, and both
/// do; a spring that opens gets softer.
template <std::size_t side>
double safety_cord(const Moment& now, const N& n, N&) {
  return n[0] * std::max(0.0, now.tension[side] - n[1]);
}

/// Before each run somebody plucks one tendon to hear how tight it is, and his fingers warm it: it is longer by n[0]
/// mm and cools within n[1] s of the run. In practice 0.01 … 0.2 mm (nylon), 5 … 40 s. Expansion goes by what the
/// thermometer shows, creep on from run to run: this begins anew with each.
double warm_fingers(const Moment& now, const N& n, N&) { return -n[0] * std::exp(-now.run_time / n[1]); }

/// From the way that a link points to its axis round to the pull of a tendon.
template <std::size_t side>
double bent_at_end(const Moment& now) {
  const Vec2 in(-std::sin(now.theta), -std::cos(now.theta));
  const Vec2& pull = now.pull[side];
  return std::atan2(in.x() * pull.y() - in.y() * pull.x(), in.dot(pull));
}

/// A tendon's loop grips the post that it is laid over, and rolls on it as the link turns, instead of sliding: it is
/// wound on or off at n[0] mm from the middle, up to n[1] to either side, and only then slides. In practice 1 … 4 mm,
/// 0.05 … 0.3 rad. Play and friction know a load, or the motor; this is the same way at each reversal, however hard the
/// tendon is pulled.
template <std::size_t side>
double gripping_loop(const Moment& now, const N& n, N& memory) {
  const double bent = bent_at_end<side>(now);
  if (memory.empty()) memory = {bent};
  return n[0] * (bent - behind(bent, n[1], memory[0]));
}

/// A tendon's sheath goes over the joint and bends with it, and the cord, thinner than its bore, lies at the inside of
/// the bend: its way is shorter by n[0] mm for each radian, to whichever side, from θ = n[1] on, where the sheath is
/// straight. In practice 0.2 … 2 mm/rad (the bore less the cord). No length, radius or place of a pin makes a way with
/// a corner in it.
double inside_of_bend(const Moment& now, const N& n, N&) {
  return -n[0] * (std::abs(now.theta - n[1]) - std::abs(n[1]));
}

/// Both tendons go through sheaths over the joint that are straight at home: the further they bend, the more their
/// cords rub, n[0] N·mm on the joint for n[1] N in each at θ = n[2], with the square of the angle. In practice 50 …
/// 3000 N·mm. A pin rubs all over the stroke; an axle that is drawn tight does so whatever pulls, and to one side.
double bent_sheath(const Moment& now, const N& n, N&) {
  const double far = now.theta / n[2];
  return n[0] * 0.5 * (now.tension[0] + now.tension[1]) / n[1] * far * far;
}

/// A pin's bracket whose screw is loose: it follows its tendon by as much as the gap leaves it, n[0] mm to either side
/// for n[1] N more or less than at home, and then stands. In practice 0.02 … 0.5 mm. A frame that bends does so in
/// proportion, and further under a greater pull.
template <std::size_t side>
double gap_under_bracket(const Moment& now, const N& n, N& memory) {
  return -n[0] * std::clamp(since_home(now.tension[side], memory) / n[1], -1.0, 1.0);
}

// ---- joint, load ----------------------------------------------------------------------------------------------------

/// The joint's bearing is dry and rubs with n[0] N·mm, until somebody hears it and oils it before the run n[1]. In
/// practice 50 … 2000 N·mm. A bearing's friction is the same in all runs; one that runs in does so by its way.
double oiled_later(const Moment& now, const N& n, N&) { return static_cast<double>(now.run) < n[1] ? n[0] : 0.0; }

/// An exoskeleton with somebody in it who holds his arm up, and tires: it leans on the joint with up to n[0] N·mm, more
/// and more within n[1] s of each run, and less again in the pause. In practice 50 … 3000 N·mm, 15 … 60 s. A link's
/// weight is there at once; what creeps and cools does not recover between runs.
double tiring_arm(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0};
  return n[0] * followed(now.run_time > 0 ? 1.0 : 0.0, now.seconds, n[1], memory[0]);
}

/// The pan that the weights lie on was never counted: whenever there is a load, n[0] N more hang there. In practice 0.1
/// … 3 N. A cell's gain is wrong in proportion, a plate that was forgotten hangs in one run: this is as much under a
/// small load as under a great one, and nothing without.
double uncounted_pan(const Moment& now, const N& n, N&) { return now.load == 0 ? 0.0 : std::copysign(n[0], now.load); }

/// A winch pulls until its load cell shows what it should, and the glue under the cell's gauges gives: it shows more
/// and more of what pulls, so that the winch lets off by the share n[0], with the time constant n[1] s, and the glue
/// comes back without a load. In practice 1 … 20 %, 10 … 60 s. Tendons that creep give way to a load further and
/// further: this comes back from it.
double creeping_cell(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0};
  return -n[0] * followed(now.load, now.seconds, n[1], memory[0]);
}

// ---- joint's sensor, log --------------------------------------------------------------------------------------------

/// A camera films a mark on the link, and its lens draws in what is far from the picture's middle (θ = n[1]), or out:
/// n[0] at n[2] from there, with the cube. In practice 0.05 … 2 deg. A gain is straight and a loaded potentiometer is
/// right at both ends: this is flat in the middle and steep at the ends. Home is set to nought.
double drawn_in_by_lens(const Moment& now, const N& n, N&) {
  const auto cubed = [&](double theta) { return std::pow((theta - n[1]) / n[2], 3); };
  return -n[0] * (cubed(now.theta) - cubed(0.0));
}

/// How far off an angle is that two Hall plates show of which one ends at `most` of its height: `x` from its peak.
double off_by_clipping(double x, double most) {
  return std::cos(x) > most && std::cos(x) > 0 ? std::atan(std::sin(x) / most) - x : 0.0;
}
/// A magnet so near to its two Hall plates that one amplifier ends the share n[0] below the plate's peak, which is at θ
/// = n[1]. In practice 1 … 15 %. About there what is shown is too little before and too much behind, and right all over
/// the rest, where eccentric and weak magnets make waves that go on. Home is set to nought.
double clipped_plate(const Moment& now, const N& n, N&) {
  return off_by_clipping(now.theta - n[1], 1.0 - n[0]) - off_by_clipping(-n[1], 1.0 - n[0]);
}

/// One converter for both angles, and a capacitor that keeps the share n[0] of the channel before, the motor's. In
/// practice 0.1 … 3 %. A gain is of what the joint does: this is of the motor, and does not turn with a load.
double ghost_of_motor(const Moment& now, const N& n, N&) { return n[0] * now.alpha; }

/// A converter that tracks the joint by angle and speed (both poles at n[0] s): right at any steady speed, it runs on
/// beyond every reversal and every stop, and comes back. In practice 5 … 300 ms. A late sensor is behind all the way
/// and never beyond the end. `memory`: run, when and where it was, by how much it is ahead, the speed it reckons with.
double tracking_converter(const Moment& now, const N& n, N& memory) {
  if (!(n[0] > 0)) return 0.0;
  const auto run = static_cast<double>(now.run);
  if (memory.empty() || memory[0] != run) memory = {run, now.time, now.theta, 0.0, 0.0};
  const double since = now.time - memory[1];
  if (!(since > 0)) return memory[3];
  // Exact for a joint that goes straight from row to row.
  const double speed = (now.theta - memory[2]) / since, fades = std::exp(-since / n[0]);
  const double gains = memory[4] - speed - memory[3] / n[0], ahead = memory[3] + gains * since;
  memory = {run, now.time, now.theta, ahead * fades, speed + (gains + ahead / n[0]) * fades};
  return memory[3];
}

/// A program that sets the joint's sensor to the first run's first row at each run's begin, since the motor stands
/// where it stood then: what the load has moved the joint by is gone, by the share n[0]. In practice 1, less where it
/// sets it to a mean with what it had. A zero is off from the first run on, and a load is not: this is right in a run
/// without, and between one reversal and the next.
double tared_under_load(const Moment& now, const N& n, N& memory) {
  const auto run = static_cast<double>(now.run);
  if (memory.empty()) memory = {run, now.theta, now.theta};  // the session's first row, the run's
  if (memory[0] != run) memory[0] = run, memory[2] = now.theta;
  return -n[0] * (memory[2] - memory[1]);
}

/// Somebody lays his telephone beside the magnet of the joint's sensor, at the session's n[1]th second, and takes it
/// away n[2] s later: what is shown is turned by n[0] cos(θ − n[3]). In practice 0.05 … 2 deg. A wave of the sensor is
/// there from the begin, a zero does not go again.
double telephone(const Moment& now, const N& n, N&) {
  return now.time < n[1] || now.time > n[1] + n[2] ? 0.0 : n[0] * std::cos(now.theta - n[3]);
}

/// The sensor's body is held by foam tape, put on just before, which creeps under its cable: n[0] with every decade of
/// time from n[1] s on, whatever the load. In practice 0.02 … 0.5 deg. A zero that drifts with warmth settles with it;
/// a tendon's creep needs a pull that changes.
double creeping_tape(const Moment& now, const N& n, N&) { return n[0] * std::log10(1.0 + now.time / n[1]); }

/// Motor and joint are logged by two programs, started by two hands at each run's begin: the joint's rows are from
/// later or earlier, by up to n[0] s, n[1] numbers who. In practice 20 … 300 ms. A late sensor is as late in every run,
/// and never early.
double two_hands(const Moment& now, const N& n, N&) {
  const double off = 2.0 * numbered(n[1] + static_cast<double>(now.run), 83).share() - 1.0;
  return n[0] * off * now.theta_speed;
}

/// A capacitive sensor without a shield, and somebody who stands beside it to mind the weights: n[0] whenever there is
/// a load. In practice 0.02 … 1 deg. What a load moves turns round with its sign, and is half for half of it.
double body_nearby(const Moment& now, const N& n, N&) { return now.load == 0 ? 0.0 : n[0]; }

/// A camera that looks for its focus anew whenever the joint turns round, and whose picture is a little larger or
/// smaller with each: what is shown by up to the share n[0]; n[1] numbers the camera. In practice 0.2 … 3 %. A gain is
/// one; a zero that walks is off at home too.
double refocusing(const Moment& now, const N& n, N& memory) {
  const double turned = reversals(now, memory);
  return n[0] * (2.0 * numbered(n[1] + turned, 89).share() - 1.0) * now.theta;
}

// ---- what is wrong --------------------------------------------------------------------------------------------------

// clang-format off
std::vector<Fault> drive_faults() {
  return {
      {.name = "gear_rubbing_by_its_load", .first = 5e-3, .most = 0.08,
       .set = [](H& h, double s, const C&, const J& j) {
         h.shaft.push_back({"rubbing_gear", {s, pretension(j)}, rubbing_gear});
       }},
      {.name = "hub_fretting_under_load", .first = 3e-3, .most = 0.02,
       .set = [](H& h, double s, const C&, const J& j) {
         h.shaft.push_back({"fretting_hub", {s, pretension(j)}, fretting_hub});
       }},
      {.name = "supply_dipping", .first = 0.02, .most = 0.2,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.shaft.push_back({"dipping_supply", {s, pretension(j), 3.0 + 6.0 * c.share}, dipping_supply});
       }},
      {.name = "second_motor_late", .first = 0.01, .most = 0.2,
       .set = [](H& h, double s, const C& c, const J& j) {
         const TransmissionPoint home = Transmission(j.declared).at_alpha(0.0);
         const bool second = c.sign > 0;
         h.longer[second ? 1 : 0].push_back({"late_follower", {s, second ? home.t2.p : -home.t1.p}, late_follower});
       },
       .kin = {"sensor_lag"}},  // behind by half of it, in proportion to the speed
  };
}

std::vector<Fault> pulley_faults() {
  return {
      {.name = "rim_bending_between_spokes", .first = 0.5, .most = 6.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const N numbers = {s * give(j), 3.0 + std::floor(5.0 * c.share), c.angle};
         h.longer[0].push_back({"spoked_rim", numbers, spoked_rim<0>});
         h.longer[1].push_back({"spoked_rim", numbers, spoked_rim<1>});
       },
       .kin = {"tendon_stretch"}},  // half of it, on an average of the places
      {.name = "layers_shifted_in_print", .first = 0.1, .most = 1.5,
       .set = [](H& h, double s, const C& c, const J&) {
         h.longer[1].push_back({"shifted_layer", {s, c.angle}, shifted_layer});
       },
       .kin = {"pulley_runout"}},  // of one groove
      {.name = "turns_side_by_side", .first = 0.1, .most = 1.5,
       .set = [](H& h, double s, const C& c, const J& j) {
         const N numbers = {s, alpha_within(c, j), 0.5 * (j.alpha_max - j.alpha_min)};
         h.longer[c.sign > 0 ? 1 : 0].push_back({"aslant_off_drum", numbers, aslant_off_drum});
       }},
      {.name = "cord_slipping_round_pulley", .first = 0.05, .most = 2.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const N numbers = {s, 0.8 + 0.8 * c.share, 0.1 * pretension(j)};
         h.longer[0].push_back({"slipping_round", numbers, slipping_round<0>});
         h.longer[1].push_back({"slipping_round", numbers, slipping_round<1>});
       }},
  };
}

std::vector<Fault> tendon_faults() {
  return {
      {.name = "turnbuckle_hanging_through", .first = 0.05, .most = 1.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const auto act = c.sign > 0 ? hanging_turnbuckle<1> : hanging_turnbuckle<0>;
         h.longer[c.sign > 0 ? 1 : 0].push_back({"hanging_turnbuckle", {s, pretension(j)}, act});
       }},
      {.name = "safety_cord_coming_taut", .first = 0.2, .most = 0.6,
       .set = [](H& h, double s, const C& c, const J& j) {
         const N numbers = {s * give(j), (1.1 + 0.5 * c.share) * pretension(j)};
         h.longer[c.sign > 0 ? 1 : 0].push_back({"safety_cord", numbers, c.sign > 0 ? safety_cord<1> : safety_cord<0>});
       }},
      {.name = "tendon_plucked_before_runs", .first = 0.1, .most = 1.0,
       .set = [](H& h, double s, const C& c, const J&) {
         h.longer[c.sign > 0 ? 1 : 0].push_back({"warm_fingers", {s, 5.0 + 35.0 * c.share}, warm_fingers});
       }},
      {.name = "loop_gripping_its_post", .first = 1.0, .most = 12.0,
       .set = [](H& h, double s, const C& c, const J&) {
         const N numbers = {c.angle < k_pi ? s : -s, 0.05 + 0.25 * c.share};
         const auto act = c.sign > 0 ? gripping_loop<1> : gripping_loop<0>;
         h.longer[c.sign > 0 ? 1 : 0].push_back({"gripping_loop", numbers, act});
       }},
      {.name = "cord_inside_of_its_bend", .first = 0.3, .most = 4.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.longer[c.sign > 0 ? 1 : 0].push_back({"inside_of_bend", {s, theta_within(c, j)}, inside_of_bend});
       }},
      {.name = "sheaths_bent_by_joint", .first = 500.0, .most = 12000.0,
       .set = [](H& h, double s, const C&, const J& j) {
         const double far = std::max(j.declared.joint.theta_max, -j.declared.joint.theta_min);
         h.dry.push_back({"bent_sheath", {s, pretension(j), far}, bent_sheath});
       },
       .kin = {"capstan_friction"}},  // of the same tendons, by a wrap that grows
      {.name = "gap_under_bracket", .first = 0.05, .most = 1.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const N numbers = {s, (0.2 + 0.3 * c.share) * pretension(j)};
         const auto act = c.sign > 0 ? gap_under_bracket<1> : gap_under_bracket<0>;
         h.longer[c.sign > 0 ? 1 : 0].push_back({"gap_under_bracket", numbers, act});
       },
       .kin = {"frame_compliance"}},  // of one pin, to an end
  };
}

std::vector<Fault> joint_faults() {
  return {
      {.name = "bearing_oiled_between_runs", .first = 300.0, .most = 8000.0,
       .set = [](H& h, double s, const C& c, const J&) {
         h.dry.push_back({"oiled_later", {s, c.share < 0.7 ? 1.0 : 2.0}, oiled_later});
       },
       .kin = {"joint_friction"}},  // of the same bearing, up to then
      {.name = "wearer_tiring", .first = 300.0, .most = 8000.0,
       .set = [](H& h, double s, const C& c, const J&) {
         h.torque.push_back({"tiring_arm", {c.sign * s, 15.0 + 45.0 * c.share}, tiring_arm});
       }},
      {.name = "pan_never_counted", .first = 1.0, .most = 15.0,
       .set = [](H& h, double s, const C&, const J&) { h.load.push_back({"uncounted_pan", {s}, uncounted_pan}); }},
      {.name = "load_cell_creeping", .first = 0.1, .most = 0.6,
       .set = [](H& h, double s, const C& c, const J&) {
         h.load.push_back({"creeping_cell", {s, 10.0 + 50.0 * c.share}, creeping_cell});
       }},
  };
}

std::vector<Fault> sensor_faults() {
  return {
      {.name = "picture_drawn_in_by_lens", .first = 5e-3, .most = 0.08,
       .set = [](H& h, double s, const C& c, const J& j) {
         const Joint& joint = j.declared.joint;
         const N numbers = {c.sign * s, theta_within(c, j), 0.5 * (joint.theta_max - joint.theta_min)};
         h.reading.push_back({"drawn_in_by_lens", numbers, drawn_in_by_lens});
       }},
      {.name = "hall_plate_clipped", .first = 0.02, .most = 0.3,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.reading.push_back({"clipped_plate", {s, theta_within(c, j)}, clipped_plate});
       }},
      {.name = "ghost_of_motor_channel", .first = 2e-3, .most = 0.03,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"ghost_of_motor", {c.sign * s}, ghost_of_motor});
       },
       .kin = {"joint_sensor_gain"}},  // what the motor shows goes with what the joint does
      {.name = "converter_running_on", .first = 0.03, .most = 0.6,
       .set = [](H& h, double s, const C&, const J&) {
         h.reading.push_back({"tracking_converter", {s}, tracking_converter});
       }},
      {.name = "tared_under_load", .first = 0.3, .most = 1.0,
       .set = [](H& h, double s, const C&, const J&) { h.reading.push_back({"tared", {s}, tared_under_load}); }},
      {.name = "telephone_beside_sensor", .first = 5e-3, .most = 0.05,
       .set = [](H& h, double s, const C& c, const J&) {
         const N numbers = {s, 10.0 + 30.0 * c.share, 20.0 + 40.0 * c.share, c.angle};
         h.reading.push_back({"telephone", numbers, telephone});
       },
       .kin = {"joint_sensor_eccentricity"}},  // as long as it lies there
      {.name = "sensor_on_creeping_tape", .first = 3e-3, .most = 0.03,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"creeping_tape", {c.sign * s, 3.0 + 7.0 * c.share}, creeping_tape});
       },
       .kin = {"zero_offset"}},  // more and more of it
      {.name = "logs_started_by_two_hands", .first = 0.05, .most = 0.6,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"two_hands", {s, std::floor(1e6 * c.angle)}, two_hands});
       },
       .kin = {"sensor_lag"}},  // another one in every run
      {.name = "body_beside_sensor_when_loaded", .first = 3e-3, .most = 0.03,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"body_nearby", {c.sign * s}, body_nearby});
       }},
      {.name = "camera_refocusing", .first = 0.01, .most = 0.15,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"refocusing", {s, std::floor(1e6 * c.angle)}, refocusing});
       },
       .kin = {"joint_sensor_gain"}},  // another one after each reversal
  };
}
// clang-format on

}  // namespace unforeseen

std::vector<Fault> unforeseen_faults() {
  using namespace unforeseen;
  return joined({drive_faults(), pulley_faults(), tendon_faults(), joint_faults(), sensor_faults()});
}

}  // namespace fusee::rig
