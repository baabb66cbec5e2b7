// A fifth split that is kept aside: what goes wrong with tendon joints on real benches, by a sixth hand that saw
// neither how calibration infers nor what it makes of the other splits. Nothing is tuned on these; they are run once.
#include <algorithm>
#include <cmath>

#include "rig/fault_shapes.h"
#include "rig/faults.h"
#include "rig/random.h"

namespace fusee::rig {
namespace unopened {

using namespace short_names;

// ---- motor, gearbox, shaft ------------------------------------------------------------------------------------------

/// Pulses from the motor's cable are counted as steps upwards, the share n[0] of the way, whichever way it turns; the
/// encoder's index at α = n[1] sets the counter right at every passage. In practice 0.1 … 3 %. An offset stays, lost
/// counts add up for good, play is taken up at once: this grows from the index on, goes on growing on the way back, and
/// is gone there.
double healed_at_index(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.alpha, 0.0};
  const bool passed = (memory[0] < n[1]) != (now.alpha < n[1]);
  memory[1] = passed ? std::abs(now.alpha - n[1]) : memory[1] + std::abs(now.alpha - memory[0]);
  memory[0] = now.alpha;
  return -n[0] * memory[1];
}

/// Gears of plastic in a housing of metal shrink away from each other as they cool: play of n[0] for every 10 K. In
/// practice 0.1 … 3 deg. Backlash is as wide in the first stroke as in the last; expansion has no loop.
double cold_gears(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.alpha};
  const double width = n[0] * std::max(0.0, -now.warmth) / 10.0;
  return behind(now.alpha, 0.5 * width, memory[0]) - now.alpha;
}

/// The motor's rotor is out of balance and shakes the frame under the sensor, once in each of its turns (n[2] to one of
/// the shaft): n[0] at high speed, with the square of the speed below, and four times that where the frame resonates,
/// at n[1] rad/s of the shaft. In practice 0.02 … 1 deg. A wave of gear or sensor is as high at any speed; lag grows
/// with it and has one sign.
double unbalanced_rotor(const Moment& now, const N& n, N&) {
  constexpr double resonance = 4.0;
  const double r = now.alpha_speed / n[1];
  const double in_step = 1.0 - r * r, across = r / resonance;
  const double height = n[0] * r * r / std::hypot(in_step, across);
  return height * std::sin(n[2] * now.alpha + n[3] - std::atan2(across, in_step));
}

/// A tooth of the last wheel is chipped. Past α = n[1] its neighbour has to hold on beyond its flank, and the load (all
/// of it from n[3] N on) pushes the shaft back further and further, to n[0], until the next tooth takes over at once,
/// n[2] on; under the other load the same from the other side. In practice 0.5 … 5 deg. Play needs no load and knows
/// the way; a wave of the gear goes on, and stretch is everywhere: this is one tooth of a saw.
double chipped_tooth(const Moment& now, const N& n, N&) {
  const double on = (now.alpha - n[1]) / n[2];
  if (!(on > 0 && on < 1)) return 0.0;
  const double pushed = std::clamp(now.load / n[3], -1.0, 1.0);
  return -n[0] * pushed * (pushed > 0 ? on : 1.0 - on);
}

/// The motor's plate sits in slots, its screws not tight: both tendons together draw it towards the pins once they pull
/// with more than n[1] N, n[0] mm for every n[2] N more, and there it stays. In practice 0.1 … 2 mm. A frame comes
/// back and slip is one tendon's: this takes tension from both, after the hardest pull so far.
double sliding_motor(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0};
  // The hardest pull until now decides: the plate lies in one place while the joint settles.
  const double drawn = memory[0];
  memory[0] = std::max(drawn, now.tension[0] + now.tension[1] - n[1]);
  return -n[0] * drawn / n[2];
}

// ---- tendon, idlers, frame ------------------------------------------------------------------------------------------

/// Wound in beyond α = n[2] tendon 2 lies on its own turns. Pulled with more than n[1] N there, its last turn dives
/// between those below, which frees n[0] mm, and comes up again only as it is unwound. In practice 0.2 … 2 mm. A turn
/// that lies higher does so whatever the load; slip does not come back: this needs a load, a place, and what was
/// before.
double diving_turn(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0, now.alpha, now.tension[1]};
  // The last pull decides: a turn is above or below while the joint settles.
  if (memory[1] > n[2] && memory[2] > n[1]) memory[0] = 1.0;
  if (now.alpha < n[2]) memory[0] = 0.0;
  memory[1] = now.alpha;
  memory[2] = now.tension[1];
  return -n[0] * memory[0];
}

/// A tension spring in one tendon, that is to save it from blows: its coils lie on each other up to n[1] N, and beyond
/// that it opens by n[0] mm/N. In practice 0.5 … 10 times the tendon's own stretch. Stretch is in proportion from the
/// first newton on, and a tendon that hardens is soft where it is slack: this is soft where it is taut.
template <std::size_t side>
double opening_spring(const Moment& now, const N& n, N&) {
  return -n[0] * std::max(0.0, now.tension[side] - n[1]);
}

/// An idler bored off its middle by n[0] mm is rolled by its tendon, n[3] of its radians to one of the joint, but skids
/// and stands still where that pulls with less than n[2] N. In practice 0.05 … 0.5 mm. A pin has no wave and a
/// profile's goes with the motor: this has its phase from all the slack moments before.
template <std::size_t side>
double skidding_idler(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.theta, 0.0, now.tension[side]};
  // The last pull decides: it rolls or not while the joint settles.
  if (memory[2] > n[2]) memory[1] += n[3] * (now.theta - memory[0]);
  memory[0] = now.theta;
  memory[2] = now.tension[side];
  return n[0] * (std::sin(memory[1] + n[1]) - std::sin(n[1]));
}

/// An idler's screw works itself tight, and from the session's n[1]th second on the idler does not turn any more: the
/// tendon slides over it, with n[0] N·mm on the joint for n[2] N. In practice 20 … 1000 N·mm. A pin's friction is there
/// from the begin, and what wears or sets does so bit by bit.
template <std::size_t side>
double seized_idler(const Moment& now, const N& n, N&) {
  return now.time > n[1] ? n[0] * now.tension[side] / n[2] : 0.0;
}

/// The sun comes round to the window, and goes: from the session's n[1]th second for n[2] s it shines on one side of
/// the frame, which bows towards n[0] mm and back with the time constant n[3] s; one tendon's way is longer, the
/// other's shorter. In practice 0.05 … 0.5 mm. Expansion goes with the temperature that is logged, which only falls,
/// creep with the load.
double sun_on_frame(const Moment& now, const N& n, N&) {
  const auto warmed = [&](double since) { return 1.0 - std::exp(-std::max(0.0, now.time - since) / n[3]); };
  return n[0] * (warmed(n[1]) - warmed(n[1] + n[2]));
}

/// Both tendons run past the axis of a neighbouring joint, beside it, and a colleague exercises that one: it rests for
/// 3/10 of n[1] s, goes in 2/10, rests, goes back, again and again, and one way is longer by n[0] mm there, the other
/// shorter. In practice 0.1 … 1 mm. It keeps to a clock: no place, load, reversal or temperature of this joint has to
/// do with it.
double neighbour(const Moment& now, const N& n, N&) {
  const double beat = std::fmod(now.time / n[1], 1.0);
  return n[0] * (std::clamp((beat - 0.3) / 0.2, 0.0, 1.0) - std::clamp((beat - 0.8) / 0.2, 0.0, 1.0));
}

// ---- joint and link -------------------------------------------------------------------------------------------------

/// A plain bearing rubs with what presses on it: both tendons and the load, as vectors; n[0] mm: its radius times its
/// coefficient. In practice 0.2 … 5 mm. A bearing's friction as it is declared is the same under any force; pins rub
/// with their own tendon, and not with the load.
double pressed_bearing(const Moment& now, const N& n, N&) { return n[0] * force_on_axis(now).norm(); }

/// Grains of sand go round in the bearing: in every n[1] rad of the joint another one is under a ball, seldom in a way
/// that matters (the fourth power of what is drawn), up to n[0] N·mm, and after each reversal they lie differently. In
/// practice 50 … 3000 N·mm, 1 … 3 deg. Friction and dents are there again in the next stroke.
double sand(const Moment& now, const N& n, N& memory) {
  const double cell = 5000.0 + std::floor(now.theta / n[1]);
  return n[0] * std::pow(numbered(10000.0 * reversals(now, memory) + cell, 53).share(), 4);
}

/// A loop of the link's cable hooks on a screw's head: on the way up from θ = n[1] it is drawn tight, to n[0] N·mm over
/// n[2] rad, slips off there, and hooks again only after the link has come back. In practice 50 … 2000 N·mm, 3 … 12
/// deg. What rubs does so on both ways, a stop stays, and a pawl has many teeth.
double hooked_cable(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {1.0, now.theta};
  // Where the link was decides: a loop hangs on or not while the joint settles.
  if (memory[1] < n[1]) memory[0] = 1.0;
  if (memory[1] > n[1] + n[2]) memory[0] = 0.0;
  memory[1] = now.theta;
  return -n[0] * memory[0] * std::clamp((now.theta - n[1]) / n[2], 0.0, 1.0);
}

// ---- load -----------------------------------------------------------------------------------------------------------

/// The load is a bag of water that was weighed before the session, and drips: it loses the share n[0] a second. In
/// practice 10⁻⁴ … 0.01. A cell's gain is as wrong in the first run as in the last; creep, warmth and drifting zeros
/// go on without a load: this is nothing there.
double dripping_bag(const Moment& now, const N& n, N&) { return now.load * (std::exp(-n[0] * now.time) - 1.0); }

/// A winch whose control knows on and off alone: it stands while the link draws its cord tighter or lets it go, n[0] N
/// on n[1] rad of the motor's way, and only then sets the pull right, at once; it never pushes, and is unhooked without
/// a load. In practice 0.02 … 0.5 times the pretension, 8 … 30 deg. Friction is as large all the way: this is a saw,
/// turned round with the direction, in the load.
double on_off_winch(const Moment& now, const N& n, N& memory) {
  if (memory.empty() || now.load == 0) memory = {now.alpha, 0.0};
  memory[1] = std::fmod(memory[1] + now.alpha - memory[0], n[1]);
  memory[0] = now.alpha;
  const double more = n[0] * memory[1] / n[1];
  if (now.load > 0) return std::max(more, -now.load);
  return now.load < 0 ? std::min(more, -now.load) : 0.0;
}

// ---- joint's sensor, log --------------------------------------------------------------------------------------------

/// A logger that writes whole units of n[0] and the fraction as two numbers: between −n[0] and 0 the whole one is 0,
/// and 0 has no sign. In practice 1 deg … 0.1 rad. What is just below nought is shown just above it: a mirror at one
/// place, where gains, waves and zeros are felt everywhere.
double lost_minus(const Moment& now, const N& n, N&) {
  return now.theta < 0 && now.theta > -n[0] ? -2.0 * now.theta : 0.0;
}

/// The joint is filmed by a camera that reads its picture line by line, n[0] s from the first to the last: what is
/// shown is the later the further the link is from θ = n[1], n[0] late n[2] rad from there. In practice 5 … 100 ms. A
/// late sensor is as late anywhere.
double rolling_shutter(const Moment& now, const N& n, N&) {
  return -n[0] * std::abs(now.theta - n[1]) / n[2] * now.theta_speed;
}

/// The motor's cable passes the magnet of the joint's sensor, and its field turns what is shown: n[0] cos(θ − n[3]) for
/// the current of n[1] N, and what friction in the gear takes (the share n[2] of that) turns round with the direction.
/// In practice 0.1 … 2 deg. Stretch and friction move the joint, the more the softer the tendons: this moves what is
/// shown, on a joint held fast too.
double cable_field(const Moment& now, const N& n, N&) {
  return n[0] * (now.load / n[1] + n[2] * now.direction) * std::cos(now.theta - n[3]);
}

/// An amplifier that chooses its range by itself, and whose coarse one is off by the share n[0]: chosen beyond n[1] to
/// either side of home, and kept until the joint is back within the share n[2] of that. In practice 0.5 … 10 %. A gain
/// is one; a rail bends where this steps, and steps at the same place on both ways.
double coarse_range(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0};
  const double off = std::abs(now.theta);
  if (off > n[1]) memory[0] = 1.0;
  if (off < n[2] * n[1]) memory[0] = 0.0;
  return n[0] * memory[0] * now.theta;
}

// ---- what is wrong --------------------------------------------------------------------------------------------------

// clang-format off
std::vector<Fault> drive_faults() {
  return {
      {.name = "counts_healed_at_index", .first = 2e-3, .most = 0.06,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.shaft.push_back({"healed_at_index", {s, alpha_within(c, j)}, healed_at_index});
       }},
      {.name = "gears_shrinking_apart", .first = 0.05, .most = 0.4,
       .set = [](H& h, double s, const C&, const J&) { h.shaft.push_back({"cold_gears", {s}, cold_gears}); },
       .kin = {"backlash"}},  // play between motor and pulley, more and more of it
      {.name = "unbalanced_rotor", .first = 1e-3, .most = 0.03,
       .set = [](H& h, double s, const C& c, const J&) {
         const N numbers = {s, radians(20.0 + 60.0 * c.share), 20.0 + std::floor(40.0 * c.share), c.angle};
         h.reading.push_back({"unbalanced_rotor", numbers, unbalanced_rotor});
       }},
      {.name = "chipped_tooth", .first = 0.03, .most = 0.3,
       .set = [](H& h, double s, const C& c, const J& j) {
         const double pitch = radians(9.0 + 9.0 * c.angle / k_two_pi);
         h.shaft.push_back({"chipped_tooth", {s, alpha_within(c, j), pitch, 0.1 * pretension(j)}, chipped_tooth});
       }},
      {.name = "motor_sliding_in_slots", .first = 2.0, .most = 15.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const N numbers = {s, (2.0 + 0.2 * c.share) * pretension(j), pretension(j)};
         for (auto& own : h.longer) own.push_back({"sliding_motor", numbers, sliding_motor});
       },
       .kin = {"slack"}},  // tendon too much, of both together, from the hardest pull on
  };
}

std::vector<Fault> tendon_faults() {
  return {
      {.name = "turn_diving_under_load", .first = 0.1, .most = 3.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const N numbers = {s, (1.2 + 0.3 * c.share) * pretension(j), (0.1 + 0.4 * c.share) * j.alpha_max};
         h.longer[1].push_back({"diving_turn", numbers, diving_turn});
       }},
      {.name = "spring_that_opens", .first = 1.0, .most = 15.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const N numbers = {s * give(j), (1.1 + 0.4 * c.share) * pretension(j)};
         const bool second = c.sign > 0;
         h.longer[second ? 1 : 0].push_back({"opening_spring", numbers, second ? opening_spring<1> : opening_spring<0>});
       },
       .kin = {"tendon_stretch"}},  // longer by its tension, if from a pull on
      {.name = "skidding_eccentric_idler", .first = 0.1, .most = 1.5,
       .set = [](H& h, double s, const C& c, const J& j) {
         const N numbers = {s, c.angle, (0.3 + 0.3 * c.share) * pretension(j), 6.0 + 14.0 * c.share};
         const bool second = c.sign > 0;
         h.longer[second ? 1 : 0].push_back({"skidding_idler", numbers, second ? skidding_idler<1> : skidding_idler<0>});
       }},
      {.name = "idler_that_seizes", .first = 100.0, .most = 4000.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const N numbers = {s, 15.0 + 45.0 * c.share, pretension(j)};
         h.dry.push_back({"seized_idler", numbers, c.sign > 0 ? seized_idler<1> : seized_idler<0>});
       },
       .kin = {"capstan_friction"}},  // of the same guide, from a moment on
      {.name = "sun_on_frame", .first = 0.1, .most = 1.0,
       .set = [](H& h, double s, const C& c, const J&) {
         const double from = 5.0 + 5.0 * c.angle, lasts = 20.0 + 40.0 * c.share, follows = 15.0 + 30.0 * c.share;
         h.longer[0].push_back({"sun_on_frame", {c.sign * s, from, lasts, follows}, sun_on_frame});
         h.longer[1].push_back({"sun_on_frame", {-c.sign * s, from, lasts, follows}, sun_on_frame});
       },
       .kin = {"thermal_expansion"}},  // of the frame, on a clock of its own
      {.name = "neighbouring_joint", .first = 0.1, .most = 1.5,
       .set = [](H& h, double s, const C& c, const J&) {
         const double beat = 8.0 + 12.0 * c.share;
         h.longer[0].push_back({"neighbour", {c.sign * s, beat}, neighbour});
         h.longer[1].push_back({"neighbour", {-c.sign * s, beat}, neighbour});
       }},
  };
}

std::vector<Fault> link_faults() {
  return {
      {.name = "bearing_rubbing_by_force", .first = 4.0, .most = 60.0,
       .set = [](H& h, double s, const C&, const J&) { h.dry.push_back({"pressed_bearing", {s}, pressed_bearing}); },
       .kin = {"joint_friction"}},  // of the same bearing, on an average
      {.name = "sand_in_bearing", .first = 500.0, .most = 12000.0,
       .set = [](H& h, double s, const C& c, const J&) {
         h.dry.push_back({"sand", {s, radians(1.0 + 2.0 * c.share)}, sand});
       },
       .kin = {"joint_friction"}},  // of the same bearing, now and then
      {.name = "cable_hooked_on_screw", .first = 200.0, .most = 6000.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const double at = (0.4 * c.share - 0.1) * j.declared.joint.theta_max;
         h.torque.push_back({"hooked_cable", {s, at, radians(3.0 + 9.0 * c.angle / k_two_pi)}, hooked_cable});
       }},
      {.name = "dripping_bag", .first = 1e-3, .most = 0.02,
       .set = [](H& h, double s, const C&, const J&) { h.load.push_back({"dripping_bag", {s}, dripping_bag}); }},
      {.name = "on_off_winch", .first = 0.1, .most = 1.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.load.push_back({"on_off_winch", {s * pretension(j), radians(8.0 + 22.0 * c.share)}, on_off_winch});
       }},
  };
}

std::vector<Fault> sensor_faults() {
  return {
      {.name = "lost_minus_sign", .first = 0.01, .most = 0.2,
       .set = [](H& h, double s, const C&, const J&) { h.reading.push_back({"lost_minus", {s}, lost_minus}); }},
      {.name = "rolling_shutter", .first = 0.02, .most = 0.4,
       .set = [](H& h, double s, const C& c, const J& j) {
         const Joint& joint = j.declared.joint;
         const N numbers = {s, end_of_range(c, j), joint.theta_max - joint.theta_min};
         h.reading.push_back({"rolling_shutter", numbers, rolling_shutter});
       },
       .kin = {"sensor_lag"}},  // shown late
      {.name = "motor_cable_at_magnet", .first = 5e-3, .most = 0.06,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.reading.push_back({"cable_field", {c.sign * s, pretension(j), 0.1 + 0.3 * c.share, c.angle}, cable_field});
       }},
      {.name = "coarse_range_off", .first = 0.01, .most = 0.15,
       .set = [](H& h, double s, const C& c, const J& j) {
         const Joint& joint = j.declared.joint;
         const double coarse = (0.3 + 0.3 * c.share) * std::min(joint.theta_max, -joint.theta_min);
         h.reading.push_back({"coarse_range", {c.sign * s, coarse, 0.4 + 0.4 * c.angle / k_two_pi}, coarse_range});
       },
       .kin = {"joint_sensor_gain"}},  // of a part of the range
  };
}
// clang-format on

}  // namespace unopened

std::vector<Fault> unopened_faults() {
  using namespace unopened;
  return joined({drive_faults(), tendon_faults(), link_faults(), sensor_faults()});
}

}  // namespace fusee::rig
