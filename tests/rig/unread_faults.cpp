// A sixth split that is kept aside: what goes wrong with tendon joints on real benches, by a seventh hand that saw
// neither how calibration infers nor what it makes of the other splits. Nothing is tuned on these; they are run once.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "rig/fault_shapes.h"
#include "rig/faults.h"
#include "rig/random.h"

namespace fusee::rig {
namespace unread {

using namespace short_names;

/// −1 … 1: which way `x` has gone last; it takes 2 `width` to turn round. 0 before any.
double lately(double x, double width, N& memory) {
  if (memory.empty()) memory = {x};
  return (x - behind(x, width, memory[0])) / width;
}

// ---- motor, gearbox, shaft ------------------------------------------------------------------------------------------

/// The motor's controller filters its angle and sends it late, while the joint's sensor is read at once: when a row is
/// written the shaft is n[0] s further on. In practice 2 … 50 ms. A late sensor of the joint is behind: this is ahead,
/// in proportion to the motor's speed and not the joint's.
double late_motor(const Moment& now, const N& n, N&) { return n[0] * now.alpha_speed; }

/// A gear with play of n[0], whose teeth the load holds together: from n[1] N on they lie on the flank it pushes to,
/// whichever way the motor goes; under less it pushes them from the other flank by as much less. In practice 0.1 … 3
/// deg, 1 … 10 N. Backlash has its loop under any load: this has it without one, and a step between both loads.
double pressed_play(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.alpha};
  const double half = 0.5 * n[0], pushed = std::clamp(now.load / n[1], -1.0, 1.0);
  const double low = half * (-1.0 - 2.0 * std::min(0.0, pushed)), high = half * (1.0 - 2.0 * std::max(0.0, pushed));
  return (memory[0] = std::clamp(memory[0], now.alpha + low, now.alpha + high)) - now.alpha;
}

/// A wheel whose teeth are cut well on one flank and badly on the other: a wave n[0] high, n[1] in a turn, but only
/// where the bad flank carries: on the way up, or, from 2 n[2] N on, both ways under a load that has to be lifted and
/// never under the other. The teeth change flanks within 2 deg. In practice 0.05 … 1 deg, 5 … 12 in a turn. A wave of
/// sensor, gear or profile is there on both ways and under any load.
double bad_flank(const Moment& now, const N& n, N& memory) {
  const double carries = std::clamp(lately(now.alpha, radians(1.0), memory) + now.load / n[2], -1.0, 1.0);
  return n[0] * 0.5 * (1.0 + carries) * std::sin(n[1] * now.alpha + n[3]);
}

/// A motor that its controller holds by a spring's law (no integrator) and that gets weak as it gets hot: heat goes
/// with the square of the load, of which n[1] N are the unit, and follows it with n[2] s; the shaft is pushed back by
/// n[0] times load times heat. In practice 0.2 … 3 deg at full load, 10 … 120 s. Stretch is all there at once, creep is
/// in proportion to what pulls, warmth needs no load: this grows with its cube, late, and is nothing without it.
double hot_motor(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0};
  const double pull = now.load / n[1];
  return -n[0] * pull * followed(pull * pull, now.seconds, n[2], memory[0]);
}

/// The bracket that holds motor and pulley bends: the pulley's axis moves by n[0] mm for a newton of what both tendons
/// pull together, along the way to tendon 1's pin (n[1] from upright) and to tendon 2's (n[2]). In practice 0.001 …
/// 0.05 mm/N (from sheet to print). Pins that give way, and tendons, take each its own pull: here each tendon is let
/// out by the other one's too. A bushing has an end, and slots keep what they have.
template <std::size_t side>
double bending_bracket(const Moment& now, const N& n, N& memory) {
  const std::array<Vec2, 2> up = up_to_pins(n[1], n[2]);
  const Vec2 force = now.tension[0] * up[0] + now.tension[1] * up[1];
  if (memory.empty()) memory = {force.x(), force.y()};
  return -n[0] * (force - Vec2(memory[0], memory[1])).dot(up[side]);
}

// ---- pulley, tendon, pins -------------------------------------------------------------------------------------------

/// A groove much wider than its cord: tendon 2 lies now deep and now up its flank, n[0] mm (standard deviation) further
/// out or in, another way in every n[1] rad and each time that piece is wound anew; it comes off as it was laid. n[2]:
/// α from which on it is laid, n[3]: number of the first lay. In practice 0.02 … 0.3 mm, 8 … 25 deg. A profile is the
/// same in every stroke; a zero or friction that is drawn anew has no place, and no sum of what was wound.
double laid_anew(const Moment& now, const N& n, N& memory) {
  const double pieces = std::max(0.0, (now.alpha - n[2]) / n[1]);
  const auto whole = static_cast<std::size_t>(pieces);
  const bool first = memory.empty();
  if (first) memory = {n[3], 0.0};  // lays so far, home; then each piece's
  if (memory.size() > whole + 3) memory.resize(whole + 3);
  while (memory.size() < whole + 3) {
    memory[0] += 1.0;
    memory.push_back(numbered(memory[0], 61).normal());
  }
  double laid = (pieces - static_cast<double>(whole)) * memory.back();
  for (std::size_t piece = 0; piece < whole; ++piece) laid += memory[2 + piece];
  if (first) memory[1] = laid;
  return n[0] * n[1] * (laid - memory[1]);
}

/// A wire of the rope has broken and stands off against its lay: as the motor draws it over the pin, about α = n[2] and
/// n[3] wide, it scrapes, n[0] N·mm on the joint for n[1] N in that tendon; the other way it lies down. In practice 20
/// … 1000 N·mm, over 5 … 20 deg. A pin rubs in both directions and everywhere, a place in the bearing whatever pulls.
template <std::size_t side>
double barb(const Moment& now, const N& n, N&) {
  const bool drawn = side == 1 ? now.direction > 0 : now.direction < 0;
  return drawn ? n[0] * now.tension[side] / n[1] * bump((now.alpha - n[2]) / n[3]) : 0.0;
}

/// Somebody finds one tendon too loose and tightens its turnbuckle before the run n[1]: it is n[0] mm shorter from then
/// on. In practice 0.1 … 2 mm (a fifth of a turn to four). Slip lets go, and within a run; slack and offsets are the
/// same in all runs.
double tightened(const Moment& now, const N& n, N&) { return static_cast<double>(now.run) >= n[1] ? n[0] : 0.0; }

/// A wire too stiff for a thin pin stands off it where it comes and goes: its line runs B/(2 T R) further out (B: its
/// bending stiffness), so that its way is longer by n[0] mm at n[1] N, half of that at twice as much, down to a fifth
/// of n[1], where it touches the pin at one point only. In practice 0.02 … 0.3 mm (cable of 0.5 … 1 mm on pins of 2 …
/// 4). A thick pin is as thick at any pull; what stretches gives evenly, and this nearly all where it is slack.
template <std::size_t side>
double standing_off(const Moment& now, const N& n, N& memory) {
  const auto off = [&](double tension) { return n[1] / std::max(tension, 0.2 * n[1]); };
  if (memory.empty()) memory = {off(now.tension[side])};
  return n[0] * (off(now.tension[side]) - memory[0]);
}

/// Both tendons go through one hole and lie across each other: they share what they are in each other's way by, each
/// the more the less it is pulled, and its way is longer by the square of its share: n[0] mm if it took all. In
/// practice 0.02 … 0.6 mm (h² / 2 (1/a + 1/b): 1 … 5 mm). Stretch and frames go with the pull, whatever the other's;
/// this with the ratio of both alone, and has an end where one is slack.
template <std::size_t side>
double across(const Moment& now, const N& n, N& memory) {
  const double both = now.tension[0] + now.tension[1];
  const double share = both > 1e-9 ? now.tension[1 - side] / both : 0.5;
  if (memory.empty()) memory = {share};
  return n[0] * (share * share - memory[0] * memory[0]);
}

// ---- load, joint, link ----------------------------------------------------------------------------------------------

/// A rubber band pulls where a weight should: the log holds its pull at home, and a radian of the joint against it
/// pulls the share n[0] more. Back from where it was drawn furthest it is softer inside (Mullins 1948): its pull falls
/// by the share n[1] faster, and follows the same line until it is drawn further than ever. It is let go, and new,
/// without a load. In practice 0.1 … 2, 0.1 … 0.4. A weight and its lever have no memory, friction turns round at every
/// reversal and not at one alone.
double rubber_band(const Moment& now, const N& n, N& memory) {
  const double pull = now.load > 0 ? 1.0 : now.load < 0 ? -1.0 : 0.0;
  const double drawn = pull * now.theta;
  if (memory.empty() || memory[0] != pull) memory = {pull, drawn};
  memory[1] = std::max(memory[1], drawn);
  return now.load * std::max(-1.0, n[0] * (drawn - n[1] * (memory[1] - drawn)));
}

/// A load pulls over a wheel whose bore is off its middle by the share n[0] of its radius: more or less of it comes to
/// the joint, n[1] rad of the wheel to one of the joint. In practice 0.01 … 0.15. A wave, but of what pulls: those of
/// sensors, gears and profiles need no load, dents are as deep under any.
double load_wheel(const Moment& now, const N& n, N&) {
  return n[0] * now.load * (std::sin(n[1] * now.theta + n[2]) - std::sin(n[2]));
}

/// An air hose along the joint is a spring about θ = n[1] that stiffens with its pressure: by n[0] N·mm/rad just after
/// the compressor has run (3/10 of n[2] s), less and less as it leaks (7/10). In practice 200 … 5000 N·mm/rad, every 8
/// … 40 s. (What it does at the least pressure is left out.) Weight and springs know no clock; a clock that moves the
/// frame or the sensor knows no place: this is their product.
double hose(const Moment& now, const N& n, N&) {
  const double beat = std::fmod(now.time / n[2], 1.0);
  const double pressure = beat < 0.3 ? beat / 0.3 : (1.0 - beat) / 0.7;
  return -n[0] * pressure * (now.theta - n[1]);
}

/// A pin in a hole too wide: it climbs the wall the way it rolls, by the angle of friction, and lies n[0] mm across to
/// that side until the joint turns round, which takes 2 deg. In practice 0.02 … 0.15 mm (play times coefficient). A
/// loose axis lies where the force pushes it, whatever the way; the motor's play is taken up before the joint moves,
/// and this while it does.
template <std::size_t side>
double climbing_axis(const Moment& now, const N& n, N& memory) {
  return -n[0] * lately(now.theta, radians(1.0), memory) * now.pull[side].x();
}

/// A new bearing, too tight or too full of grease: n[0] N·mm of dry friction, that run in with the way, down to 1/e
/// within n[1] rad of the joint. In practice 50 … 2000 N·mm, 2 … 10 rad. A bearing's friction is the same in all runs,
/// a seal's comes back at rest, and what cools or loses its wax has more and more.
double running_in(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.theta, 0.0};
  memory = {now.theta, memory[1] + std::abs(now.theta - memory[0])};
  return n[0] * std::exp(-memory[1] / n[1]);
}

// ---- joint's sensor, log --------------------------------------------------------------------------------------------

/// The joint's potentiometer is driven by small gears, or a fork, with play of n[0]. In practice 0.2 … 3 deg. Backlash
/// is of the motor's shaft, and narrower by the transmission where that is steep; tendons and load know of neither:
/// this is as wide everywhere, and where the joint turns round by itself.
double linkage(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.theta};
  return behind(now.theta, 0.5 * n[0], memory[0]) - now.theta;
}

/// A Hall sensor whose magnet loses by warmth: what is shown is off by the share n[0] for each K. In practice 2·10⁻⁴ …
/// 3·10⁻³ (from rare earth to ferrite). A gain is the same from the begin, a zero that drifts is off at home too: this
/// is their product.
double warm_gain(const Moment& now, const N& n, N&) { return n[0] * now.warmth * now.theta; }

/// Weights of iron that pass the magnet of the joint's sensor turn its field: by n[0] where they are nearest, at θ =
/// n[2], and with the third power of the distance elsewhere, n[3] wide; from n[1] N on there is enough of them. In
/// practice 0.1 … 3 deg. Stretch is everywhere, a bad place of the sensor under any load; neither has one sign under
/// both loads.
double iron(const Moment& now, const N& n, N&) {
  const double off = (now.theta - n[2]) / n[3];
  return n[0] * std::min(1.0, std::abs(now.load) / n[1]) * std::pow(1.0 + off * off, -1.5);
}

/// The joint's encoder has a wheel of rubber that an arm presses on the link: pushed along it digs in, dragged behind
/// it is lifted and slips by the share n[0] of the way up. In practice 10⁻⁴ … 0.01. What grows with time or warmth does
/// so at rest and under way both ways, a gain is undone on the way back: this is lost, and as much at any place.
double one_way_wheel(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.theta, 0.0};
  memory = {now.theta, memory[1] + std::max(0.0, now.theta - memory[0])};
  return -n[0] * memory[1];
}

/// The joint's counter is set right at its index, θ = n[1], by a program that comes to it n[0] s late: what the joint
/// has done meanwhile stays lost until the next passage. In practice 1 … 50 ms. A late sensor is right at rest and
/// where it turns round: this is off there by the speed of the last passage, and steps at one place.
double late_index(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.theta, 0.0};
  const bool passed = (memory[0] < n[1]) != (now.theta < n[1]);
  memory = {now.theta, passed ? now.theta_speed : memory[1]};
  return -n[0] * memory[1];
}

// ---- what is wrong --------------------------------------------------------------------------------------------------

// clang-format off
std::vector<Fault> drive_faults() {
  return {
      {.name = "late_motor_sensor", .first = 0.02, .most = 0.4,
       .set = [](H& h, double s, const C&, const J&) { h.shaft.push_back({"late_motor", {s}, late_motor}); },
       .kin = {"sensor_lag"}},  // the two sensors are not of the same moment
      {.name = "play_pressed_by_load", .first = 0.02, .most = 0.2,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.shaft.push_back({"pressed_play", {s, (0.05 + 0.3 * c.share) * pretension(j)}, pressed_play});
       },
       .kin = {"backlash"}},  // play between motor and pulley, in the runs without a load
      {.name = "one_bad_flank", .first = 0.01, .most = 0.1,
       .set = [](H& h, double s, const C& c, const J& j) {
         const N numbers = {s, 5.0 + std::floor(8.0 * c.share), 0.1 * pretension(j), c.angle};
         h.shaft.push_back({"bad_flank", numbers, bad_flank});
       }},
      {.name = "motor_weak_when_hot", .first = 0.03, .most = 0.3,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.shaft.push_back({"hot_motor", {s, pretension(j), 10.0 + 110.0 * c.share * c.share}, hot_motor});
       }},
      {.name = "motor_bracket_bending", .first = 0.01, .most = 0.2,
       .set = [](H& h, double s, const C&, const J& j) {
         const auto [first, second] = ways_to_pins(j);
         const N numbers = {s, first, second};
         h.longer[0].push_back({"bending_bracket", numbers, bending_bracket<0>});
         h.longer[1].push_back({"bending_bracket", numbers, bending_bracket<1>});
       },
       .kin = {"frame_compliance"}},  // a part of the frame that gives way, the pulley's and not the pins'
  };
}

std::vector<Fault> tendon_faults() {
  return {
      {.name = "tendon_laid_anew", .first = 0.1, .most = 2.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const double piece = radians(8.0 + 17.0 * c.share);
         h.longer[1].push_back({"laid_anew", {s, piece, 1.2 * j.alpha_min, std::floor(1e6 * c.angle)}, laid_anew});
       }},
      {.name = "barb_on_tendon", .first = 400.0, .most = 12000.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const N numbers = {s, pretension(j), alpha_within(c, j), radians(5.0 + 15.0 * c.angle / k_two_pi)};
         h.dry.push_back({"barb", numbers, c.sign > 0 ? barb<1> : barb<0>});
       },
       .kin = {"capstan_friction"}},  // of the same pin, at one place and one way
      {.name = "retensioned_between_runs", .first = 0.1, .most = 2.5,
       .set = [](H& h, double s, const C& c, const J&) {
         h.longer[c.sign > 0 ? 1 : 0].push_back({"tightened", {s, c.share < 0.7 ? 1.0 : 2.0}, tightened});
       },
       .kin = {"tendon_slip"}},  // a tendon of another length from a moment on
      {.name = "wire_standing_off_pin", .first = 0.1, .most = 1.5,
       .set = [](H& h, double s, const C&, const J& j) {
         h.longer[0].push_back({"standing_off", {s, pretension(j)}, standing_off<0>});
         h.longer[1].push_back({"standing_off", {s, pretension(j)}, standing_off<1>});
       },
       .kin = {"guide_radius"}},  // round the pin further out
      {.name = "tendons_across_each_other", .first = 0.2, .most = 3.0,
       .set = [](H& h, double s, const C&, const J&) {
         h.longer[0].push_back({"across", {s}, across<0>});
         h.longer[1].push_back({"across", {s}, across<1>});
       }},
  };
}

std::vector<Fault> link_faults() {
  return {
      {.name = "rubber_band_for_load", .first = 0.2, .most = 3.0,
       .set = [](H& h, double s, const C& c, const J&) {
         h.load.push_back({"rubber_band", {s, 0.1 + 0.3 * c.share}, rubber_band});
       }},
      {.name = "eccentric_load_wheel", .first = 0.1, .most = 0.5,
       .set = [](H& h, double s, const C& c, const J&) {
         h.load.push_back({"load_wheel", {s, 4.0 + 6.0 * c.share, c.angle}, load_wheel});
       }},
      {.name = "hose_under_pressure", .first = 1000.0, .most = 1e5,
       .set = [](H& h, double s, const C& c, const J& j) {
         const N numbers = {s, 0.3 * end_of_range(c, j), 8.0 + 32.0 * c.share};
         h.torque.push_back({"hose", numbers, hose});
       }},
      {.name = "axis_climbing_in_hole", .first = 0.05, .most = 0.5,
       .set = [](H& h, double s, const C&, const J&) {
         h.longer[0].push_back({"climbing_axis", {s}, climbing_axis<0>});
         h.longer[1].push_back({"climbing_axis", {s}, climbing_axis<1>});
       },
       .kin = {"backlash"}},  // lost motion
      {.name = "bearing_running_in", .first = 300.0, .most = 8000.0,
       .set = [](H& h, double s, const C& c, const J&) {
         h.dry.push_back({"running_in", {s, 2.0 + 8.0 * c.share}, running_in});
       },
       .kin = {"joint_friction"}},  // of the same bearing, less and less
  };
}

std::vector<Fault> sensor_faults() {
  return {
      {.name = "play_at_joint_sensor", .first = 0.01, .most = 0.1,
       .set = [](H& h, double s, const C&, const J&) { h.reading.push_back({"linkage", {s}, linkage}); },
       .kin = {"backlash"}},  // play, at the other end of the chain
      {.name = "gain_going_with_warmth", .first = 1e-3, .most = 0.03,
       .set = [](H& h, double s, const C& c, const J&) { h.reading.push_back({"warm_gain", {c.sign * s}, warm_gain}); },
       .kin = {"joint_sensor_gain"}},  // the same, once it has cooled
      {.name = "iron_near_sensor", .first = 0.01, .most = 0.15,
       .set = [](H& h, double s, const C& c, const J& j) {
         const double wide = radians(5.0 + 10.0 * c.angle / k_two_pi);
         h.reading.push_back({"iron", {c.sign * s, 0.2 * pretension(j), theta_within(c, j), wide}, iron});
       }},
      {.name = "wheel_slipping_one_way", .first = 1e-3, .most = 0.03,
       .set = [](H& h, double s, const C&, const J&) { h.reading.push_back({"one_way_wheel", {s}, one_way_wheel}); }},
      {.name = "index_caught_late", .first = 0.02, .most = 0.4,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.reading.push_back({"late_index", {s, theta_within(c, j)}, late_index});
       }},
  };
}
// clang-format on

}  // namespace unread

std::vector<Fault> unread_faults() {
  using namespace unread;
  return joined({drive_faults(), tendon_faults(), link_faults(), sensor_faults()});
}

}  // namespace fusee::rig
