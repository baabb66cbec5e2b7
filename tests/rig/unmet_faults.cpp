// An eighth split that is kept aside: what goes wrong with tendon joints on real benches, by a ninth hand that saw
// neither how calibration infers nor what it makes of the other splits. They were run once, and
// tuned on since.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "rig/fault_shapes.h"
#include "rig/faults.h"
#include "rig/random.h"

namespace fusee::rig {
namespace unmet {

using namespace short_names;

// ---- motor, gearbox, shaft ------------------------------------------------------------------------------------------

/// A slow bus brings the motor a new command every n[0] s, and it stands there until the next, while the log holds the
/// way that was planned. In practice 20 … 300 ms. A late sensor is as late in every row: this is right on the beat and
/// later and later after it, and rests at once where the plan does.
double on_the_beat(const Moment& now, const N& n, N& memory) {
  if (!(n[0] > 0)) return 0.0;
  if (memory.empty()) memory = {0.0, now.alpha};  // a clock of its own, what was told last
  const double last = std::floor(memory[0] / n[0]);
  memory[0] += now.seconds;
  const double beat = std::floor(memory[0] / n[0]);
  if (beat > last) memory[1] = now.alpha - now.alpha_speed * (memory[0] - beat * n[0]);
  return memory[1] - now.alpha;
}

/// A key too soft for its keyway: every reversal is a blow that beats it wider, play of n[0] for each. In practice
/// 0.005 … 0.3 deg a blow. Backlash is as wide in the first stroke as in the last; gears that shrink apart go by the
/// temperature, and stand still with it.
double beaten_out(const Moment& now, const N& n, N& memory) {
  const double blows = reversals(now, memory);
  if (memory.size() == 2) memory.push_back(now.alpha);
  return behind(now.alpha, 0.5 * n[0] * blows, memory[2]) - now.alpha;
}

/// A limit that somebody once wrote into the controller, n[0] from home towards n[1]: the motor goes no further, and
/// the log holds what it was told. In practice the last 5 … 40 % of a side. A stop gives way and is the link's, a rail
/// the sensor's: here the shaft stands, whatever the load, and turns round late.
double soft_limit(const Moment& now, const N& n, N&) { return -n[1] * std::max(0.0, n[1] * now.alpha - n[0]); }

/// A stepper's driver is told the direction too late: when it turns round from + to −, a step still goes the old way.
/// The shaft is further up by n[0] with each such turning. In practice 0.01 … 0.5 deg. Counts lost in haste know
/// nothing of reversals, steps lost under a load fall to its side: this goes up by the turnings alone.
double late_direction(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.direction, 0.0};
  if (memory[0] > 0 && now.direction < 0) memory[1] += 1.0;
  memory[0] = now.direction;
  return n[0] * memory[1];
}

/// The gear's ratio is not what its label says (planets of "50" are 50.9): the shaft turns by the share n[0] more, or
/// less. In practice 0.2 … 4 %. A pulley that is too large winds more of the same tendon at the same place of its
/// groove: this is further round, on a groove that is not a circle.
double misquoted_ratio(const Moment& now, const N& n, N&) { return n[0] * now.alpha; }

// ---- tendon, pins, frame --------------------------------------------------------------------------------------------

/// A round cord rolls on the flank of a groove too wide for it, until its twist, n[1] rad of the motor to either side,
/// makes it slide. Twisted, one way or the other, it is shorter: its way is longer by n[0] mm. In practice 0.02 … 0.3
/// mm ((2 π r turns)² / 2 L). Play and friction are to one side on one way and to the other on the way back: this has
/// one sign on both, and is gone for a while after each reversal, where the twist goes through nought.
double rolling_cord(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.alpha};
  const double twist = (now.alpha - behind(now.alpha, n[1], memory[0])) / n[1];
  return n[0] * twist * twist;
}

/// A braid sticks to its pin and jumps, as rosin does to a bow: dry friction that grows to n[0] N·mm at n[1] N over
/// every n[2] rad of the motor's way, and falls to nothing. In practice 20 … 1000 N·mm, 3 … 12 deg. A pin rubs as much
/// all the way; a gritty sleeve does so at its places, this anywhere.
template <std::size_t side>
double chatter(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.alpha, 0.0};
  memory = {now.alpha, std::fmod(memory[1] + std::abs(now.alpha - memory[0]), n[2])};
  return n[0] * now.tension[side] / n[1] * memory[1] / n[2];
}

/// The pin is a bare screw, and the tendon, which comes to it askew, lies between two of its threads. At every reversal
/// it may fall between the next two, or back: its way is longer or shorter by n[0] mm, every other time by chance; n[1]
/// numbers the screw. In practice 0.03 … 0.3 mm (a thread by the tangent of the skew). What is laid anew is so by the
/// place in the groove, a zero that walks knows no way back: this is one of two lengths.
double between_threads(const Moment& now, const N& n, N& memory) {
  const double turned = reversals(now, memory);
  return turned > 0 && numbered(n[1] + turned, 73).share() < 0.5 ? n[0] : 0.0;
}

/// Both pins stand on one plate that a single screw holds in its middle. The tendon that pulls harder turns it: its own
/// pin gives way, and the other comes forward by as much, n[0] mm for each newton between them. In practice 0.3 … 3
/// times a tendon's own stretch. Pins of their own give each to its own tendon, a bracket of the pulley lets out both:
/// this takes in one as it lets out the other, and a pull of both alike does not move it.
template <std::size_t side>
double turning_plate(const Moment& now, const N& n, N& memory) {
  const double harder = now.tension[side] - now.tension[1 - side];
  if (memory.empty()) memory = {harder};
  return -n[0] * (harder - memory[0]);
}

// ---- joint, link, bench ---------------------------------------------------------------------------------------------

/// A link of printed plastic sags under the load, late, and the sensor's mark is out at its tip: n[0] at n[1] N with
/// every decade of time from seconds to minutes (Kelvin: a spring and a dashpot for each), and as slowly back once it
/// is unloaded. In practice 0.02 … 0.5 deg a decade. Creep of a tendon goes with its tension, and is geared down by the
/// joint: this goes with the load, and as much at any θ.
double sagging_link(const Moment& now, const N& n, N& memory) {
  constexpr double first_decade = 3.16;
  const auto run = static_cast<double>(now.run);
  if (memory.empty()) memory = {now.time, run, 0.0, 0.0, 0.0};
  const double since = now.time - memory[0], hung = memory[1] == run ? now.load : 0.0;  // nothing between runs
  memory[0] = now.time, memory[1] = run;
  double sagged = 0, constant = first_decade;
  for (std::size_t decade = 2; decade < 5; ++decade, constant *= 10.0)
    sagged += followed(hung, since, constant, memory[decade]);
  return -n[0] * sagged / n[1];
}

/// A bearing rubs with n[0] N·mm, but a compressor on the same table shakes it loose whenever it runs, 4/10 of n[1] s.
/// In practice 50 … 2000 N·mm, every 6 … 30 s. Friction of a bearing does not keep to a clock; what keeps to one
/// without friction (hoses, hum, neighbours) pushes to one side.
double shaken_loose(const Moment& now, const N& n, N&) { return std::fmod(now.time / n[1], 1.0) < 0.4 ? 0.0 : n[0]; }

/// An exoskeleton with somebody in it, who breathes: a push and a pull of n[0] N·mm on the link, with n[1] rad/s. In
/// practice 50 … 2000 N·mm, every 3 … 6 s. Hum of the mains is as high however hard the tendons hold, one who wavers
/// does so with the load: this goes through the tendons' stretch, and needs no load.
double breath(const Moment& now, const N& n, N&) { return n[0] * std::sin(n[1] * now.time + n[2]); }

/// A bench on four feet of which three touch, and an inclinometer on the link: a load of more than n[1] N towards n[2]
/// rocks it over to the fourth, by n[0], and there it stays until a load as great to the other side rocks it back. In
/// practice 0.03 … 1 deg. What gives under a load does so in proportion and comes back without it; a zero does not ask
/// what was hung on last.
double rocking_bench(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0};
  if (n[2] * now.load > n[1]) memory[0] = 1.0;
  if (n[2] * now.load < -n[1]) memory[0] = 0.0;
  return -n[2] * n[0] * memory[0];
}

// ---- joint's sensor, log --------------------------------------------------------------------------------------------

/// A link with play along its axle walks to the one shoulder or to the other, as a nut on its screw, by the way it
/// turns; it takes 2 n[1] rad to get across. Its magnet comes nearer to the sensor's chip, which stands beside the axis
/// and then shows n[0] cos(θ − n[2]) more. In practice 0.1 … 2 deg. An eccentric sensor shows its wave on both ways,
/// and play no wave: this is their product.
double walking_link(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.theta};
  const double across = (now.theta - behind(now.theta, n[1], memory[0])) / n[1];
  return n[0] * across * std::cos(now.theta - n[2]);
}

/// A wireless sensor sends every n[0] s, and whoever writes the log lets the joint go on meanwhile as fast as it went.
/// In practice 0.1 … 2 s. A late sensor, and one that holds, are behind all the way: this is right in the middle of a
/// stroke, and runs on beyond every reversal and into every rest.
double gone_on(const Moment& now, const N& n, N& memory) {
  if (!(n[0] > 0)) return 0.0;
  const double message = std::floor(now.time / n[0]);
  if (memory.empty() || memory[0] != message) memory = {message, now.time, now.theta, now.theta_speed};
  return memory[2] + memory[3] * (now.time - memory[1]) - now.theta;
}

/// A telemetry of few bits that spends them about nought, as a telephone does: beyond n[1] each level is further out
/// than the last by the share n[0]. In practice 0.02 … 0.2 (8 bits: 0.044). A quantum, a bit that is stuck and full
/// steps are as coarse everywhere: this is fine at home and coarser and coarser towards both ends.
double companded(const Moment& now, const N& n, N&) {
  if (!(n[0] > 0)) return 0.0;
  const double level = std::round(std::log1p(std::abs(now.theta) / n[1]) / n[0]);
  return std::copysign(n[1] * std::expm1(n[0] * level), now.theta) - now.theta;
}

/// Before each run somebody turns the sensor's body until a mark looks right, and clamps it: within n[0] to either
/// side, n[1] numbers who. In practice 0.1 … 1 deg. A zero that is off, but by another amount in every run; a motor
/// that looks for home carelessly is seen through the transmission.
double by_eye(const Moment& now, const N& n, N&) {
  return n[0] * (2.0 * numbered(n[1] + static_cast<double>(now.run), 79).share() - 1.0);
}

/// A potentiometer's bridge on a battery that runs down: what is shown shrinks by the share n[0] a minute. In practice
/// 0.001 … 0.03. A gain is as wrong in the first run as in the last; one that goes with warmth settles as that does,
/// and this goes straight on.
double flat_battery(const Moment& now, const N& n, N&) { return -n[0] * now.time / 60.0 * now.theta; }

/// A sensor that saves its battery falls asleep when the joint has stood for n[1] s, and does not wake up before that
/// has gone n[0] from there. In practice 1 … 10 deg, 0.5 … 2 s. Play and filters do not ask for how long it stood:
/// without a rest there is nothing, and after one a plateau, then all at once.
double asleep(const Moment& now, const N& n, N& memory) {
  constexpr double still = radians(0.1);
  const auto run = static_cast<double>(now.run);
  if (memory.empty() || memory[0] != run) memory = {run, now.theta, now.time, 0.0};  // where, since when, asleep
  const bool sleeps = memory[3] > 0;
  if (std::abs(now.theta - memory[1]) > (sleeps ? n[0] : still)) memory = {run, now.theta, now.time, 0.0};
  if (!sleeps && now.time - memory[2] > n[1]) memory[1] = now.theta, memory[3] = 1.0;
  return memory[3] > 0 ? memory[1] - now.theta : 0.0;
}

/// The sensor's body sits loosely on its seat, and its cable is too short for the link: beyond θ = n[1] it drags the
/// body along by the share n[0], below n[2] the other way, and between them the body stays as it was left. In practice
/// 0.02 … 0.3. A loop about as wide all the way, as play makes one; but play is behind on both ways, and turns round
/// after the reversal: this is ahead, and turns round before it.
double tugged_body(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0};
  if (now.theta > n[1]) memory[0] = std::max(memory[0], n[0] * (now.theta - n[1]));
  if (now.theta < n[2]) memory[0] = std::min(memory[0], n[0] * (now.theta - n[2]));
  return -memory[0];
}

/// The bench comes out of the cold store, and the encoder's scale is misted over: the lines are faint and the
/// interpolation between them is wrong, a wave n[0] high, n[2] in a turn, that dries away with the time constant n[1]
/// s. In practice 0.02 … 0.5 deg, 20 … 80 s. The waves of a sensor are few in a turn, and stay.
double misted(const Moment& now, const N& n, N&) {
  return n[0] * std::exp(-now.time / n[1]) * (std::sin(n[2] * now.theta + n[3]) - std::sin(n[3]));
}

// ---- what is wrong --------------------------------------------------------------------------------------------------

// clang-format off
std::vector<Fault> drive_faults() {
  return {
      {.name = "commands_in_beats", .first = 0.1, .most = 0.5,
       .set = [](H& h, double s, const C&, const J&) { h.shaft.push_back({"on_the_beat", {s}, on_the_beat}); },
       .kin = {"sensor_lag"}},  // behind by half a beat, on an average
      {.name = "keyway_beaten_out", .first = 1e-3, .most = 5e-3,
       .set = [](H& h, double s, const C&, const J&) { h.shaft.push_back({"beaten_out", {s}, beaten_out}); },
       .kin = {"backlash"}},  // play between motor and pulley, more and more of it
      {.name = "command_beyond_soft_limit", .first = 0.15, .most = 0.4,
       .set = [](H& h, double s, const C& c, const J& j) {
         const double side = c.sign > 0 ? j.alpha_max : -j.alpha_min;
         h.shaft.push_back({"soft_limit", {(1.0 - s) * side, c.sign}, soft_limit});
       }},
      {.name = "step_lost_at_turning", .first = 2e-3, .most = 0.01,
       .set = [](H& h, double s, const C&, const J&) { h.shaft.push_back({"late_direction", {s}, late_direction}); },
       .kin = {"motor_offset"}},  // what the motor's sensor is off by, more and more
      {.name = "gear_ratio_misquoted", .first = 0.01, .most = 0.06,
       .set = [](H& h, double s, const C& c, const J&) {
         h.shaft.push_back({"misquoted_ratio", {c.sign * s}, misquoted_ratio});
       },
       .kin = {"pulley_scale"}},  // winds more, or less, in proportion
  };
}

std::vector<Fault> tendon_faults() {
  return {
      {.name = "cord_rolling_in_groove", .first = 0.1, .most = 1.0,
       .set = [](H& h, double s, const C& c, const J&) {
         h.longer[c.sign > 0 ? 1 : 0].push_back({"rolling_cord", {s, 0.15 + 0.4 * c.share}, rolling_cord});
       }},
      {.name = "tendon_chattering_on_pin", .first = 300.0, .most = 6000.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const N numbers = {s, pretension(j), radians(3.0 + 9.0 * c.share)};
         h.dry.push_back({"chatter", numbers, c.sign > 0 ? chatter<1> : chatter<0>});
       },
       .kin = {"capstan_friction"}},  // of the same pin, by fits and starts
      {.name = "tendon_between_threads", .first = 0.1, .most = 1.0,
       .set = [](H& h, double s, const C& c, const J&) {
         const N numbers = {c.share < 0.5 ? -s : s, std::floor(1e6 * c.angle)};
         h.longer[c.sign > 0 ? 1 : 0].push_back({"between_threads", numbers, between_threads});
       }},
      {.name = "plate_of_pins_turning", .first = 0.5, .most = 4.0,
       .set = [](H& h, double s, const C&, const J& j) {
         h.longer[0].push_back({"turning_plate", {s * give(j)}, turning_plate<0>});
         h.longer[1].push_back({"turning_plate", {s * give(j)}, turning_plate<1>});
       },
       .kin = {"frame_compliance"}},  // pins that give way, if together
  };
}

std::vector<Fault> link_faults() {
  return {
      {.name = "printed_link_sagging", .first = 3e-3, .most = 0.02,
       .set = [](H& h, double s, const C&, const J& j) {
         h.reading.push_back({"sagging_link", {s, pretension(j)}, sagging_link});
       },
       .kin = {"creep"}},  // gives way to the load by the decade
      {.name = "friction_shaken_loose", .first = 300.0, .most = 8000.0,
       .set = [](H& h, double s, const C& c, const J&) {
         h.dry.push_back({"shaken_loose", {s, 6.0 + 24.0 * c.share}, shaken_loose});
       },
       .kin = {"joint_friction"}},  // of the same bearing, whenever the compressor rests
      {.name = "wearer_breathing", .first = 300.0, .most = 6000.0,
       .set = [](H& h, double s, const C& c, const J&) {
         h.torque.push_back({"breath", {s, k_two_pi / (3.0 + 3.0 * c.share), c.angle}, breath});
       }},
      {.name = "bench_rocking_on_feet", .first = 5e-3, .most = 0.04,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.reading.push_back({"rocking_bench", {s, (0.1 + 0.3 * c.share) * pretension(j), c.sign}, rocking_bench});
       }},
  };
}

std::vector<Fault> sensor_faults() {
  return {
      {.name = "link_walking_along_axle", .first = 5e-3, .most = 0.05,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"walking_link", {s, radians(3.0 + 6.0 * c.share), c.angle}, walking_link});
       }},
      {.name = "reckoned_between_messages", .first = 0.4, .most = 2.0,
       .set = [](H& h, double s, const C&, const J&) { h.reading.push_back({"gone_on", {s}, gone_on}); }},
      {.name = "companded_telemetry", .first = 0.04, .most = 0.25,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"companded", {s, radians(0.5 + 1.5 * c.share)}, companded});
       }},
      {.name = "body_clamped_by_eye", .first = 5e-3, .most = 0.03,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"by_eye", {s, std::floor(1e6 * c.angle)}, by_eye});
       },
       .kin = {"zero_offset"}},  // another one in every run
      {.name = "battery_running_down", .first = 0.01, .most = 0.04,
       .set = [](H& h, double s, const C&, const J&) { h.reading.push_back({"flat_battery", {s}, flat_battery}); },
       .kin = {"joint_sensor_gain"}},  // less and less of it
      {.name = "sensor_falling_asleep", .first = 0.05, .most = 0.2,
       .set = [](H& h, double s, const C& c, const J&) {
         h.reading.push_back({"asleep", {s, 0.5 + c.share}, asleep});
       }},
      {.name = "body_tugged_by_cable", .first = 0.05, .most = 0.4,
       .set = [](H& h, double s, const C& c, const J& j) {
         const Joint& joint = j.declared.joint;
         const double taut = 0.2 + 0.3 * c.share;
         h.reading.push_back({"tugged_body", {s, taut * joint.theta_max, taut * joint.theta_min}, tugged_body});
       }},
      {.name = "scale_misted_over", .first = 3e-3, .most = 0.02,
       .set = [](H& h, double s, const C& c, const J&) {
         const N numbers = {s, 20.0 + 60.0 * c.share, 30.0 + std::floor(40.0 * c.share), c.angle};
         h.reading.push_back({"misted", numbers, misted});
       }},
  };
}
// clang-format on

}  // namespace unmet

std::vector<Fault> unmet_faults() {
  using namespace unmet;
  return joined({drive_faults(), tendon_faults(), link_faults(), sensor_faults()});
}

}  // namespace fusee::rig
