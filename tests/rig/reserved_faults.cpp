// A fourth split that is kept aside: what goes wrong with tendon joints on real benches, by a fifth hand that saw
// neither how calibration infers nor what it makes of the other splits. Nothing is tuned on these; they are run once.
#include <algorithm>
#include <array>
#include <cmath>

#include "rig/fault_shapes.h"
#include "rig/faults.h"
#include "rig/random.h"

namespace fusee::rig {
namespace reserved {

using namespace short_names;

// ---- motor, gearbox, shaft ------------------------------------------------------------------------------------------

/// A driver that makes up for the play of a gear that was changed since: after every reversal it adds to the command
/// half of n[0] the new way, fed in over n[1] rad, and the log holds what it was told. In practice 0.2 … 3 deg, 0.3 …
/// 2 deg. Play, friction and a late sensor are behind whichever way the joint goes: this is ahead.
double overdone_compensation(const Moment& now, const N& n, N& memory) {
  const double half = 0.5 * n[1];
  if (memory.empty()) memory = {now.alpha};
  return 0.5 * n[0] * (now.alpha - behind(now.alpha, half, memory[0])) / half;
}

/// A worm that locks itself has to be driven down by its load: it sticks until the motor is ahead by n[0] for a load of
/// n[1] N, in proportion, then falls after it, and so on. Lifting, and without a load, it is where it should be. In
/// practice 0.2 … 3 deg at full load. Play is as wide under any load and as soon there one way as the other; what gives
/// under a load does so on both ways, and no wave has a way.
double stuttering_worm(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.alpha, 0.0};
  const double ahead = memory[1] + std::abs(now.alpha - memory[0]);
  memory = {now.alpha, 0.0};
  const double sticks = n[0] * std::abs(now.load) / n[1];
  if (!(now.load * now.direction < 0) || !(sticks > 0)) return 0.0;
  memory[1] = std::fmod(ahead, sticks);
  return -now.direction * memory[1];
}

/// A stepper falls out of step where load and haste ask too much of it, beyond n[1] (load times speed, in n[2] N times
/// rad/s, while it lifts): it is caught again four full steps later, n[0], each time, and the log holds what it was
/// told. In practice 0.3 … 7 deg, by the gear. An offset is there from the begin and one; slip is one moment and knows
/// no haste: this is as many as there were hard strokes, and to the load's side.
double lost_steps(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0, 0.0};  // lost, out of step
  const double asked = now.load / n[2] * now.alpha_speed;
  if (asked < 0.5 * n[1]) memory[1] = 0.0;
  if (asked > n[1] && memory[1] == 0.0) memory = {memory[0] + (now.load > 0 ? n[0] : -n[0]), 1.0};
  return -memory[0];
}

/// The bushing of the pulley's shaft is worn: the shaft lies n[0] mm off its middle, where both tendons together pull
/// it, between the directions to tendon 1's pin (n[1] from upright) and tendon 2's (n[2]). In practice 0.05 … 0.5 mm.
/// Runout turns with the pulley, a frame gives in proportion to the force: this goes by the force's direction alone,
/// and has all its way where one tendon is slack.
template <std::size_t side>
double worn_bushing(const Moment& now, const N& n, N& memory) {
  const std::array<Vec2, 2> up = up_to_pins(n[1], n[2]);
  const Vec2 force = now.tension[0] * up[0] + now.tension[1] * up[1];
  if (force.norm() < 1e-9) return 0.0;
  const Vec2 push = force.normalized();
  if (memory.empty()) memory = {push.x(), push.y()};
  return -n[0] * (push - Vec2(memory[0], memory[1])).dot(up[side]);
}

// ---- groove, tendon, pins -------------------------------------------------------------------------------------------

/// A wire under tension cuts into the floor of a printed groove: the radius of what is wound shrinks with pull times
/// way, by n[0] mm for a radian of the motor at n[1] N, and the more is wound (from α = n[2] on) the more length that
/// sets free. In practice 0.05 … 0.3 mm in a session. A radius is as wrong in the first stroke as in the last; creep
/// and slip do not grow with what is wound.
template <std::size_t side>
double cut_groove(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.alpha, 0.0, now.tension[side]};
  memory[1] += memory[2] / n[1] * std::abs(now.alpha - memory[0]);
  memory[0] = now.alpha;
  memory[2] = now.tension[side];
  return -n[0] * memory[1] * std::abs(now.alpha - n[2]);
}

/// A chip of the print lies in tendon 2's groove at α = n[1] and lifts it by a detour of n[0] mm, until it falls out as
/// the tendon is unwound from it for the n[2]th time. In practice 0.1 … 1 mm. An error of the profile stays; what comes
/// or goes with time or use (slip, creep, warmth) does so everywhere and not at one place.
double chip(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.alpha, 0.0};
  if (memory[0] > n[1] && now.alpha <= n[1]) memory[1] += 1.0;
  memory[0] = now.alpha;
  return memory[1] < n[2] ? n[0] * bump((now.alpha - n[1]) / radians(6.0)) : 0.0;
}

/// Nothing guides tendon 2 on its drum: wound in beyond α = n[1] its last turn hops up on the one before, a way longer
/// by n[0] mm, and it falls off only when it is n[2] back. In practice 0.1 … 1 mm, 5 … 30 deg. One step in two places
/// by where it comes from: profiles and waves know no direction, play and friction turn round at every reversal.
double hopping_turn(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0};
  if (now.alpha > n[1]) memory[0] = 1.0;
  if (now.alpha < n[1] - n[2]) memory[0] = 0.0;
  return n[0] * memory[0];
}

/// A tensioner with a ratchet, as on a brake's cable: when its tendon goes slack (below n[1] N) its spring takes in a
/// tooth of n[0] mm, the next one only after it was pulled again (beyond twice that), eight at most. In practice 0.05 …
/// 0.5 mm a tooth. Slip is one moment and lets go, creep lengthens what is pulled: this shortens what hung loose, for
/// good.
template <std::size_t side>
double ratchet(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.tension[side], 1.0, 0.0};  // last, pulled since, teeth
  // The last pull decides: a tooth is in or not while the joint settles.
  if (memory[0] > 2.0 * n[1]) memory[1] = 1.0;
  if (memory[0] < n[1] && memory[1] > 0) {
    memory[1] = 0.0;
    memory[2] = std::min(8.0, memory[2] + 1.0);
  }
  memory[0] = now.tension[side];
  return n[0] * memory[2];
}

/// Grit in one place of a sleeve that turns on its pin: once in each of its turns (n[2] of its radians to one of the
/// joint) it rubs, up to n[0] N·mm at n[1] N in the tendon, and hardly in between. In practice 20 … 1000 N·mm, two to
/// six turns in a stroke. A pin rubs the same everywhere; a wave of a sensor or a profile has no loop.
template <std::size_t side>
double gritty_sleeve(const Moment& now, const N& n, N&) {
  const double near = 0.5 + 0.5 * std::cos(n[2] * now.theta + n[3]);
  return n[0] * now.tension[side] / n[1] * near * near;
}

/// Somebody leans on the bench while he watches: in the run n[1], from its n[2]th second for n[3] s, the frame bends
/// and one tendon's way is longer by n[0] mm, the other's shorter; on and off within half a second. In practice 0.05 …
/// 0.5 mm. It comes, stays, and goes again at no place, load, temperature or reversal.
double leaning(const Moment& now, const N& n, N&) {
  if (static_cast<double>(now.run) != n[1]) return 0.0;
  const auto since = [&](double second) { return std::clamp((now.run_time - second) / 0.5, 0.0, 1.0); };
  return n[0] * (since(n[2]) - since(n[2] + n[3]));
}

// ---- joint and link -------------------------------------------------------------------------------------------------

/// A screw of steel beside the sensor's magnet, or a catch of a cupboard left on: it draws the link towards θ = n[1],
/// most n[2] off, with n[0] N·mm, and lets it go beyond. In practice 20 … 2000 N·mm, 1.5 … 6 deg. Gravity is one wave a
/// turn and friction has a loop: this pushes on before its place and back behind it, the same on both ways, the more
/// the softer the tendons.
double magnet(const Moment& now, const N& n, N&) {
  const double off = (now.theta - n[1]) / n[2];
  return -n[0] * off * std::exp(0.5 * (1.0 - off * off));
}

/// A rubber seal sticks to its shaft the longer it stands still: dry friction that grows to n[0] N·mm with the time
/// constant n[1] s, and is torn off within n[2] rad of the joint's way (a law of Ruina's kind). In practice 50 … 2000
/// N·mm, 2 … 60 s, 1 … 5 deg. A bearing's friction is the same in all of a stroke: this begins one and is over.
double setting_seal(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.theta, 0.0};
  const double set = memory[1] * std::exp(-std::abs(now.theta - memory[0]) / n[2]);
  memory = {now.theta, set + (1.0 - set) * (1.0 - std::exp(-now.seconds / n[1]))};
  return n[0] * memory[1];
}

// ---- load -----------------------------------------------------------------------------------------------------------

/// The weight hangs on rubber or a coil spring, and bounces after every change of speed: n[1] rad/s, dying away within
/// n[2] s. n[0] s²: way of the hook for a radian of the motor, by gravity; 1 rad/s up at once adds the share n[0] n[1]
/// of the load, and it never pushes. In practice 0.001 … 0.01 s², 1 … 3 Hz, 1 … 7 s. Lag goes with the speed and
/// has one sign, and neither it nor friction needs a load: this swings about it.
double bouncing_weight(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0, 0.0, now.alpha_speed};
  const double t = now.seconds, damping = 1.0 / n[2];
  const double a = memory[0], b = (memory[1] + damping * a) / n[1];  // x = e^(−t/τ) (a cos ωt + b sin ωt)
  const double c = std::cos(n[1] * t), s = std::sin(n[1] * t), left = std::exp(-damping * t);
  const double x = left * (a * c + b * s);
  const double up = now.load > 0 ? 1.0 : now.load < 0 ? -1.0 : 0.0;  // the motor's way on which it is lifted
  const double kick = n[0] * n[1] * n[1] * up * (now.alpha_speed - memory[2]);
  memory = {x, left * n[1] * (b * c - a * s) - damping * x + kick, now.alpha_speed};
  return now.load * std::max(-1.0, x);
}

/// A winch that is never unhooked pulls until its cell shows what it was told, and the cell's zero goes with its
/// temperature: it pulls n[0] N more for each K. In practice 0.02 … 0.5 N/K. A wrong cell is wrong in proportion,
/// gravity is the same from the begin, and what expands does not push the harder the softer the tendons are.
double cell_zero(const Moment& now, const N& n, N&) { return n[0] * now.warmth; }

// ---- joint's sensor, log --------------------------------------------------------------------------------------------

/// A potentiometer read by something that loads it: the wiper, at the share x of n[2] rad of track (n[1] at home),
/// shows x / (1 + n[0] x (1 − x)), n[0] the track's resistance by the reader's. In practice 0.02 … 0.5. A gain is
/// straight: this bends, and no wave goes on so. Home is set to nought.
double loaded_potentiometer(const Moment& now, const N& n, N&) {
  const auto off = [&](double x) { return n[2] * (x / (1.0 + n[0] * x * (1.0 - x)) - x); };
  return off(n[1] + now.theta / n[2]) - off(n[1]);
}

/// An amplifier comes near its supply before the end of the range: beyond θ = n[1] what is shown grows less, by the
/// share n[0]. In practice 0.2 … 1 (all that the supply leaves). A gain and its waves are felt over the whole range;
/// this begins at a place, at once, and neither load nor direction moves it.
double near_its_rail(const Moment& now, const N& n, N&) {
  return -n[0] * (n[1] > 0 ? std::max(0.0, now.theta - n[1]) : std::min(0.0, now.theta - n[1]));
}

/// The joint's angle is an accelerometer's, out on the link: it takes what speeds up for a slope. n[0] s²: its distance
/// from the axis by gravity; what is off passes through the sensor's own damping, n[1] s. In practice 0.003 …
/// 0.03 s² (30 … 300 mm), 0.1 … 0.5 s. Lag goes with the speed, and stays as long: this goes with its change, and
/// passes.
double swayed_inclinometer(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.time, now.theta_speed, 0.0};
  const double t = now.time - memory[0];
  if (t > 0) {
    const double left = std::exp(-t / n[1]);
    memory[2] = memory[2] * left + (now.theta_speed - memory[1]) / t * (1.0 - left);
  }
  memory[0] = now.time, memory[1] = now.theta_speed;
  return -n[0] * memory[2];
}

/// A sensor that balances itself (a strip of stretched rubber, a capacitive one): it takes what stays for its own
/// drift, and what is shown goes back to nought by the share n[0] a second, from the run's begin on. In practice 0.001
/// … 0.03. A late sensor comes too late and in the end: this is ahead at the reversals and wanders off at rest.
/// Creep knows no place, warmth no run.
double leaking_sensor(const Moment& now, const N& n, N& memory) {
  const auto run = static_cast<double>(now.run);
  if (memory.empty() || memory[0] != run) memory = {run, now.run_time, now.theta, 0.0};
  const double stood = 0.5 * (memory[2] + now.theta);
  const double off = (memory[3] + stood) * std::exp(-n[0] * (now.run_time - memory[1])) - stood;
  memory = {run, now.run_time, now.theta, off};
  return off;
}

/// A potentiometer's track that is rough about θ = n[1], where it was most in use: the wiper jumps on it, n[0] (rms at
/// its middle, n[2] wide), another way in each row. In practice 0.2 … 5 deg, 2 … 6 deg. Noise as it was declared is the
/// same everywhere; a wave, and a profile, are the same at every passage.
double crackling_track(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0};
  memory[0] += 1.0;
  return n[0] * bump((now.theta - n[1]) / n[2]) * numbered(memory[0], 41).normal();
}

/// A bus that hangs: every n[1] s (the first at n[2]), for n[0] s, the log repeats the joint's last angle. In practice
/// 0.1 … 2 s, every 4 … 20 s. A late sensor is as late in every row: this is right but for these, later and later in
/// them, and right again at once.
double hanging_bus(const Moment& now, const N& n, N& memory) {
  const auto run = static_cast<double>(now.run);
  const bool hangs = now.time >= n[2] && std::fmod(now.time - n[2], n[1]) < n[0];
  if (memory.empty() || memory[0] != run || !hangs) memory = {run, now.theta};
  return memory[1] - now.theta;
}

// ---- what is wrong --------------------------------------------------------------------------------------------------

// clang-format off
std::vector<Fault> drive_faults() {
  return {
      {.name = "overdone_compensation", .first = 0.02, .most = 0.1,
       .set = [](H& h, double s, const C& c, const J&) {
         h.shaft.push_back({"overdone_compensation", {s, radians(0.3 + 1.7 * c.share)}, overdone_compensation});
       }},
      {.name = "stuttering_worm", .first = 0.02, .most = 0.1,
       .set = [](H& h, double s, const C&, const J& j) {
         h.shaft.push_back({"stuttering_worm", {s, pretension(j)}, stuttering_worm});
       },
       .kin = {"backlash"}},  // lost motion between motor and pulley, on one way
      {.name = "lost_steps", .first = 0.01, .most = 0.12,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.shaft.push_back({"lost_steps", {s, 0.1 + 0.2 * c.share, pretension(j)}, lost_steps});
       },
       .kin = {"motor_offset"}},  // what the motor's sensor is off by ever after
      {.name = "worn_shaft_bushing", .first = 0.1, .most = 0.6,
       .set = [](H& h, double s, const C&, const J& j) {
         const auto [first, second] = ways_to_pins(j);
         const N numbers = {s, first, second};
         h.longer[0].push_back({"worn_bushing", numbers, worn_bushing<0>});
         h.longer[1].push_back({"worn_bushing", numbers, worn_bushing<1>});
       },
       .kin = {"frame_compliance"}},  // a part of the frame that the tendons move, if not in proportion
  };
}

std::vector<Fault> tendon_faults() {
  return {
      {.name = "groove_cut_by_wire", .first = 2e-3, .most = 0.03,
       .set = [](H& h, double s, const C&, const J& j) {
         h.longer[0].push_back({"cut_groove", {s, pretension(j), j.alpha_max}, cut_groove<0>});
         h.longer[1].push_back({"cut_groove", {s, pretension(j), j.alpha_min}, cut_groove<1>});
       },
       .kin = {"radius_offset"}},  // less and less of one
      {.name = "chip_that_falls_out", .first = 0.1, .most = 1.5,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.longer[1].push_back({"chip", {s, alpha_within(c, j), 2.0 + std::floor(4.0 * c.angle / k_two_pi)}, chip});
       }},
      {.name = "turn_hopping_up", .first = 0.1, .most = 2.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const double falls = radians(5.0 + 25.0 * c.angle / k_two_pi);
         h.longer[1].push_back({"hopping_turn", {s, (0.15 + 0.5 * c.share) * j.alpha_max, falls}, hopping_turn});
       }},
      {.name = "ratcheting_tensioner", .first = 0.05, .most = 1.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const N numbers = {s, (0.1 + 0.2 * c.share) * pretension(j)};
         const bool first = c.sign > 0;  // that a load lets hang
         h.longer[first ? 0 : 1].push_back({"ratchet", numbers, first ? ratchet<0> : ratchet<1>});
       },
       .kin = {"tendon_slip"}},  // a tendon of another length from a moment on
      {.name = "gritty_sleeve", .first = 100.0, .most = 4000.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const N numbers = {s, pretension(j), 12.0 + 24.0 * c.share, c.angle};
         const bool second = c.sign > 0;
         h.dry.push_back({"gritty_sleeve", numbers, second ? gritty_sleeve<1> : gritty_sleeve<0>});
       },
       .kin = {"capstan_friction"}},  // of the same pin, on an average
      {.name = "leaning_on_bench", .first = 0.1, .most = 1.0,
       .set = [](H& h, double s, const C& c, const J&) {
         const double run = c.share < 0.7 ? 0.0 : 1.0, from = 3.0 + 2.0 * c.angle, lasts = 4.0 + 10.0 * c.share;
         h.longer[0].push_back({"leaning", {c.sign * s, run, from, lasts}, leaning});
         h.longer[1].push_back({"leaning", {-c.sign * s, run, from, lasts}, leaning});
       }},
  };
}

std::vector<Fault> link_faults() {
  return {
      {.name = "magnetic_catch", .first = 100.0, .most = 3000.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const double most_at = radians(1.5 + 4.5 * c.angle / k_two_pi);
         h.torque.push_back({"magnet", {s, theta_within(c, j), most_at}, magnet});
       }},
      {.name = "seal_that_sets", .first = 2000.0, .most = 4000.0,
       .set = [](H& h, double s, const C& c, const J&) {
         const double sets = 2.0 + 58.0 * std::pow(c.share, 3), torn = radians(1.0 + 4.0 * c.angle / k_two_pi);
         h.dry.push_back({"setting_seal", {s, sets, torn}, setting_seal});
       },
       .kin = {"joint_friction"}},  // of the same joint, after a rest
      {.name = "bouncing_weight", .first = 5e-3, .most = 0.015,
       .set = [](H& h, double s, const C& c, const J&) {
         h.load.push_back({"bouncing_weight", {s, k_two_pi * (1.0 + 2.0 * c.share), 1.0 + c.angle}, bouncing_weight});
       }},
      {.name = "drifting_cell_zero", .first = 0.05, .most = 0.6,
       .set = [](H& h, double s, const C& c, const J&) { h.load.push_back({"cell_zero", {c.sign * s}, cell_zero}); },
       .kin = {"gravity"}},  // a pull that nobody wrote down, nearly the same once it has cooled
  };
}

std::vector<Fault> sensor_faults() {
  return {
      {.name = "loaded_potentiometer", .first = 0.05, .most = 0.5,
       .set = [](H& h, double s, const C& c, const J&) {
         const double track = radians(c.sign > 0 ? 270.0 : 340.0);
         h.reading.push_back({"loaded_potentiometer", {s, 0.3 + 0.4 * c.share, track}, loaded_potentiometer});
       },
       .kin = {"joint_sensor_gain"}},  // its slope
      {.name = "amplifier_near_its_rail", .first = 0.1, .most = 1.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.reading.push_back({"near_its_rail", {s, (0.4 + 0.35 * c.share) * end_of_range(c, j)}, near_its_rail});
       }},
      {.name = "swayed_inclinometer", .first = 3e-3, .most = 0.04,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"swayed_inclinometer", {s, 0.1 + 0.4 * c.share}, swayed_inclinometer});
       }},
      {.name = "leaking_sensor", .first = 1e-3, .most = 0.05,
       .set = [](H& h, double s, const C&, const J&) { h.reading.push_back({"leaking_sensor", {s}, leaking_sensor}); }},
      {.name = "crackling_track", .first = 0.01, .most = 0.1,
       .set = [](H& h, double s, const C& c, const J& j) {
         const double wide = radians(2.0 + 4.0 * c.angle / k_two_pi);
         h.reading.push_back({"crackling_track", {s, theta_within(c, j), wide}, crackling_track});
       }},
      {.name = "hanging_bus", .first = 0.3, .most = 2.0,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"hanging_bus", {s, 4.0 + 16.0 * c.share * c.share, 2.0 + c.angle / 3.0}, hanging_bus});
       },
       .kin = {"sensor_lag"}},  // shown late, now and then
  };
}
// clang-format on

}  // namespace reserved

std::vector<Fault> reserved_faults() {
  using namespace reserved;
  return joined({drive_faults(), tendon_faults(), link_faults(), sensor_faults()});
}

}  // namespace fusee::rig
