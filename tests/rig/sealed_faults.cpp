// A second split that is kept aside: what goes wrong with tendon joints on real benches, by a third hand that saw
// neither how calibration infers nor what it makes of the other splits. Nothing is tuned on these; they are run once.
#include <algorithm>
#include <cmath>

#include "rig/fault_shapes.h"
#include "rig/faults.h"
#include "rig/random.h"

namespace fusee::rig {
namespace sealed {

using namespace short_names;

/// How far home is from the nearer end of the range.
double nearer_end(const J& j) { return std::min(j.declared.joint.theta_max, -j.declared.joint.theta_min); }

// ---- motor, gearbox, shaft ------------------------------------------------------------------------------------------

/// A supply too weak to lift fast: what the load takes, load times speed in pretensions times rad/s, is there up to
/// n[1]; for each unit beyond the shaft is n[0] behind the command that is logged. In practice 0.5 … 5 deg at full
/// power. Lag knows no load, play and friction know no speed, stretch no direction: this needs a load, haste, and the
/// way up; what is lowered is where it should be.
double weak_supply(const Moment& now, const N& n, N&) {
  const double beyond = std::max(0.0, now.load * now.alpha_speed / n[2] - n[1]);
  return now.alpha_speed > 0 ? -n[0] * beyond : n[0] * beyond;
}

/// A stepper's driver saves current once the motor has stood for n[1] s: the load then turns it away within 0.2 s, by
/// n[0] for a load of n[2] N, and the next step brings it back. In practice 0.2 … 1.5 deg. Stretch is there in motion
/// too, creep and windup are not undone by a step: this is nothing while it moves and nothing without a load.
double idle_current(const Moment& now, const N& n, N& memory) {
  if (memory.empty() || memory[0] != now.alpha) memory = {now.alpha, 0.0};
  memory[1] += now.seconds;
  return -n[0] * now.load / n[2] * std::clamp((memory[1] - n[1]) / 0.2, 0.0, 1.0);
}

/// A driver that rounds the command to whole steps of n[0]. In practice 0.1 … 2 deg of the pulley. A saw's teeth, tens
/// of them in a stroke and the same in both directions, where a sensor's waves and a profile's are two or three a turn.
double full_steps(const Moment& now, const N& n, N&) {
  return n[0] > 0 ? n[0] * std::round(now.alpha / n[0]) - now.alpha : 0.0;
}

/// The sector of a gear that is used most is worn: play of n[0] at α = n[1] that fades over n[2] to either side. In
/// practice 0.3 … 5 deg. Backlash is as wide everywhere.
double worn_sector(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.alpha};
  return behind(now.alpha, 0.5 * n[0] * bump((now.alpha - n[1]) / n[2]), memory[0]) - now.alpha;
}

/// A pulley pressed on its shaft that holds up to n[1] N at the tip: beyond, it turns by n[0] for every n[2] N, and
/// stays there until it is loaded as hard the other way. In practice 0.5 … 5 deg. Stretch comes back, slip and offset
/// do not depend on what was hung on last: this is play in the load.
double press_fit(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0};
  return -n[0] * behind(now.load, n[1], memory[0]) / n[2];
}

// ---- groove, tendon, pins -------------------------------------------------------------------------------------------

/// A groove printed with little infill: a tendon that a load pulls into it winds further in, by n[0] mm at most and by
/// half of that under n[1] N at the tip. What is wound stays as it was wound. In practice 0.05 … 0.4 mm. A wrong radius
/// is wrong without load too; stretch does not grow with what is wound: this is their product, and saturates.
template <std::size_t side>
double soft_groove(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.alpha, 0.0};
  const double wound = (side == 1 ? 1.0 : -1.0) * (now.alpha - memory[0]);
  const double pulled = std::max(0.0, side == 1 ? now.load : -now.load) / n[1];
  memory = {now.alpha, memory[1] + wound * pulled / (1.0 + pulled)};
  return -n[0] * memory[1];
}

/// A tendon that went slack (below n[1] N) comes to lie on its groove's rim, a way longer by n[0] mm, and snaps back
/// only when it is pulled with more than n[2] N. In practice 0.1 … 1 mm. Slack has no memory, and slip does not come
/// back.
template <std::size_t side>
double off_groove(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0, now.tension[side]};
  // What it was pulled with last decides: it lies in one place while the joint settles.
  if (memory[1] < n[1]) memory[0] = 1.0;
  if (memory[1] > n[2]) memory[0] = 0.0;
  memory[1] = now.tension[side];
  return n[0] * memory[0];
}

/// Broken strands of tendon 2 are pushed into a ball where the tendon meets its pin at α = n[1], and each passage adds
/// n[0] mm to the way over it. In practice 0.01 … 0.1 mm a passage. An error of the profile does not grow, and what
/// grows with time or use (creep, slip, warmth) is no bump at one place.
double fraying(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.alpha, 0.0};
  if ((memory[0] < n[1]) != (now.alpha < n[1])) memory[1] += 1.0;
  memory[0] = now.alpha;
  return n[0] * memory[1] * bump((now.alpha - n[1]) / radians(8.0));
}

/// A wire saws into its pin of plastic, with its pull times its way (Archard 1953): n[0] mm for a radian of the motor
/// at n[1] N. In practice 0.1 … 0.5 mm in a session. Creep goes on at rest and comes back, slip is one moment, a pin's
/// place is fixed.
double sawn_pin(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.alpha, 0.0, now.tension[1]};
  memory[1] += memory[2] / n[1] * std::abs(now.alpha - memory[0]);
  memory[0] = now.alpha;
  memory[2] = now.tension[1];
  return -n[0] * memory[1];
}

/// Beyond θ = n[1] a tendon touches the edge of a cover and is pushed aside, in proportion to the way beyond: its way
/// is longer by n[0] mm for the square of a radian (h² / 2 (1/a + 1/b)). In practice 2 … 20. Whatever moves or thickens
/// a pin is felt over the whole range; this begins at a place, softly, and whatever the load.
double on_edge(const Moment& now, const N& n, N&) {
  const double beyond = std::max(0.0, n[1] > 0 ? now.theta - n[1] : n[1] - now.theta);
  return n[0] * beyond * beyond;
}

/// Brackets of printed plastic give way under the pins, late: n[0] mm for a newton more than at home, with the time
/// constant n[1] s (Kelvin and Voigt). In practice 0.3 … 3 times the tendon's own stretch, 5 … 60 s.
template <std::size_t side>
double sagging_bracket(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0, now.tension[side], now.tension[side]};  // sagged by, home, last
  memory[0] += (memory[2] - memory[1] - memory[0]) * (1.0 - std::exp(-now.seconds / n[1]));
  memory[2] = now.tension[side];
  return -n[0] * memory[0];
}

/// A frame of two materials whose bolts hold by friction: it gives way to its cooling with a crack, n[0] mm for every
/// n[1] K, the first after a share n[2] less. In practice 0.05 … 0.3 mm. Expansion goes smoothly.
double creaking_frame(const Moment& now, const N& n, N&) { return n[0] * std::floor(n[2] - now.warmth / n[1]); }

// ---- joint and link -------------------------------------------------------------------------------------------------

/// Balls have dented their race when the joint was struck, and want to lie in the dents: n[0] N·mm, n[1] dents a turn.
/// In practice 50 … 2000 N·mm, 9 … 18 balls. Friction has a loop and gravity one wave a turn; a sensor's waves are the
/// same under any load: these are as large as the tendons are soft, and larger where one of them is slack.
double dents(const Moment& now, const N& n, N&) { return n[0] * std::sin(n[1] * now.theta + n[2]); }

/// A bushing of plastic that shrinks on its axle as it cools: n[0] N·mm of dry friction for 10 K. In practice 50 … 2000
/// N·mm. Friction of a bearing does not grow.
double cold_bushing(const Moment& now, const N& n, N&) { return n[0] * std::max(0.0, -now.warmth) / 10.0; }

/// A glove of silicone over the joint: a spring of n[0] N·mm/rad in series with a dashpot, which relaxes within n[1] s
/// (Maxwell). In practice 300 … 5000 N·mm/rad, 1 … 10 s. Gravity has no memory and friction no time, a filter no load:
/// this is a spring in haste, drags when slow, and lets go at rest.
double glove(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.theta, now.theta};  // relaxed at, last
  memory[0] += (memory[1] - memory[0]) * (1.0 - std::exp(-now.seconds / n[1]));
  memory[1] = now.theta;
  return -n[0] * (now.theta - memory[0]);
}

// ---- load, operator -------------------------------------------------------------------------------------------------

/// The weight comes to rest on something soft before the end of the range to which it pulls, and within 4 deg that
/// carries the share n[0] of it: below θ = n[2] a load against +θ, above n[3] the other; n[1] mm from the axis. In
/// practice 0.05 … 1. A stop is there without a load, stretch and a cell's gain at any place: this needs both.
double landing(const Moment& now, const N& n, N&) {
  const double beyond = now.load > 0 ? n[2] - now.theta : now.theta - n[3];
  return n[0] * now.load * n[1] * std::clamp(beyond / radians(4.0), 0.0, 1.0);
}

/// The hook slides along the link as soon as that leans by more than n[1], out to one side and back to the other, and
/// stays where it is between: out there its lever is longer by the share n[0]. In practice 0.02 … 0.3. A loop that is
/// in proportion to the load and as wide as the lean, and flat outside: friction, play and stretch have none such.
double hook(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0};
  if (now.theta > n[1]) memory[0] = 1.0;
  if (now.theta < -n[1]) memory[0] = 0.0;
  return n[0] * now.load * memory[0];
}

/// Whoever starts a run steadies the weight for a while: a hand carries the share n[0] of it and lets go within n[1] s.
/// In practice 0.1 … 0.8, 1 … 5 s. Creep and warmth do not begin anew with each run, nor take part in the load alone.
double hand(const Moment& now, const N& n, N&) { return -n[0] * now.load * std::exp(-now.run_time / n[1]); }

/// The weight's cord runs over a wheel that rubs: lifting takes the share n[0] more, lowering as much less; it turns
/// round within 3 deg of the motor. In practice 0.02 … 0.3. As a pin's, but only of what the load pulls.
double rubbing_wheel(const Moment& now, const N& n, N& memory) {
  constexpr double width = radians(3.0);
  if (memory.empty()) memory = {now.alpha};
  return n[0] * std::abs(now.load) * (now.alpha - behind(now.alpha, width, memory[0])) / width;
}

// ---- joint's sensor, log --------------------------------------------------------------------------------------------

/// A bit of the joint's sensor that is always nought: every second interval of n[0] is shown too low by n[0]. In
/// practice 0.1 … 1.4 deg (the last to the fifth-last of twelve). A square wave of high order with nothing smooth about
/// it, the same under any load.
double stuck_bit(const Moment& now, const N& n, N&) {
  if (!(n[0] > 0)) return 0.0;
  const bool set = std::fmod(std::abs(std::floor(now.theta / n[0])), 2.0) == 1.0;
  return set ? -n[0] : 0.0;
}

/// Motor and potentiometer share a thin wire: the current that holds the load drags the sensor's reference with it, and
/// the reading shrinks towards its electrical zero, θ = n[1], by the share n[0] for n[2] N. In practice 0.005 … 0.05.
/// A gain is the same in every run, and what gives under a load turns round with its sign: this does not.
double sagging_reference(const Moment& now, const N& n, N&) {
  return -n[0] * std::abs(now.load) / n[2] * (now.theta - n[1]);
}

/// Hum of the mains that the logger's rate folds down to n[1] rad/s: amplitude n[0], in time. In practice 0.05 … 0.5
/// deg, 0.05 … 0.5 Hz. It knows neither place nor load nor run; no named effect is a wave of the clock.
double hum(const Moment& now, const N& n, N&) { return n[0] * std::sin(n[1] * now.time + n[2]); }

/// Brushes that spark into the sensor's wire: while the motor turns, the more the faster, some rows are off by n[0] to
/// either side, the others are right. In practice 0.2 … 5 deg, one row in ten to fifty. Neither noise as it was
/// declared nor anything of which the next row knows.
double sparks(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0};
  memory[0] += 1.0;
  Random random = numbered(memory[0], 17);
  const double speed = std::abs(now.alpha_speed);
  if (random.share() > 0.2 * speed / (1.0 + speed)) return 0.0;
  return n[0] * random.sign();
}

/// Joint and motor are logged by two clocks, set at the session's begin, and the joint's runs slow by the share n[0]:
/// its rows are from longer and longer ago. In practice 10⁻⁴ … 10⁻² (from a crystal to a cheap oscillator). A late
/// sensor is as late at the end as at the begin.
double drifting_clock(const Moment& now, const N& n, N& memory) {
  memory.push_back(now.time);
  memory.push_back(now.theta);
  const double then = now.time * (1.0 - n[0]);
  std::size_t after = memory.size() - 2;
  while (after >= 2 && memory[after - 2] > then) after -= 2;
  if (after < 2 || !(memory[after] > then)) return memory[after + 1] - now.theta;
  const double share = (then - memory[after - 2]) / (memory[after] - memory[after - 2]);
  return memory[after - 1] + share * (memory[after + 1] - memory[after - 1]) - now.theta;
}

/// The sensor's bracket cools at its skin first and bows as long as its core, n[1] s behind, is warmer: n[0] for each K
/// between them. In practice 0.02 … 0.3 deg/K, 15 … 60 s. It comes and goes again within a session in which the
/// temperature only falls; expansion and a zero's drift go with the temperature.
double bowed_bracket(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0, 0.0};  // core's warmth, time
  memory[0] += (now.warmth - memory[0]) * (1.0 - std::exp(-(now.time - memory[1]) / n[1]));
  memory[1] = now.time;
  return n[0] * (memory[0] - now.warmth);
}

// ---- what is wrong --------------------------------------------------------------------------------------------------

// clang-format off
std::vector<Fault> drive_faults() {
  return {
      {.name = "weak_supply", .first = 0.02, .most = 0.2,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.shaft.push_back({"weak_supply", {s, 0.1 + 0.2 * c.share, pretension(j)}, weak_supply});
       }},
      {.name = "idle_current", .first = 0.02, .most = 0.15,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.shaft.push_back({"idle_current", {s, 0.2 + 0.4 * c.share, pretension(j)}, idle_current});
       }},
      {.name = "full_steps", .first = 0.02, .most = 0.15,
       .set = [](H& h, double s, const C&, const J&) { h.shaft.push_back({"full_steps", {s}, full_steps}); }},
      {.name = "worn_gear_sector", .first = 0.04, .most = 0.3,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.shaft.push_back({"worn_sector", {s, alpha_within(c, j), 0.15 * (j.alpha_max - j.alpha_min)}, worn_sector});
       },
       .kin = {"backlash"}},  // play between motor and pulley, in a part of the range
      {.name = "slipping_press_fit", .first = 0.02, .most = 0.2,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.shaft.push_back({"press_fit", {s, (0.25 + 0.25 * c.share) * pretension(j), pretension(j)}, press_fit});
       }},
  };
}

std::vector<Fault> tendon_faults() {
  return {
      {.name = "soft_groove", .first = 0.1, .most = 1.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const N numbers = {s, (0.5 + 0.5 * c.share) * pretension(j)};
         h.longer[0].push_back({"soft_groove", numbers, soft_groove<0>});
         h.longer[1].push_back({"soft_groove", numbers, soft_groove<1>});
       }},
      {.name = "tendon_off_groove", .first = 0.2, .most = 2.0,
       .set = [](H& h, double s, const C&, const J& j) {
         const N numbers = {s, 0.1 * pretension(j), 1.8 * pretension(j)};
         h.longer[0].push_back({"off_groove", numbers, off_groove<0>});
         h.longer[1].push_back({"off_groove", numbers, off_groove<1>});
       },
       .kin = {"tendon_slip"}},  // a step of a tendon's length, where nothing pulls it back
      {.name = "fraying_tendon", .first = 0.03, .most = 0.4,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.longer[1].push_back({"fraying", {s, alpha_within(c, j)}, fraying});
       }},
      {.name = "sawn_pin", .first = 3e-3, .most = 0.05,
       .set = [](H& h, double s, const C&, const J& j) {
         h.longer[1].push_back({"sawn_pin", {s, pretension(j)}, sawn_pin});
       }},
      {.name = "tendon_on_edge", .first = 3.0, .most = 100.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const N numbers = {s, (0.15 + 0.3 * c.share) * end_of_range(c, j)};
         h.longer[c.angle < k_pi ? 0 : 1].push_back({"on_edge", numbers, on_edge});
       }},
      {.name = "sagging_bracket", .first = 0.5, .most = 4.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const N numbers = {s * give(j), 5.0 + 45.0 * c.share * c.share};
         h.longer[0].push_back({"sagging_bracket", numbers, sagging_bracket<0>});
         h.longer[1].push_back({"sagging_bracket", numbers, sagging_bracket<1>});
       },
       .kin = {"creep"}},  // gives way to the tension, late
      {.name = "creaking_frame", .first = 0.1, .most = 1.0,
       .set = [](H& h, double s, const C& c, const J&) {
         const double every = 2.0 + 2.0 * c.share, first = c.angle / k_two_pi;
         h.longer[0].push_back({"creaking_frame", {c.sign * s, every, first}, creaking_frame});
         h.longer[1].push_back({"creaking_frame", {-c.sign * s, every, first}, creaking_frame});
       },
       .kin = {"thermal_expansion"}},  // the same in steps
  };
}

std::vector<Fault> link_faults() {
  return {
      {.name = "dented_bearing", .first = 100.0, .most = 8000.0,
       .set = [](H& h, double s, const C& c, const J&) {
         h.torque.push_back({"dents", {s, 9.0 + 9.0 * c.share, c.angle}, dents});
       }},
      {.name = "cold_bushing", .first = 200.0, .most = 10000.0,
       .set = [](H& h, double s, const C&, const J&) { h.dry.push_back({"cold_bushing", {s}, cold_bushing}); },
       .kin = {"joint_friction"}},  // dry friction of the same bearing, once it is cold
      {.name = "relaxing_glove", .first = 500.0, .most = 50000.0,
       .set = [](H& h, double s, const C& c, const J&) {
         h.torque.push_back({"glove", {s, 1.0 + 7.0 * c.share}, glove});
       }},
      {.name = "landing_weight", .first = 0.1, .most = 1.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const Joint& joint = j.declared.joint;
         const double at = 0.2 + 0.3 * c.share;
         h.torque.push_back({"landing", {s, joint.R, at * joint.theta_min, at * joint.theta_max}, landing});
       }},
      {.name = "sliding_hook", .first = 0.1, .most = 0.5,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.load.push_back({"hook", {s, (0.1 + 0.25 * c.share) * nearer_end(j)}, hook});
       }},
      {.name = "hand_on_load", .first = 0.3, .most = 0.9,
       .set = [](H& h, double s, const C& c, const J&) { h.load.push_back({"hand", {s, 1.0 + 4.0 * c.share}, hand}); }},
      {.name = "load_over_rubbing_wheel", .first = 0.1, .most = 0.5,
       .set = [](H& h, double s, const C&, const J&) { h.load.push_back({"rubbing_wheel", {s}, rubbing_wheel}); },
       .kin = {"capstan_friction"}},  // dry friction in proportion to what pulls
  };
}

std::vector<Fault> sensor_faults() {
  return {
      {.name = "stuck_bit", .first = 0.004, .most = 0.05,
       .set = [](H& h, double s, const C&, const J&) { h.reading.push_back({"stuck_bit", {s}, stuck_bit}); }},
      {.name = "sagging_reference", .first = 0.01, .most = 0.08,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.reading.push_back({"sagging_reference", {s, end_of_range(c, j), pretension(j)}, sagging_reference});
       }},
      {.name = "aliased_hum", .first = 0.002, .most = 0.02,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"hum", {s, k_two_pi * (0.05 + 0.45 * c.share), c.angle}, hum});
       }},
      {.name = "brush_sparks", .first = 0.01, .most = 0.2,
       .set = [](H& h, double s, const C&, const J&) { h.reading.push_back({"sparks", {s}, sparks}); }},
      {.name = "drifting_clock", .first = 5e-4, .most = 0.02,
       .set = [](H& h, double s, const C&, const J&) { h.reading.push_back({"drifting_clock", {s}, drifting_clock}); },
       .kin = {"sensor_lag"}},  // shown late
      {.name = "bowed_bracket", .first = 2e-3, .most = 0.02,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"bowed_bracket", {c.sign * s, 15.0 + 45.0 * c.share}, bowed_bracket});
       }},
  };
}
// clang-format on

}  // namespace sealed

std::vector<Fault> sealed_faults() {
  using namespace sealed;
  return joined({drive_faults(), tendon_faults(), link_faults(), sensor_faults()});
}

}  // namespace fusee::rig
