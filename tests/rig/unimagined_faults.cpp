// An eleventh split that is kept aside: what goes wrong with tendon joints on real benches, by a twelfth hand that saw
// neither how calibration infers nor what it makes of the other splits. Nothing is tuned on these; they are run once.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "fusee/transmission/transmission.h"
#include "rig/fault_shapes.h"
#include "rig/faults.h"
#include "rig/random.h"

namespace fusee::rig {
namespace unimagined {

using namespace short_names;

/// What of `x` stands beyond its value in the session's first moment.
double since_home(double x, N& memory) {
  if (memory.empty()) memory = {x};
  return x - memory[0];
}
/// s for which the motor has stood by now; 0 while it moves.
double standing(const Moment& now, double& stood) { return stood = now.alpha_speed == 0 ? stood + now.seconds : 0.0; }
/// How warm the motor is by what it does, for what sees the rows alone: 1 when it has long gone with 1 rad/s, and with
/// the square of that. `memory`: when, and how warm.
double worked_warm(const Moment& now, double constant, N& memory) {
  if (memory.empty()) memory = {now.time, 0.0};
  const double since = now.time - memory[0];
  memory[0] = now.time;
  return followed(now.alpha_speed * now.alpha_speed, since, constant, memory[1]);
}
/// −1 … 1, another one for every number.
double to_either_side(double number, std::uint64_t stream) { return 2.0 * numbered(number, stream).share() - 1.0; }
double number_of(const C& c) { return std::floor(1e6 * c.angle); }

// ---- motor, gearbox, shaft ------------------------------------------------------------------------------------------

/// Motor and pulley are not in line, and a universal joint makes up for it: twice a turn the pulley is ahead and twice
/// behind, by n[0] (tan² of half the bend), its fork n[1] round at home. In practice 0.1 … 2 deg (5 … 20 deg of bend).
double universal_joint(const Moment& now, const N& n, N&) {
  const double c = (1.0 - n[0]) / (1.0 + n[0]);  // the bend's cosine
  const auto ahead = [&](double x) {
    return -std::atan2((1.0 - c) * std::sin(x) * std::cos(x), std::pow(std::cos(x), 2) + c * std::pow(std::sin(x), 2));
  };
  return ahead(now.alpha + n[1]) - ahead(n[1]);
}

/// A thin shaft between motor and pulley twists by what the tendons pull the pulley round with, n[0] for 1 N·mm more
/// than at home; n[1], n[2] mm: their arms, as at home. In practice 0.2 … 5 deg at full load. A rubber coupling's jaws
/// bite in the end, a motor that gets weak does so late: this is straight.
template <std::size_t side>
double twisting_shaft(const Moment& now, const N& n, N& memory) {
  const double twist = -n[0] * since_home(n[2] * now.tension[1] - n[1] * now.tension[0], memory);
  return side == 1 ? n[2] * twist : -n[1] * twist;
}

/// A slipping clutch that is to save the gear is set too weak, and creeps: the shaft goes back before the load, by n[0]
/// rad/s for n[1] N, in motion and at rest. In practice 0.002 … 0.1 deg/s. A belt loses by its way, a hub that frets
/// by the reversals: this by the clock, and only the other load brings it back.
double creeping_clutch(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0};
  return memory[0] -= n[0] * now.load / n[1] * now.seconds;
}

/// A motor whose current is cut off when it stands is drawn to the nearest pole of its magnets within n[3] s: by up to
/// n[0], n[1] poles a turn of the shaft, n[2] from one of them at home. In practice 0.05 … 1 deg behind a gear. Cogging
/// goes on in motion, a load takes the shaft to its own side, a brake always to the same: here the place decides, and
/// the next step brings it back.
double drawn_to_poles(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0};
  return standing(now, memory[0]) < n[3] ? 0.0 : -n[0] * std::sin(n[1] * now.alpha + n[2]);
}

/// Two wheels that are not cut about their middle come closer and part again: the play between them is n[0] at most
/// and nothing half a round later, n[1] rounds to one of the shaft, n[2] from the widest at home. In practice 0.2 … 5
/// deg. A sector that is worn is one place, and play as it is declared as wide everywhere.
double breathing_play(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.alpha};
  const double width = 0.5 * n[0] * (1.0 + std::cos(n[1] * now.alpha + n[2]));
  return behind(now.alpha, 0.5 * width, memory[0]) - now.alpha;
}

/// There is no motor yet: somebody cranks the pulley to one mark after another, and the log holds the marks. It stands
/// off each by n[0] (standard deviation), another way at every place he comes to; n[1] numbers him. In practice 0.1 …
/// 2 deg. Noise of a sensor is as high wherever the joint stands: this is geared down, and lost in the friction.
/// `memory`: the last mark, how many so far, off by.
double cranked_by_hand(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.alpha, 0.0, 0.0};
  if (now.alpha != memory[0]) {
    const double marks = memory[1] + 1.0;
    memory = {now.alpha, marks, n[0] * numbered(n[1] + marks, 97).normal()};
  }
  return memory[2];
}

// ---- pulley, tendons, frame -----------------------------------------------------------------------------------------

/// A pulley of soft plastic goes oval under its tendons, more and more: n[0] mm of way with every decade of time from
/// n[1] s on, two waves a turn, n[2] round at home. In practice 0.02 … 0.3 mm a decade. A profile is as wrong in the
/// first stroke as in the last, and what creeps else does so at any place: this is their product.
template <std::size_t side>
double going_oval(const Moment& now, const N& n, N&) {
  constexpr double sign = side == 1 ? 1.0 : -1.0;
  const double decades = std::log10(1.0 + now.time / n[1]);
  return sign * n[0] * decades * (std::sin(2.0 * now.alpha + n[2]) - std::sin(n[2]));
}

/// A cord of nylon, from a dry drawer to a damp room, takes up water and gets longer, as far as that has come by
/// diffusion: n[0] mm within n[1] s, with the root of the time, and no more then. In practice 0.1 … 2 mm.
double taking_up_damp(const Moment& now, const N& n, N&) { return -n[0] * std::sqrt(std::min(1.0, now.time / n[1])); }

/// What the tendons pull is taken by one slim strut between pulley and joint, which was not quite straight: it bows
/// further, as any strut does on its way to buckling (at n[1] N; four fifths of it at most), n[0] mm where that doubles
/// it, and one way is longer by it and the other shorter. In practice 0.05 … 1 mm. A frame that gives does so to each
/// tendon's side: this to one side under either load, once that has left one tendon slack, and faster than in
/// proportion.
template <std::size_t side>
double bowing_strut(const Moment& now, const N& n, N& memory) {
  constexpr double sign = side == 1 ? -1.0 : 1.0;
  const double near = std::clamp((now.tension[0] + now.tension[1]) / n[1], 0.0, 0.8);
  return sign * n[0] * since_home(near / (1.0 - near), memory);
}

/// A tendon is warmed by its own rubbing on the pin, which takes pull times speed: it is longer by n[0] mm when it has
/// long gone with n[1] N at 1 rad/s of the motor, and follows that with n[2] s. In practice 0.02 … 0.5 mm (from steel
/// to polyethylene). Expansion goes by what the thermometer shows, creep by the pull alone: this needs both pull and
/// haste.
template <std::size_t side>
double warmed_by_rubbing(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0};
  const double power = now.tension[side] / n[1] * std::abs(now.alpha_speed);
  return -n[0] * followed(power, now.seconds, n[2], memory[0]);
}

/// Instead of a pin a ring on a shackle n[0] mm long, that swings to where both ends of its tendon draw it. It hangs
/// where the file has it at home; the way is the shorter the more their resultant has turned since. n[1] rad: from
/// upright, of the way from the pulley up to it. In practice 5 … 30 mm. A pin in a wrong place is felt from home on,
/// in proportion: this by the square.
template <std::size_t side>
double swinging_shackle(const Moment& now, const N& n, N& memory) {
  const Vec2 drawn = -now.pull[side] - up_to_pins(n[1], n[1])[side];
  if (memory.empty()) memory = {drawn.normalized().x(), drawn.normalized().y()};
  return -n[0] * (drawn.norm() - drawn.dot(Vec2(memory[0], memory[1])));
}

// ---- joint, load ----------------------------------------------------------------------------------------------------

/// A load presses the grease out of the joint's bearing, and it comes back without: dry friction that goes to n[0]
/// N·mm under n[1] N, in proportion, with the time constant n[2] s. In practice 50 … 2000 N·mm, 10 … 40 s. A bearing's
/// friction is there at once, and one that rubs by its force too.
double grease_pressed_out(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0};
  return n[0] * followed(std::abs(now.load) / n[1], now.seconds, n[2], memory[0]);
}

/// An exoskeleton with somebody in it who means well: n[1] s after the joint has turned round he has noticed, and helps
/// along with n[0] N·mm as long as it moves. In practice 50 … 2000 N·mm, 0.2 … 0.6 s. Whatever rubs leaves the joint
/// behind: this takes it ahead, and lets go at rest. `memory`: the way, s since that is so.
double helping_along(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.direction, 0.0};
  memory[1] = now.direction == memory[0] ? memory[1] + now.seconds : 0.0;
  memory[0] = now.direction;
  return now.alpha_speed != 0 && memory[1] >= n[1] ? n[0] * now.direction : 0.0;
}

/// Plates that somebody cast himself: each should weigh n[1] N and is off by up to the share n[0] of that, n[2] numbers
/// the set; they are hung on in their order, to whichever side, the last one by as much of it as is missing. In
/// practice 1 … 20 %. A cell is wrong in proportion, a pan as much under any load: here each load has its own error.
double uneven_plates(const Moment& now, const N& n, N&) {
  double left = std::abs(now.load) / n[1], off = 0;
  for (double plate = 0; left > 0; ++plate, --left) off += std::min(1.0, left) * to_either_side(n[2] + plate, 101);
  return std::copysign(n[0] * n[1] * off, now.load);
}

/// The weight is on a long cord and swings from being hung on: its pull goes up and down by the share n[0], with n[1]
/// rad/s (twice the pendulum's), and that dies away within n[2] s of each run. In practice 0.02 … 0.3, cords of 1 … 4
/// m. A weight that bounces is struck at each change of speed, one who wavers never stops.
double swinging_weight(const Moment& now, const N& n, N&) {
  return n[0] * now.load * std::exp(-now.run_time / n[2]) * std::cos(n[1] * now.run_time);
}

/// Beyond θ = n[1] towards n[3] the load's cord lies on a corner of the link, nearer to the axis, and the further the
/// link turns the less lever is left: the share n[0] less at n[2] from there. In practice 0.03 … 0.4. A cord that leans
/// does so from home to both sides, a weight that lands has landed after 4 deg: this has a corner, and goes on.
double cord_over_corner(const Moment& now, const N& n, N&) {
  return -n[0] * now.load * std::max(0.0, n[3] * (now.theta - n[1])) / n[2];
}

/// Whenever the motor stands for longer than n[1] s somebody puts his hand under the weight, to steady it, and carries
/// the share n[0] of it until the next step. In practice 0.05 … 0.5, 0.3 … 1 s. A hand at the run's begin lets go by
/// itself, current that is saved gives way to the load: this takes it away, and the joint rises.
double hand_under_weight(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0};
  return standing(now, memory[0]) > n[1] ? -n[0] * now.load : 0.0;
}

// ---- joint's sensor, log --------------------------------------------------------------------------------------------

/// A converter that weighs bit by bit, and whose heaviest bit weighs n[0] too much; both ends were set right. At half
/// its scale, θ = n[1], what is shown jumps by n[0], and loses that again evenly over the scale, n[2] wide. In practice
/// 0.02 … 1 deg. Scales that are glued step alone, and gains have no jump. Home is set to nought.
double misweighed_bit(const Moment& now, const N& n, N&) {
  const auto off = [&](double theta) { return (theta > n[1] ? 1.0 : 0.0) - (theta - n[1]) / n[2]; };
  return n[0] * (off(now.theta) - off(0.0));
}

/// A program that keeps whole units of n[0] and cuts off the rest: what is shown is nearer to nought, half a unit on an
/// average, and stands still there over two. In practice 0.1 … 2 deg. A quantum is rounded to the nearest.
double cut_off_rest(const Moment& now, const N& n, N&) {
  return n[0] > 0 ? n[0] * std::trunc(now.theta / n[0]) - now.theta : 0.0;
}

/// A sensor of two tracks: the fine one is read within its sector, n[0] wide, and the coarse one tells which. That one
/// is late on the way up, and over the share n[2] behind each border (one at θ = n[1]) the old sector is told. In
/// practice 0.2 … 3 deg, 5 … 25 % of it. Dirt and gluing stay from there on: this is one sector too little, and right
/// again at once.
double wrong_sector(const Moment& now, const N& n, N&) {
  if (!(n[0] > 0) || !(now.theta_speed > 0)) return 0.0;
  const double sectors = (now.theta - n[1]) / n[0];
  return sectors - std::floor(sectors) < n[2] ? -n[0] : 0.0;
}

/// No sensor at all but a protractor, and somebody who likes round numbers: what he writes is drawn to the nearest of
/// the marks, n[1] apart, by up to n[0] (half of n[1]: onto it). In practice 0.1 … 2 deg, marks every 5 or 10. A saw of
/// many teeth, steep between the marks and flat at them, whatever the load.
double round_numbers(const Moment& now, const N& n, N&) { return -2.0 * n[0] * std::remainder(now.theta, n[1]) / n[1]; }

/// The joint's sensor is switched on with each run, and cold: off by n[0], less and less as it warms, within n[1] s. In
/// practice 0.05 … 1 deg, 5 … 40 s. A zero that goes with the room's temperature goes on from run to run, a gyroscope
/// gets worse within each: this gets right.
double cold_at_start(const Moment& now, const N& n, N&) { return n[0] * std::exp(-now.run_time / n[1]); }

/// The sensor is made up for its warmth, but by a thermometer that is glued to the motor: off by n[0] when that has
/// long gone with 1 rad/s, with the square, and n[1] s late. In practice 0.1 … 3 deg. What follows the room only falls;
/// this comes with fast runs and goes in slow ones.
double wrong_thermometer(const Moment& now, const N& n, N& memory) { return n[0] * worked_warm(now, n[1], memory); }

/// A bus that sends by how much the angle has changed, and the angle itself every n[1] s only. In between a message is
/// lost, at any time (n[2] numbers the bus): what the joint does in n[0] s is missing until the angle comes again. In
/// practice 10 … 300 ms, every 3 … 12 s. A bus that hangs is right again at once, and an index stands at a place.
/// `memory`: which interval, whether lost, off by.
double lost_difference(const Moment& now, const N& n, N& memory) {
  const double interval = std::floor(now.time / n[1]);
  if (memory.empty() || memory[0] != interval) memory = {interval, 0.0, 0.0};
  const double lost_at = (interval + numbered(n[2] + interval, 103).share()) * n[1];
  if (memory[1] == 0 && now.time >= lost_at) memory[1] = 1.0, memory[2] = -n[0] * now.theta_speed;
  return memory[2];
}

/// The link is seen across the motor, and the air over that shimmers when it is warm: another way in each row, n[0]
/// (rms) when it has long gone with 1 rad/s, and with the square; n[1] s late, n[2] numbers the air. In practice 0.05 …
/// 1 deg. Noise as it was declared is as high in a slow run as after a fast one.
double shimmering_air(const Moment& now, const N& n, N& memory) {
  const double warm = worked_warm(now, n[1], memory);
  if (memory.size() == 2) memory.push_back(0.0);
  return n[0] * warm * numbered(n[2] + memory[2]++, 107).normal();
}

/// A sensor by sine and cosine whose sine is read n[0] s before its cosine: what is shown is late where the cosine is
/// flat and right where it is steep, or in between; n[1] sines a turn, n[2] on at home. In practice 5 … 200 ms. A late
/// sensor is as late everywhere, one that reads its picture line by line has one place: these are many.
double one_channel_late(const Moment& now, const N& n, N&) {
  return -n[0] * now.theta_speed * std::pow(std::cos(n[1] * now.theta + n[2]), 2);
}

/// An inclinometer of one axis, on a joint whose axle does not lie level: it shows less than the joint turns, the share
/// n[0] less of the sine (1 − cos of the axle's slope) from θ = n[1] on, where the link points up. In practice 0.002 …
/// 0.06 (4 … 20 deg). Home is set to nought.
double sloping_axle(const Moment& now, const N& n, N&) {
  const auto off = [&](double x) { return std::asin((1.0 - n[0]) * std::sin(x)) - std::asin(std::sin(x)); };
  return off(now.theta - n[1]) - off(-n[1]);
}

/// Somebody who passes knocks at the sensor, at the session's n[1]th second: it shows n[0] more from then on. In
/// practice 0.05 … 2 deg. A zero is off from the begin, and what creeps does so bit by bit.
double knocked(const Moment& now, const N& n, N&) { return now.time > n[1] ? n[0] : 0.0; }

/// A sensor that learns its range: it takes the least and the greatest it has seen for the ends, n[1] and n[2], and
/// stretches what it shows to them, by the share n[0]; at first it knows the middle half. In practice 0.05 … 1. A gain
/// is the same from the begin: this falls in the first stroke, and whenever the joint goes further than ever.
double learning_range(const Moment& now, const N& n, N& memory) {
  const double middle = 0.5 * (n[1] + n[2]), quarter = 0.25 * (n[2] - n[1]);
  if (memory.empty()) memory = {middle - quarter, middle + quarter};
  memory = {std::min(memory[0], now.theta), std::max(memory[1], now.theta)};
  const double stretched = n[1] + (now.theta - memory[0]) / (memory[1] - memory[0]) * (n[2] - n[1]);
  return n[0] * (stretched - now.theta);
}

// ---- what is wrong --------------------------------------------------------------------------------------------------

// clang-format off
std::vector<Fault> drive_faults() {
  return {
      {.name = "shaft_through_universal_joint", .first = 5e-3, .most = 0.06,
       .set = [](H& h, double s, const C& c, const J&) {
         h.shaft.push_back({"universal_joint", {s, c.angle}, universal_joint});
       },
       .kin = {"motor_sensor_harmonic"}},  // two waves a turn
      {.name = "long_shaft_twisting", .first = 0.01, .most = 0.15,
       .set = [](H& h, double s, const C&, const J& j) {
         const TransmissionPoint home = Transmission(j.declared).at_alpha(0.0);
         const N numbers = {s / (pretension(j) * home.t2.p), home.t1.p, home.t2.p};
         h.longer[0].push_back({"twisting_shaft", numbers, twisting_shaft<0>});
         h.longer[1].push_back({"twisting_shaft", numbers, twisting_shaft<1>});
       },
       .kin = {"tendon_stretch"}},  // in proportion to what pulls
      {.name = "clutch_creeping_under_load", .first = 2e-4, .most = 4e-3,
       .set = [](H& h, double s, const C&, const J& j) {
         h.shaft.push_back({"creeping_clutch", {s, pretension(j)}, creeping_clutch});
       }},
      {.name = "shaft_drawn_to_poles_at_rest", .first = 5e-3, .most = 0.05,
       .set = [](H& h, double s, const C& c, const J&) {
         const N numbers = {s, 24.0 + std::floor(24.0 * c.share), c.angle, 0.3};
         h.shaft.push_back({"drawn_to_poles", numbers, drawn_to_poles});
       }},
      {.name = "play_going_round_with_wheel", .first = 0.02, .most = 0.3,
       .set = [](H& h, double s, const C& c, const J&) {
         h.shaft.push_back({"breathing_play", {s, 2.0 + std::floor(4.0 * c.share), c.angle}, breathing_play});
       },
       .kin = {"backlash"}},  // half of it, on an average of the places
      {.name = "cranked_to_marks_by_hand", .first = 0.01, .most = 0.1,
       .set = [](H& h, double s, const C& c, const J&) {
         h.shaft.push_back({"cranked_by_hand", {s, number_of(c)}, cranked_by_hand});
       }},
  };
}

std::vector<Fault> tendon_faults() {
  return {
      {.name = "pulley_going_oval", .first = 0.1, .most = 1.0,
       .set = [](H& h, double s, const C& c, const J&) {
         const N numbers = {s, 3.0 + 7.0 * c.share, c.angle};
         h.longer[0].push_back({"going_oval", numbers, going_oval<0>});
         h.longer[1].push_back({"going_oval", numbers, going_oval<1>});
       },
       .kin = {"profile_error"}},  // more and more of it
      {.name = "cord_taking_up_damp", .first = 0.2, .most = 3.0,
       .set = [](H& h, double s, const C& c, const J&) {
         h.longer[c.sign > 0 ? 1 : 0].push_back({"taking_up_damp", {s, 150.0 + 150.0 * c.share}, taking_up_damp});
       },
       .kin = {"thermal_expansion"}},  // of one tendon, as slow as the room cools
      {.name = "strut_on_its_way_to_buckling", .first = 0.5, .most = 4.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const N numbers = {c.sign * s, (4.0 + 4.0 * c.share) * pretension(j)};
         h.longer[0].push_back({"bowing_strut", numbers, bowing_strut<0>});
         h.longer[1].push_back({"bowing_strut", numbers, bowing_strut<1>});
       }},
      {.name = "tendon_warmed_by_its_rubbing", .first = 0.1, .most = 2.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const N numbers = {s, pretension(j), 10.0 + 30.0 * c.share};
         h.longer[0].push_back({"warmed_by_rubbing", numbers, warmed_by_rubbing<0>});
         h.longer[1].push_back({"warmed_by_rubbing", numbers, warmed_by_rubbing<1>});
       }},
      {.name = "guide_on_swinging_shackle", .first = 10.0, .most = 60.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const std::size_t side = c.sign > 0 ? 1 : 0;
         const auto act = c.sign > 0 ? swinging_shackle<1> : swinging_shackle<0>;
         h.longer[side].push_back({"swinging_shackle", {s, ways_to_pins(j)[side]}, act});
       },
       .kin = {"guide_position"}},  // another one for every place of the joint
  };
}

std::vector<Fault> joint_faults() {
  return {
      {.name = "grease_pressed_out_by_load", .first = 300.0, .most = 8000.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.dry.push_back({"grease_pressed_out", {s, pretension(j), 10.0 + 30.0 * c.share}, grease_pressed_out});
       },
       .kin = {"joint_friction"}},  // of the same bearing, under a load
      {.name = "wearer_helping_along", .first = 300.0, .most = 8000.0,
       .set = [](H& h, double s, const C& c, const J&) {
         h.torque.push_back({"helping_along", {s, 0.2 + 0.4 * c.share}, helping_along});
       }},
      {.name = "plates_none_like_another", .first = 0.1, .most = 0.6,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.load.push_back({"uneven_plates", {s, (0.2 + 0.3 * c.share) * pretension(j), number_of(c)}, uneven_plates});
       }},
      {.name = "weight_swinging_when_hung_on", .first = 0.1, .most = 0.8,
       .set = [](H& h, double s, const C& c, const J&) {
         h.load.push_back({"swinging_weight", {s, 3.0 + 3.0 * c.share, 10.0 + 3.0 * c.angle}, swinging_weight});
       }},
      {.name = "cord_over_corner_of_link", .first = 0.1, .most = 0.8,
       .set = [](H& h, double s, const C& c, const J& j) {
         const double corner = theta_within(c, j);
         h.load.push_back({"cord_over_corner", {s, corner, std::abs(end_of_range(c, j) - corner), c.sign}, cord_over_corner});
       }},
      {.name = "hand_under_weight_at_rests", .first = 0.1, .most = 0.9,
       .set = [](H& h, double s, const C& c, const J&) {
         h.load.push_back({"hand_under_weight", {s, 0.3 + 0.7 * c.share}, hand_under_weight});
       }},
  };
}

std::vector<Fault> sensor_faults() {
  return {
      {.name = "heaviest_bit_misweighed", .first = 5e-3, .most = 0.05,
       .set = [](H& h, double s, const C& c, const J& j) {
         const Joint& joint = j.declared.joint;
         const N numbers = {c.sign * s, theta_within(c, j), 2.0 * (joint.theta_max - joint.theta_min)};
         h.reading.push_back({"misweighed_bit", numbers, misweighed_bit});
       }},
      {.name = "rest_cut_off_towards_nought", .first = 5e-3, .most = 0.08,
       .set = [](H& h, double s, const C&, const J&) { h.reading.push_back({"cut_off_rest", {s}, cut_off_rest}); }},
      {.name = "fine_track_in_wrong_sector", .first = 5e-3, .most = 0.08,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.reading.push_back({"wrong_sector", {s, theta_within(c, j), 0.05 + 0.2 * c.share}, wrong_sector});
       }},
      {.name = "protractor_read_in_round_numbers", .first = 4e-3, .most = 0.04,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"round_numbers", {s, radians(c.share < 0.7 ? 5.0 : 10.0)}, round_numbers});
       }},
      {.name = "sensor_cold_at_every_start", .first = 5e-3, .most = 0.05,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"cold_at_start", {c.sign * s, 5.0 + 35.0 * c.share}, cold_at_start});
       }},
      {.name = "thermometer_glued_to_motor", .first = 0.01, .most = 0.5,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"wrong_thermometer", {c.sign * s, 10.0 + 50.0 * c.share}, wrong_thermometer});
       }},
      {.name = "difference_lost_on_bus", .first = 0.1, .most = 1.5,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"lost_difference", {s, 3.0 + 9.0 * c.share, number_of(c)}, lost_difference});
       }},
      {.name = "air_shimmering_over_motor", .first = 0.01, .most = 0.5,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"shimmering_air", {s, 10.0 + 50.0 * c.share, number_of(c)}, shimmering_air});
       }},
      {.name = "sine_read_before_cosine", .first = 0.05, .most = 0.8,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"one_channel_late", {s, 4.0 + std::floor(12.0 * c.share), c.angle}, one_channel_late});
       },
       .kin = {"sensor_lag"}},  // half of it, on an average of the places
      {.name = "inclinometer_on_sloping_axle", .first = 0.01, .most = 0.15,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.reading.push_back({"sloping_axle", {s, theta_within(c, j)}, sloping_axle});
       },
       .kin = {"joint_sensor_gain"}},  // less, in proportion to the tangent
      {.name = "sensor_knocked_in_passing", .first = 3e-3, .most = 0.03,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"knocked", {c.sign * s, 10.0 + 30.0 * c.share}, knocked});
       },
       .kin = {"zero_offset"}},  // from a moment on
      {.name = "sensor_learning_its_range", .first = 0.1, .most = 1.0,
       .set = [](H& h, double s, const C&, const J& j) {
         const Joint& joint = j.declared.joint;
         h.reading.push_back({"learning_range", {s, joint.theta_min, joint.theta_max}, learning_range});
       },
       .kin = {"joint_sensor_gain"}},  // once it has seen all
  };
}
// clang-format on

}  // namespace unimagined

std::vector<Fault> unimagined_faults() {
  using namespace unimagined;
  return joined({drive_faults(), tendon_faults(), joint_faults(), sensor_faults()});
}

}  // namespace fusee::rig
