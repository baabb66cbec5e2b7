// A third split that is kept aside: what goes wrong with tendon joints on real benches, by a fourth hand that saw
// neither how calibration infers nor what it makes of the other splits. Nothing is tuned on these; they are run once.
#include <algorithm>
#include <cmath>

#include "rig/fault_shapes.h"
#include "rig/faults.h"
#include "rig/random.h"

namespace fusee::rig {
namespace withheld {

using namespace short_names;

// ---- motor, gearbox, shaft ------------------------------------------------------------------------------------------

/// A belt of polyurethane between motor and pulley: it comes onto its wheels with one pull and leaves with another, and
/// loses the difference in strain. Whichever way it runs, the shaft goes back before the load, by the share n[0] of the
/// way at n[1] N (elastic creep). In practice 0.1 … 2 %. Stretch knows no way, lost counts no load: this is their
/// product, and only the other load brings it back.
double creeping_belt(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.alpha, 0.0};
  memory[1] += now.load / n[1] * std::abs(now.alpha - memory[0]);
  memory[0] = now.alpha;
  return -n[0] * memory[1];
}

/// Planets that do not share the load alike: the gear gives more where a single one carries it, n[2] times a turn, n[0]
/// for n[1] N. In practice 0.2 … 2 deg at full load. A sensor's, a gear's and a profile's waves are the same under any
/// load and stretch has none: this is nothing without a load. (What the gear gives everywhere is stretch, and left
/// out.)
double uneven_planets(const Moment& now, const N& n, N&) {
  return -n[0] * now.load / n[1] * std::sin(n[2] * now.alpha + n[3]);
}

/// An integrator that fights stiction drives the shaft to and fro about what it was told, with n[2] rad/s: n[0] at
/// rest, less in motion, little from n[1] rad/s on. In practice 0.2 … 2 deg, 0.3 … 2 Hz. It is a wave of the clock that
/// haste ends; lag and windup have one sign, and a shaft's waves stand at their places.
double hunting(const Moment& now, const N& n, N&) {
  return n[0] * bump(now.alpha_speed / n[1]) * std::sin(n[2] * now.time + n[3]);
}

/// Before each run the motor looks for home on a switch of its own, and finds it within n[0] (standard deviation; n[1]
/// numbers the switch). In practice 0.1 … 2 deg. An offset that is another in every run.
double careless_homing(const Moment& now, const N& n, N&) { return n[0] * numbered(n[1], now.run).normal(); }

// ---- groove, tendon, pins -------------------------------------------------------------------------------------------

/// A groove with glue, grease or rubber in it holds a tendon that leaves it: it comes off late, by a detour of n[0] mm
/// at n[1] N, up to twice that the less it is pulled; turned round within 3 deg. In practice 0.05 … 0.5 mm. A loop, but
/// of the side that is let out alone, and narrower under load: friction widens with it, play and slack know none.
template <std::size_t side>
double sticky_groove(const Moment& now, const N& n, N& memory) {
  constexpr double width = radians(3.0);
  if (memory.empty()) memory = {now.alpha};
  const double wound = (now.alpha - behind(now.alpha, width, memory[0])) / width;
  const double let_out = std::max(0.0, side == 1 ? -wound : wound);
  return n[0] * let_out * 2.0 / (1.0 + now.tension[side] / n[1]);
}

/// A tendon glued into its end: the glue yields like a stiff paste (Bingham), not at all below n[1] N and by n[0] mm/s
/// at twice that, and what has yielded stays. In practice 0.005 … 0.1 mm/s (hot melt on polyethylene). Creep of the
/// material has no threshold and comes back; slip is one moment.
template <std::size_t side>
double yielding_glue(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.tension[side], 0.0};
  memory[1] += std::max(0.0, memory[0] / n[1] - 1.0) * now.seconds;
  memory[0] = now.tension[side];
  return -n[0] * memory[1];
}

/// Strands of a rope break at the first pull beyond n[1] N; from then on what is left gives n[0] mm/N more. In practice
/// 0.15 … 1.5 of the rope's own stretch (one strand of seven to four). Stretch is the same in all runs: this is none
/// before the first heavy load, and stays after it, in one tendon.
template <std::size_t side>
double snapped_strands(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.tension[side], now.tension[side], 0.0};  // home, last, broken
  // The last pull decides: a rope is whole or not while the joint settles.
  if (memory[1] > n[1]) memory[2] = 1.0;
  memory[1] = now.tension[side];
  return -n[0] * memory[2] * (now.tension[side] - memory[0]);
}

/// A waxed cord that loses its wax on the pins: dry friction that grows to n[0] N·mm at n[1] N in both, most of it
/// within n[2] rad of the motor's way. In practice 20 … 1000 N·mm, 5 … 30 rad. A pin's friction does not change with
/// use.
double worn_wax(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.alpha, 0.0};
  memory[1] += std::abs(now.alpha - memory[0]);
  memory[0] = now.alpha;
  const double pull = 0.5 * (now.tension[0] + now.tension[1]) / n[1];
  return n[0] * pull * (1.0 - std::exp(-memory[1] / n[2]));
}

/// A pin that is not square to its plate: whenever friction lets go, at a reversal, the tendon slides some way down the
/// pin to where its own way is shorter, until it lies at the plate. n[0] mm in all, most of it within n[1] reversals.
/// In practice 0.05 … 1 mm. Creep and warmth know no reversals, slip is one moment, pins stand where they stand.
double walking_down(const Moment& now, const N& n, N& memory) {
  return -n[0] * (1.0 - std::exp(-reversals(now, memory) / n[1]));
}

// ---- joint and link -------------------------------------------------------------------------------------------------

/// The pawl of a joint that can be locked is not lifted off: while the motor turns towards +, it is pushed up each
/// tooth (rounded) of n[1] a turn, against up to n[0] N·mm; the other way it is held clear. In practice 20 … 500 N·mm,
/// 40 … 100 teeth. Friction holds in both directions, and no wave has one.
double trailing_pawl(const Moment& now, const N& n, N&) {
  const double up = std::sin(0.5 * n[1] * now.theta);
  return now.direction > 0 ? -n[0] * up * up : 0.0;
}

/// A hose along the joint buckles to one side or the other and pushes the link there, n[0] N·mm; it snaps over once the
/// link is n[2] beyond n[1]. In practice 30 … 1000 N·mm. Gravity has no memory and a friction that turns round does so
/// at the reversal: this does at two places of θ, and pushes on, not back.
double buckled_hose(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.theta > n[1] ? 1.0 : -1.0, now.theta};
  // Where the link was decides: a hose lies on one side while the joint settles.
  if (memory[1] > n[1] + n[2]) memory[0] = 1.0;
  if (memory[1] < n[1] - n[2]) memory[0] = -1.0;
  memory[1] = now.theta;
  return n[0] * memory[0];
}

/// A skin over the joint lies in folds about θ = n[1] and is drawn tight to either side: n[0] N·mm for the cube of a
/// radian. In practice 300 … 20000, 40 … 2500 N·mm at half a radian. A link's weight is a sine, next to straight over a
/// joint's range, and a stop has one side: this is nothing in the middle, whatever the direction and the load.
double tight_skin(const Moment& now, const N& n, N&) {
  const double drawn = now.theta - n[1];
  return -n[0] * drawn * drawn * drawn;
}

// ---- load, operator -------------------------------------------------------------------------------------------------

/// Somebody pulls by a spring balance, and wavers about what is written down: by the share n[0] (rms), three waves of
/// the clock, the slowest with n[1] rad/s. In practice 0.03 … 0.2, 0.05 … 0.5 Hz. What a named effect makes of a load
/// is the same at any time; this knows neither place nor direction nor run.
double wavering_pull(const Moment& now, const N& n, N&) {
  constexpr double golden = 1.618033988749895;  // such waves never meet again
  const double t = n[1] * now.time;
  const double waves =
      std::sin(t + n[2]) + std::sin(golden * t + 2.0 * n[2]) + std::sin(golden * golden * t + 3.0 * n[2]);
  return n[0] * now.load * std::sqrt(2.0 / 3.0) * waves;
}

/// In the run n[1] there hung n[0] N more than was written down, with their sign. In practice 0.2 … 5 N. A cell's gain
/// is wrong in all runs and in proportion; gravity too is in all of them.
double forgotten_plate(const Moment& now, const N& n, N&) { return static_cast<double>(now.run) == n[1] ? n[0] : 0.0; }

/// A winch pulls, and its control is slow: the cord is longer or shorter than it should be by what the joint has done
/// meanwhile, and pulls n[0] N more for 1 rad/s of the motor, or less, but never pushes. In practice 0.02 … 1 times the
/// pretension. Grease drags without a load too, and in both directions alike; what is late is late under any load.
double slow_winch(const Moment& now, const N& n, N&) {
  const double more = n[0] * now.alpha_speed;
  if (now.load > 0) return std::max(more, -now.load);
  return now.load < 0 ? std::min(more, -now.load) : 0.0;
}

// ---- joint's sensor, log --------------------------------------------------------------------------------------------

/// A filter that takes haste for spikes: what is shown goes by no more than n[1] rad/s, unless it is n[0] behind, which
/// the filter takes for true. In practice 0.2 … 10 deg, from 5 … 30 deg/s on. A late sensor is late in proportion to
/// the speed, from the slowest on: this shows all that is slow as it is, and what is fast as far behind at any speed.
double spike_filter(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.theta, now.time};
  const double most = n[1] * (now.time - memory[1]);
  const double followed = memory[0] + std::clamp(now.theta - memory[0], -most, most);
  memory = {std::clamp(followed, now.theta - n[0], now.theta + n[0]), now.time};
  return memory[0] - now.theta;
}

/// Rows that are stamped when a busy computer comes to it, and evened out by whoever wrote the log: each is from n[0] s
/// earlier or later (standard deviation). In practice 2 … 50 ms. A lag is the same in all rows; noise does not grow
/// with the speed and rest at the reversals.
double jittering_stamps(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0};
  memory[0] += 1.0;
  return n[0] * now.theta_speed * numbered(memory[0], 29).normal();
}

/// One entry of the table by which the sensor was made straight is wrong, at θ = n[1]: by n[0], and in a straight line
/// down to nothing at its neighbours, n[2] off. In practice 0.2 … 5 deg, 30 … 140 entries a turn. A tent at one place,
/// whatever the load and the direction, where all waves go on; the tendons know nothing of it.
double bad_entry(const Moment& now, const N& n, N&) {
  return n[0] * std::max(0.0, 1.0 - std::abs(now.theta - n[1]) / n[2]);
}

/// A spot of dirt on the scale of the joint's encoder, at θ = n[1]: the counter, whose threshold is not the same for
/// both directions, misses n[0] there on the way up and nothing on the way down. In practice 0.01 … 0.5 deg a passage.
/// A zero is off once and for all; what grows with time grows at every place, and counts no passages.
double dirty_scale(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.theta, 0.0};
  if (memory[0] < n[1] && now.theta >= n[1]) memory[1] += 1.0;
  memory[0] = now.theta;
  return -n[0] * memory[1];
}

/// The joint's angle is summed up from a gyroscope that was set to the truth before the run, and is off by n[0] rad/s
/// ever after. In practice 0.003 … 0.2 deg/s. Creep and warmth go on from run to run and slow down: this is straight,
/// and begins anew with each run.
double drifting_gyro(const Moment& now, const N& n, N&) { return n[0] * now.run_time; }

// ---- what is wrong --------------------------------------------------------------------------------------------------

// clang-format off
std::vector<Fault> drive_faults() {
  return {
      {.name = "creeping_belt", .first = 1e-3, .most = 0.02,
       .set = [](H& h, double s, const C&, const J& j) {
         h.shaft.push_back({"creeping_belt", {s, pretension(j)}, creeping_belt});
       }},
      {.name = "uneven_planets", .first = 0.01, .most = 0.06,
       .set = [](H& h, double s, const C& c, const J& j) {
         const double planets = 3.0 + std::floor(3.0 * c.share);
         h.shaft.push_back({"uneven_planets", {s, pretension(j), planets, c.angle}, uneven_planets});
       }},
      {.name = "hunting_integrator", .first = 0.01, .most = 0.06,
       .set = [](H& h, double s, const C& c, const J&) {
         const double fades = radians(15.0 + 15.0 * c.share), frequency = k_two_pi * (0.3 + 1.7 * c.share);
         h.shaft.push_back({"hunting", {s, fades, frequency, c.angle}, hunting});
       }},
      {.name = "careless_homing", .first = 0.01, .most = 0.06,
       .set = [](H& h, double s, const C& c, const J&) {
         h.shaft.push_back({"careless_homing", {s, std::floor(1e6 * c.share)}, careless_homing});
       },
       .kin = {"motor_offset"}},  // another one in every run
  };
}

std::vector<Fault> tendon_faults() {
  return {
      {.name = "sticky_groove", .first = 0.1, .most = 1.0,
       .set = [](H& h, double s, const C&, const J& j) {
         const N numbers = {s, pretension(j)};
         h.longer[0].push_back({"sticky_groove", numbers, sticky_groove<0>});
         h.longer[1].push_back({"sticky_groove", numbers, sticky_groove<1>});
       }},
      {.name = "yielding_glue", .first = 0.02, .most = 0.2,
       .set = [](H& h, double s, const C& c, const J& j) {
         const N numbers = {s, (1.2 + 0.2 * c.share) * pretension(j)};
         const bool second = c.sign > 0;
         h.longer[second ? 1 : 0].push_back({"yielding_glue", numbers, second ? yielding_glue<1> : yielding_glue<0>});
       },
       .kin = {"creep"}},  // lengthens slowly under what pulls
      {.name = "snapped_strands", .first = 0.5, .most = 2.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const N numbers = {s * give(j), (1.3 + 0.4 * c.share) * pretension(j)};
         const bool second = c.sign > 0;
         h.longer[second ? 1 : 0].push_back({"snapped_strands", numbers, second ? snapped_strands<1> : snapped_strands<0>});
       },
       .kin = {"tendon_stretch"}},  // a rope that is softer than declared, from the first heavy load on
      {.name = "worn_wax", .first = 100.0, .most = 4000.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.dry.push_back({"worn_wax", {s, pretension(j), 5.0 + 25.0 * c.share}, worn_wax});
       },
       .kin = {"capstan_friction"}},  // of the same pins, once the wax is gone
      {.name = "tendon_walking_down_pin", .first = 0.1, .most = 1.5,
       .set = [](H& h, double s, const C& c, const J&) {
         h.longer[c.sign > 0 ? 1 : 0].push_back({"walking_down", {s, 4.0 + 6.0 * c.share}, walking_down});
       }},
  };
}

std::vector<Fault> link_faults() {
  return {
      {.name = "trailing_pawl", .first = 100.0, .most = 4000.0,
       .set = [](H& h, double s, const C& c, const J&) {
         h.torque.push_back({"trailing_pawl", {s, 40.0 + std::floor(60.0 * c.share)}, trailing_pawl});
       },
       .kin = {"joint_friction"}},  // drag on the joint, one way
      {.name = "buckled_hose", .first = 100.0, .most = 5000.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const double middle = 0.3 * (c.share - 0.5) * (j.declared.joint.theta_max - j.declared.joint.theta_min);
         h.torque.push_back({"buckled_hose", {s, middle, radians(2.0 + 4.0 * c.angle / k_two_pi)}, buckled_hose});
       }},
      {.name = "tight_skin", .first = 3000.0, .most = 1e5,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.torque.push_back({"tight_skin", {s, 0.3 * c.share * end_of_range(c, j)}, tight_skin});
       }},
      {.name = "wavering_pull", .first = 0.1, .most = 0.4,
       .set = [](H& h, double s, const C& c, const J&) {
         h.load.push_back({"wavering_pull", {s, k_two_pi * (0.05 + 0.25 * c.share), c.angle}, wavering_pull});
       }},
      {.name = "forgotten_plate", .first = 0.1, .most = 1.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.load.push_back({"forgotten_plate", {c.sign * s * pretension(j), c.share < 0.3 ? 0.0 : 1.0}, forgotten_plate});
       }},
      {.name = "slow_winch", .first = 0.2, .most = 1.0,
       .set = [](H& h, double s, const C&, const J& j) {
         h.load.push_back({"slow_winch", {s * pretension(j)}, slow_winch});
       },
       .kin = {"sensor_lag"}},  // drag behind stretch, as grease is; under load
  };
}

std::vector<Fault> sensor_faults() {
  return {
      {.name = "spike_filter", .first = 0.02, .most = 0.2,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"spike_filter", {s, radians(5.0 + 7.0 * c.share)}, spike_filter});
       },
       .kin = {"sensor_lag"}},  // shown late, in haste
      {.name = "jittering_stamps", .first = 0.01, .most = 0.1,
       .set = [](H& h, double s, const C&, const J&) {
         h.reading.push_back({"jittering_stamps", {s}, jittering_stamps});
       }},
      {.name = "bad_table_entry", .first = 0.01, .most = 0.1,
       .set = [](H& h, double s, const C& c, const J& j) {
         const double apart = radians(2.5 + 9.5 * c.angle / k_two_pi);
         h.reading.push_back({"bad_entry", {c.sign * s, theta_within(c, j), apart}, bad_entry});
       }},
      // Above home: what comes from home to where a run begins does not pass it.
      {.name = "dirty_scale", .first = 1e-3, .most = 0.02,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.reading.push_back({"dirty_scale", {s, (0.1 + 0.4 * c.share) * j.declared.joint.theta_max}, dirty_scale});
       }},
      {.name = "drifting_gyro", .first = 2e-4, .most = 5e-3,
       .set = [](H& h, double s, const C& c, const J&) { h.reading.push_back({"drifting_gyro", {c.sign * s}, drifting_gyro}); }},
  };
}
// clang-format on

}  // namespace withheld

std::vector<Fault> withheld_faults() {
  using namespace withheld;
  return joined({drive_faults(), tendon_faults(), link_faults(), sensor_faults()});
}

}  // namespace fusee::rig
