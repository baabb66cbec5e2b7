// A ninth split that is kept aside: what goes wrong with tendon joints on real benches, by a tenth hand that saw
// neither how calibration infers nor what it makes of the other splits. Nothing is tuned on these; they are run once.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "fusee/transmission/transmission.h"
#include "rig/fault_shapes.h"
#include "rig/faults.h"

namespace fusee::rig {
namespace unheard {

using namespace short_names;

// ---- motor, gearbox, shaft ------------------------------------------------------------------------------------------

/// A holding brake falls in once the motor has stood for n[1] s, and its disc, which has play on its hub, is caught
/// askew: it takes the shaft round by n[0], always to the same side, until the next step lifts it. In practice 0.1 … 1
/// deg, 0.2 … 0.8 s. Current that is saved at rest yields to the load's side, and not at all without one: this does not
/// ask for the load, and needs a rest.
double falling_brake(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0};  // how long it has stood
  memory[0] = now.alpha_speed == 0 ? memory[0] + now.seconds : 0.0;
  return memory[0] > n[1] ? n[0] : 0.0;
}

/// A hobby motor comes to the end of its voltage: of what it is told beyond n[1] rad/s it leaves out the share n[0],
/// and comes after with n[1] once it is told less, while the log holds the way that was planned. In practice 0.05 … 1,
/// from 10 … 40 deg/s on behind a gear. A late sensor is as late from the slowest run on, a weak supply asks what is
/// lifted: this is right below its speed, and above it further and further behind until the motor turns round.
double slow_motor(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.alpha};
  const double most = (n[1] + (1.0 - n[0]) * std::max(0.0, std::abs(now.alpha_speed) - n[1])) * now.seconds;
  memory[0] += std::clamp(now.alpha - memory[0], -most, most);
  return memory[0] - now.alpha;
}

/// A stepper that is started without a ramp does not catch its first step where it is asked for more than n[1] rad/s at
/// once, from rest or turned round: n[0] is lost of that way, for good. In practice 0.02 … 1 deg (a full step behind
/// its gear), 15 … 45 deg/s. Steps that a load takes fall to its side, counts lost in haste are a share of the way:
/// these are as many as there were starts, to either side, and a slow start loses none.
double missed_starts(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0, 0.0};  // last speed, lost
  const bool starts = now.alpha_speed * memory[0] <= 0;
  if (starts && std::abs(now.alpha_speed) > n[1]) memory[1] += std::copysign(n[0], now.alpha_speed);
  memory[0] = now.alpha_speed;
  return -memory[1];
}

// ---- pulley ---------------------------------------------------------------------------------------------------------

/// mm: by how much tendon 1 or 2 is wound for a radian, at even steps over the declared stroke.
N arms(const J& joint, std::size_t side) {
  constexpr int steps = 32;
  const Transmission law(joint.declared);
  N all;
  for (int i = 0; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    const TransmissionPoint at = law.at_alpha(joint.alpha_min + share * (joint.alpha_max - joint.alpha_min));
    all.push_back(side == 0 ? at.t1.p : at.t2.p);
  }
  return all;
}
double mean_arm(const J& joint, std::size_t side) {
  const N all = arms(joint, side);
  return std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size());
}
/// What stands in n from n[3] on, at even steps from n[1] to n[2].
double read_off(const N& n, double x) {
  const double last = static_cast<double>(n.size()) - 4.0;
  const double place = std::clamp((x - n[1]) / (n[2] - n[1]) * last, 0.0, last - 1e-9);
  const auto before = 3 + static_cast<std::size_t>(place);
  return std::lerp(n[before], n[before + 1], place - std::floor(place));
}

/// A compound pulley of two laser-cut discs, whose dowels have play: tendon 2's disc is glued on turned by n[0] against
/// the other. Its tendon was cut to length before, and is wound by n[0] times the groove's arm more than it should be:
/// tighter or looser with the other, and the joint off by half. In practice 0.3 … 4 deg. A motor's offset turns both
/// discs and leaves the tension as it is, slack is of both tendons alike.
double askew_disc(const Moment& now, const N& n, N&) { return n[0] * read_off(n, now.alpha); }

/// A pulley of printed nylon shrinks as it cools and dries: its tendon is wound by n[0] mm for a radian and a K less,
/// or let out. In practice 0.1 … 1 % of its radius for 10 K. A pulley's scale is as wrong at the begin as in the end,
/// what expands does so at any place of the stroke: this is their product.
double shrinking_pulley(const Moment& now, const N& n, N&) { return n[0] * now.warmth * now.alpha; }

// ---- tendons, pins --------------------------------------------------------------------------------------------------

/// The bench had one cord left of the good spool, and the other tendon is of another: softer by n[0] mm/N. In practice
/// 0.2 … 3 times its stretch. Stretch is of both tendons alike, strands that break do so in use: this one is soft from
/// the begin, and the joint gives way further to one side than to the other.
template <std::size_t side>
double other_spool(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.tension[side]};  // at home
  return -n[0] * (now.tension[side] - memory[0]);
}

/// Both tendons go through one hole, one up as the other goes down, and rub on each other: as hard as the one allows
/// that pulls less, n[0] N·mm on the joint at n[1] N of it. In practice 20 … 1000 N·mm. Friction of pins grows with a
/// load, a bearing's does not ask for one: this is largest without a load, and gone where one tendon is slack.
double rubbing_pair(const Moment& now, const N& n, N&) {
  return n[0] * std::min(now.tension[0], now.tension[1]) / n[1];
}

/// An idler turns on a needle sleeve out of the wrong bag, one that is a one-way clutch: it rolls while the motor turns
/// the one way, and holds fast when that turns towards n[2], so that the tendon slides over it: n[0] N·mm on the joint
/// at n[1] N. In practice 20 … 1000 N·mm. A pin rubs on both ways; a pawl pushes, and asks for no tension; a barb
/// scrapes at its place.
template <std::size_t side>
double one_way_sleeve(const Moment& now, const N& n, N&) {
  return now.direction * n[2] > 0 ? n[0] * now.tension[side] / n[1] : 0.0;
}

// ---- joint, link, load ----------------------------------------------------------------------------------------------

/// The axle is a long screw that has cut its thread into the printed link, and its head draws tight as the link turns
/// to the one side: dry friction from nothing at home to n[0] N·mm at θ = n[1]. In practice 50 … 3000 N·mm. A bearing
/// rubs as much everywhere, a place that rubs is left behind: this gets worse to the end, on one side of home.
double screwed_axle(const Moment& now, const N& n, N&) { return n[0] * std::max(0.0, now.theta / n[1]); }

/// A spring hooked across the axis, to hold the joint open or shut: at θ = n[1] it is in line with it, and to either
/// side pushes on, to n[0] N·mm, most of that from n[2] rad on. In practice 50 … 3000 N·mm, 4 … 16 deg. A link's weight
/// is a sine over a whole turn, a hose snaps over later than it snaps back: this has its step at one place, on both
/// ways.
double dead_point(const Moment& now, const N& n, N&) {
  const double beyond = now.theta - n[1];
  return n[0] * beyond / std::hypot(beyond, n[2]);
}

/// A damper out of a drawer's runner: it drags with n[0] N·mm·s as the joint turns towards n[1], and runs free the
/// other way. In practice 50 … 5000 N·mm·s. Grease drags on both ways, a muscle from its threshold on, and what is late
/// is so under any stiffness.
double drawer_damper(const Moment& now, const N& n, N&) { return -n[0] * n[1] * std::max(0.0, n[1] * now.theta_speed); }

/// A printed flexure for a joint: its centre wanders along its own middle line as it bends, by the square of the angle,
/// n[0] mm at n[1] rad, and takes the link with it. In practice 0.05 … 1 mm. A link that is too long is so at home too,
/// a worn axis goes by the force: this is nothing at home, and the same under any load.
template <std::size_t side>
double wandering_flexure(const Moment& now, const N& n, N&) {
  const double far = now.theta / n[1];
  return nearer<side>(now, n[0] * far * far * Vec2(std::sin(0.5 * now.theta), std::cos(0.5 * now.theta)));
}

/// A link of thin plate with a rib on one side, and the sensor out on it: a load towards n[2] bends it, by n[0] at n[1]
/// N, and one to the other side presses it on its rib. In practice 0.05 … 1 deg. A tendon's stretch is there under
/// either load, and geared down: this under one of them, as much at any θ.
double ribbed_link(const Moment& now, const N& n, N&) { return -n[2] * n[0] * std::max(0.0, n[2] * now.load) / n[1]; }

/// The hook is open, and a plate falls off it as soon as the link leans beyond θ = n[1]: the share n[0] of the load is
/// gone for the rest of the run, and hung on again before the next. In practice 0.1 … 0.5. A plate that was forgotten
/// is so all run, a hook that slides comes back: this is right up to the first stroke's middle, and wrong from there.
double falling_plate(const Moment& now, const N& n, N& memory) {
  const auto run = static_cast<double>(now.run);
  if (memory.empty() || memory[0] != run) memory = {run, 0.0};
  if (now.run_time > 0 && now.load != 0 && now.theta > n[1]) memory[1] = 1.0;
  return -n[0] * memory[1] * now.load;
}

/// A bench that lies flat at first and is stood up to hang weights on: from the run n[2] on the link weighs, n[0] N·mm
/// at most, upright at θ = n[1]. In practice 50 … 3000 N·mm. Gravity is there in the first run too.
double stood_up(const Moment& now, const N& n, N&) {
  return static_cast<double>(now.run) < n[2] ? 0.0 : n[0] * std::sin(now.theta - n[1]);
}

// ---- joint's sensor, log, bench -------------------------------------------------------------------------------------

/// The joint's angle is summed up from a gyroscope, from the truth at each run's begin, and to keep it from drifting
/// n[0] rad/s is taken off every rate. In practice 0.01 … 0.5 deg/s. A gain is as wrong in haste as when slow: this is
/// the more wrong the slower the joint, and right in a fast stroke.
double rates_cut_off(const Moment& now, const N& n, N& memory) {
  const auto run = static_cast<double>(now.run);
  if (memory.empty() || memory[0] != run) memory = {run, now.time, now.theta, 0.0};  // since when, from where, lost
  const double most = n[0] * (now.time - memory[1]);
  memory = {run, now.time, now.theta, memory[3] + std::clamp(now.theta - memory[2], -most, most)};
  return -memory[3];
}

/// Motor and joint sit close together, and the rotor's magnet turns what the joint's sensor shows: a wave n[0] high for
/// each of its turns, n[1] of them to one of the shaft. In practice 0.02 … 1 deg, 5 … 25 turns. What the gear or the
/// motor's own sensor does comes through the transmission, and is small where that is flat: this is as high everywhere,
/// yet keeps to the motor.
double rotor_magnet(const Moment& now, const N& n, N&) {
  return n[0] * (std::sin(n[1] * now.alpha + n[2]) - std::sin(n[2]));
}

/// The sensor's body is screwed to the plate that carries the pins: as that bends under both tendons it turns the body,
/// by n[0] for n[1] N that they pull more, together, than at the session's begin. In practice 0.05 … 1 deg. Pins that
/// give way move the joint, to the load's side: this moves what is shown, to one side under either load.
double body_on_plate(const Moment& now, const N& n, N& memory) {
  const double both = now.tension[0] + now.tension[1];
  if (memory.empty()) memory = {both};
  return n[0] * (both - memory[0]) / n[1];
}

/// A sensor that sends its value only when it is more than n[0] off the last one it sent. In practice 0.1 … 2 deg. A
/// quantum has its steps at the same places always, play stays behind by its half: this has its steps counted from
/// where it last spoke, is right after each, and may be off at rest for ever.
double sent_when_off(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.theta};
  if (std::abs(now.theta - memory[0]) > n[0]) memory[0] = now.theta;
  return memory[0] - now.theta;
}

/// Somebody smooths the column of the log row by row: each takes 1 / (1 + n[0]) of what it is off, from the first row
/// of a run on. In practice 0.5 … 10 rows. A late sensor is so by the clock and further behind in haste: rows come by
/// the way, and this is as far behind at any speed.
double smoothed_by_row(const Moment& now, const N& n, N& memory) {
  const auto run = static_cast<double>(now.run);
  if (memory.empty() || memory[0] != run) memory = {run, now.theta};
  memory[1] += (now.theta - memory[1]) / (1.0 + n[0]);
  return memory[1] - now.theta;
}

/// The joint turns a drum with a thin wire, whose spring is weak: what is shown follows at once towards n[2], where the
/// wire is pulled out; the other way the spring leaves out the share n[0] of what is asked beyond n[1] rad/s, and comes
/// after with that. In practice 0.05 … 1, from 2 … 10 deg/s on. Lag is there on both ways and at any speed; a filter
/// against spikes knows no way and gives in: this does neither.
double drawn_wire(const Moment& now, const N& n, N& memory) {
  const double out = n[2] * now.theta;
  if (memory.empty()) memory = {now.time, out, out};
  const double since = now.time - memory[0], in = std::max(0.0, memory[1] - out);
  const double drawn = std::max(in, n[1] * since) - n[0] * std::max(0.0, in - n[1] * since);
  memory = {now.time, out, std::max(out, memory[2] - drawn)};
  return n[2] * memory[2] - now.theta;
}

/// The yoke about the joint's magnet is of plain steel and keeps some of its field: what is shown is behind by n[0] at
/// most, little after a reversal and all of it 2 n[1] rad on (domains that turn round one after another: three plays in
/// parallel). In practice 0.1 … 2 deg, over 8 … 20 deg. Play is behind by all its width at once, and stands still
/// meanwhile: this never stands, and a small stroke has a small loop.
double steel_yoke(const Moment& now, const N& n, N& memory) {
  constexpr std::size_t domains = 3;
  if (memory.empty()) memory.assign(domains, now.theta);
  double kept = 0;
  for (std::size_t i = 0; i < domains; ++i) {
    const double width = n[1] * static_cast<double>(i + 1) / domains;
    kept += (behind(now.theta, width, memory[i]) - now.theta) / width;
  }
  return n[0] * kept / domains;
}

/// A table on air springs that levels itself, and an inclinometer on the link: what hangs on one side tilts it at once,
/// by n[0] at n[1] N, and its valves bring it back with the time constant n[2] s; unloaded, it tilts the other way. In
/// practice 0.02 … 0.5 deg, 3 … 20 s. Whatever else gives to a load stays as long as that does, or grows: this goes.
double levelled_table(const Moment& now, const N& n, N& memory) {
  const auto run = static_cast<double>(now.run);
  if (memory.empty()) memory = {now.time, run, 0.0};
  const double since = now.time - memory[0], hung = memory[1] == run ? now.load : 0.0;  // nothing between runs
  memory[0] = now.time, memory[1] = run;
  return -n[0] * (now.load - followed(hung, since, n[2], memory[2])) / n[1];
}

// ---- what is wrong --------------------------------------------------------------------------------------------------

// clang-format off
std::vector<Fault> drive_faults() {
  return {
      {.name = "brake_taking_shaft_round", .first = 5e-3, .most = 0.05,
       .set = [](H& h, double s, const C& c, const J&) {
         h.shaft.push_back({"falling_brake", {c.sign * s, 0.2 + 0.6 * c.share}, falling_brake});
       }},
      {.name = "motor_slower_than_told", .first = 0.1, .most = 1.0,
       .set = [](H& h, double s, const C& c, const J&) {
         h.shaft.push_back({"slow_motor", {s, radians(10.0 + 30.0 * c.share)}, slow_motor});
       },
       .kin = {"sensor_lag"}},  // behind in haste, and comes after at rest
      {.name = "steps_missed_at_starting", .first = 5e-3, .most = 0.03,
       .set = [](H& h, double s, const C& c, const J&) {
         h.shaft.push_back({"missed_starts", {s, radians(15.0 + 30.0 * c.share)}, missed_starts});
       }},
  };
}

std::vector<Fault> pulley_faults() {
  return {
      {.name = "discs_glued_askew", .first = 0.02, .most = 0.15,
       .set = [](H& h, double s, const C& c, const J& j) {
         N numbers = {c.sign * s, j.alpha_min, j.alpha_max};
         const N table = arms(j, 1);
         numbers.insert(numbers.end(), table.begin(), table.end());
         h.longer[1].push_back({"askew_disc", numbers, askew_disc});
       },
       .kin = {"motor_offset"}},  // of one disc
      {.name = "pulley_shrinking_in_cold", .first = 0.01, .most = 0.1,  // for 10 K
       .set = [](H& h, double s, const C&, const J& j) {
         h.longer[0].push_back({"shrinking_pulley", {-0.1 * s * mean_arm(j, 0)}, shrinking_pulley});
         h.longer[1].push_back({"shrinking_pulley", {0.1 * s * mean_arm(j, 1)}, shrinking_pulley});
       },
       .kin = {"pulley_scale"}},  // more and more of it
  };
}

std::vector<Fault> tendon_faults() {
  return {
      {.name = "tendons_of_two_spools", .first = 0.5, .most = 4.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const bool second = c.sign > 0;
         const auto act = second ? other_spool<1> : other_spool<0>;
         h.longer[second ? 1 : 0].push_back({"other_spool", {s * give(j)}, act});
       },
       .kin = {"tendon_stretch"}},  // of one tendon
      {.name = "tendons_rubbing_on_each_other", .first = 300.0, .most = 6000.0,
       .set = [](H& h, double s, const C&, const J& j) {
         h.dry.push_back({"rubbing_pair", {s, pretension(j)}, rubbing_pair});
       }},
      {.name = "one_way_bearing_for_idler", .first = 300.0, .most = 6000.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const N numbers = {s, pretension(j), c.share < 0.5 ? -1.0 : 1.0};
         h.dry.push_back({"one_way_sleeve", numbers, c.sign > 0 ? one_way_sleeve<1> : one_way_sleeve<0>});
       },
       .kin = {"capstan_friction"}},  // of the same tendon, one way
  };
}

std::vector<Fault> joint_faults() {
  return {
      {.name = "axle_in_its_own_thread", .first = 500.0, .most = 12000.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.dry.push_back({"screwed_axle", {s, end_of_range(c, j)}, screwed_axle});
       },
       .kin = {"joint_friction"}},  // of the same bearing, to one side
      {.name = "spring_over_dead_point", .first = 300.0, .most = 8000.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const double soft = radians(4.0 + 12.0 * c.angle / k_two_pi);
         h.torque.push_back({"dead_point", {s, theta_within(c, j), soft}, dead_point});
       },
       .kin = {"gravity"}},  // a load that turns with the joint
      {.name = "damper_of_a_drawer", .first = 1000.0, .most = 20000.0,
       .set = [](H& h, double s, const C& c, const J&) {
         h.torque.push_back({"drawer_damper", {s, c.sign}, drawer_damper});
       }},
      {.name = "flexure_wandering", .first = 0.2, .most = 2.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const N numbers = {c.sign * s, std::max(j.declared.joint.theta_max, -j.declared.joint.theta_min)};
         h.longer[0].push_back({"wandering_flexure", numbers, wandering_flexure<0>});
         h.longer[1].push_back({"wandering_flexure", numbers, wandering_flexure<1>});
       }},
  };
}

std::vector<Fault> link_faults() {
  return {
      {.name = "link_with_one_rib", .first = 5e-3, .most = 0.05,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.reading.push_back({"ribbed_link", {s, pretension(j), c.sign}, ribbed_link});
       },
       .kin = {"tendon_stretch"}},  // in proportion to the load, if to one
      {.name = "plate_falling_off_hook", .first = 0.2, .most = 1.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.load.push_back({"falling_plate", {s, theta_within(c, j)}, falling_plate});
       }},
      {.name = "bench_stood_up_for_weights", .first = 500.0, .most = 12000.0,
       .set = [](H& h, double s, const C& c, const J&) {
         h.torque.push_back({"stood_up", {s, c.angle, c.share < 0.7 ? 1.0 : 2.0}, stood_up});
       },
       .kin = {"gravity"}},  // from a run on
  };
}

std::vector<Fault> sensor_faults() {
  return {
      {.name = "gyro_rates_cut_off", .first = 1e-3, .most = 0.02,
       .set = [](H& h, double s, const C&, const J&) { h.reading.push_back({"rates_cut_off", {s}, rates_cut_off}); },
       .kin = {"joint_sensor_gain"}},  // another one at every speed
      {.name = "rotor_magnet_at_joint_sensor", .first = 3e-3, .most = 0.03,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"rotor_magnet", {s, 5.0 + 20.0 * c.share, c.angle}, rotor_magnet});
       }},
      {.name = "sensor_on_bending_plate", .first = 0.01, .most = 0.1,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.reading.push_back({"body_on_plate", {c.sign * s, pretension(j)}, body_on_plate});
       }},
      {.name = "sent_only_when_changed", .first = 0.01, .most = 0.08,
       .set = [](H& h, double s, const C&, const J&) { h.reading.push_back({"sent_when_off", {s}, sent_when_off}); }},
      {.name = "smoothed_row_by_row", .first = 0.5, .most = 10.0,
       .set = [](H& h, double s, const C&, const J&) { h.reading.push_back({"smoothed", {s}, smoothed_by_row}); },
       .kin = {"sensor_lag"}},  // a filter, if by rows
      {.name = "wire_drawn_in_too_slowly", .first = 0.1, .most = 1.0,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"drawn_wire", {s, radians(2.0 + 8.0 * c.share), c.sign}, drawn_wire});
       }},
      {.name = "yoke_of_plain_steel", .first = 5e-3, .most = 0.04,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"steel_yoke", {s, radians(4.0 + 6.0 * c.share)}, steel_yoke});
       }},
      {.name = "table_levelling_itself", .first = 5e-3, .most = 0.04,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.reading.push_back({"levelled_table", {s, pretension(j), 3.0 + 17.0 * c.share}, levelled_table});
       }},
  };
}
// clang-format on

}  // namespace unheard

std::vector<Fault> unheard_faults() {
  using namespace unheard;
  return joined({drive_faults(), pulley_faults(), tendon_faults(), joint_faults(), link_faults(), sensor_faults()});
}

}  // namespace fusee::rig
