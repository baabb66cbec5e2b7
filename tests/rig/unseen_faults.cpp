// The split that is kept aside: what goes wrong with tendon joints on real benches, written from the physics alone by a
// hand that did not see how calibration infers. Nothing is tuned on these; they are run once.
#include <algorithm>
#include <array>
#include <cmath>

#include "rig/fault_shapes.h"
#include "rig/faults.h"

namespace fusee::rig {
namespace unseen {

using namespace short_names;

// ---- motor and shaft ------------------------------------------------------------------------------------------------

/// The log holds the angle that was commanded. At a reversal friction turns round, and the integrator of the motor's
/// controller has to unwind before the shaft is where it should be: it is behind by n[0], for n[1] s. In practice 0.5 …
/// 3 deg, 0.3 … 2 s. Backlash is taken up by way and stays, lag goes with speed and stays: this passes with time, at
/// rest too, and is the same at any speed.
double winding_up(const Moment& now, const N& n, N& memory) {
  if (memory.empty() || memory[0] != now.direction) memory = {now.direction, 0.0};
  memory[1] += now.seconds;
  return -n[0] * now.direction * std::exp(-memory[1] / n[1]);
}

/// The motor's scale is two tapes, glued with a gap: from α = n[1] on it shows n[0] too little. In practice 0.2 … 3 deg
/// of the shaft. One step, whatever direction, load and time: no wave of low order and no curve of a length, a radius
/// or a place has one.
double gap_in_scale(const Moment& now, const N& n, N&) {
  return n[0] * ((now.alpha > n[1] ? 1.0 : 0.0) - (0.0 > n[1] ? 1.0 : 0.0));
}

/// A spider of rubber between motor and pulley: it gives at once to a little torque, until the jaws bite. n[0] is the
/// most, half of it at a load of n[1] N. In practice 1 … 5 deg. Stretch is in proportion to the tension and play knows
/// no load: this turns the pulley, by the load's sign, and saturates. (What friction adds to the torque is left out.)
double rubber_spider(const Moment& now, const N& n, N&) {
  const double x = now.load / n[1];
  return -n[0] * x / (1.0 + std::abs(x));
}

// ---- groove, knot, tendon -------------------------------------------------------------------------------------------

/// Tendon 2's knot is pulled through its pocket, a little with every load that comes on: n[0] mm each time that the
/// tension rises by n[1] N above n[1]. In practice 0.01 … 0.2 mm a pull. Slip is one event and creep comes back, both
/// whatever the number of pulls: this counts them, and never comes back.
double creeping_knot(const Moment& now, const N& n, N& memory) {
  const double tension = now.tension[1];
  if (memory.empty()) memory = {tension, 0.0};
  memory[1] += std::max(0.0, std::max(tension, n[1]) - std::max(memory[0], n[1])) / n[1];
  memory[0] = tension;
  return -n[0] * memory[1];
}

/// Tendon 1's turnbuckle shakes loose while the joint moves: n[0] mm a radian of the motor's way. In practice some
/// 0.1 mm in a session. Slip is at one moment; creep and warmth go on at rest, and this does not.
double unscrewing(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {now.alpha, 0.0};
  memory[1] += std::abs(now.alpha - memory[0]);
  memory[0] = now.alpha;
  return -n[0] * memory[1];
}

/// A burr on one flank of the groove, at α = n[1]. Only a load (n[2] N for all of it, with its sign) pulls the tendon
/// towards that flank and up the burr, n[0] mm. In practice 0.1 … 1 mm of way. An error of the profile is there under
/// any load, what load does is there at any α: this needs both.
double burr(const Moment& now, const N& n, N&) {
  return n[0] * bump((now.alpha - n[1]) / radians(4.0)) * std::clamp(now.load / n[2], 0.0, 1.0);
}

/// Tendon 1 is spliced, and the thick piece lies on the pin while α is near n[1]: its centre line goes round further
/// out, a way longer by n[0]. In practice 0.1 … 1 mm over 10 mm of tendon. A plateau with two edges in one tendon: no
/// wave of the pulley, no place or size of a pin.
double splice(const Moment& now, const N& n, N&) {
  constexpr double half = radians(15.0), edge = radians(5.0);
  const auto on_pin = [&](double alpha) { return std::clamp((half + edge - std::abs(alpha - n[1])) / edge, 0.0, 1.0); };
  return n[0] * (on_pin(now.alpha) - on_pin(0.0));
}

/// A braid that was let loose (below n[1] N) opens, gets thicker and so much shorter: n[0] mm. Drawn over its pin under
/// tension it closes again, within n[2] rad of the motor. In practice 0.05 … 0.5 mm. Creep lengthens what is pulled,
/// slack has no memory: this shortens what was not pulled, and is undone by way and not by time.
template <std::size_t side>
double open_braid(const Moment& now, const N& n, N& memory) {
  const double tension = now.tension[side];
  if (memory.empty()) {
    memory = {0.0, now.alpha};  // nothing is known of the tension yet
    return 0.0;
  }
  if (tension > n[1]) memory[0] *= std::exp(-std::abs(now.alpha - memory[1]) / n[2]);
  memory[0] = std::max(memory[0], 1.0 - tension / n[1]);
  memory[1] = now.alpha;
  return n[0] * memory[0];
}

/// Strands rub on each other as the tendon is pulled (Maxwell slip: Prandtl and Ishlinskii's play in parallel). Beyond
/// its stretch the tendon gives n[0] mm/N, and each third of that only when the tension has gone back by twice n[1],
/// n[2], n[3] N. In practice 5 … 40 % of the stretch. Stretch has no loop; pin, groove and bearing rub only where
/// something slides: this has its loop in the tension alone, with the joint held too.
template <std::size_t side>
double rubbing_strands(const Moment& now, const N& n, N& memory) {
  const double tension = now.tension[side];
  if (memory.empty()) {
    if (tension <= 0) return 0.0;
    memory = {tension, tension, tension, tension};
  }
  double longer = 0;
  for (std::size_t i = 1; i < 4; ++i) longer += n[0] / 3.0 * (behind(tension, n[i], memory[i]) - memory[0]);
  return -longer;
}

/// A polymer is softer when it is warm: n[0] mm/N more for each K, from n[1] N on to either side. In practice 0.5 … 2 %
/// of the stretch for each K. Expansion goes with the temperature whatever the load, stretch with the load whatever the
/// temperature: this is their product.
template <std::size_t side>
double softer_warm(const Moment& now, const N& n, N& memory) {
  if (memory.empty() && now.tension[side] <= 0) return 0.0;
  memory = {1.0};
  return -n[0] * now.warmth * (now.tension[side] - n[1]);
}

// ---- pins and frame -------------------------------------------------------------------------------------------------

/// A bent pin that sits loose in its hole: the tendon takes it round, n[3] rad for each of the joint, until it meets
/// its stop, n[2] from the middle, and only then slides over it. Its centre goes round with it: n[0] mm, from the
/// direction n[1]. In practice 0.05 … 0.5 mm. A pin in a wrong place has no memory; friction and play go to their end
/// at once: this goes through a wave after each reversal.
double rolling_pin(const Moment& now, const N& n, N& memory) {
  const double rolled = n[3] * now.theta;
  if (memory.empty()) memory = {rolled};
  const double turned = rolled - behind(rolled, n[2], memory[0]);
  return n[0] * (std::sin(turned + n[1]) - std::sin(n[1]));
}

/// A hexagonal stand-off where the file has a round pin: its rim is out by n[0] cos 6(φ − n[1]) in the direction φ, and
/// the tendon's way over it by the integral of that over the wrap; the lower end of the wrap hardly moves. In practice
/// 0.1 … 0.5 mm. A radius gives φ itself, a place gives its sine and cosine: this is a wave of the sixth order.
template <std::size_t side>
double hexagon(const Moment& now, const N& n, N& memory) {
  if (now.pull[side].isZero()) return 0.0;
  const double phi = std::atan2(now.pull[side].y(), now.pull[side].x());
  if (memory.empty()) memory = {phi};
  return n[0] / 6.0 * (std::sin(6.0 * (phi - n[1])) - std::sin(6.0 * (memory[0] - n[1])));
}

/// The motor warms its side of the frame by what it does (losses go with the square of the speed) and the frame bends:
/// one tendon's way is longer by n[0] mm for each rad²/s, the other's shorter; it cools within n[1] s. In practice 0.05
/// … 0.5 mm. Expansion follows the temperature that is logged, creep the load: this follows the work done.
double warming_frame(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0};
  memory[0] = memory[0] * std::exp(-now.seconds / n[1]) + now.alpha_speed * now.alpha_speed * now.seconds;
  return n[0] * memory[0];
}

// ---- link, load, sensor ---------------------------------------------------------------------------------------------

/// The link's bolt holds by friction up to n[1] N at the tip; beyond that the link gives way against the arm that the
/// tendons hold, up to its play n[0], all of it n[2] N later. The sensor sits on the link. In practice 0.2 … 2 deg.
/// Stretch and frame are in proportion from the first newton on, play is there without load: this has a threshold and
/// an end, and is the same at any θ.
double loose_bolt(const Moment& now, const N& n, N&) {
  const double turned = n[0] * std::clamp((std::abs(now.load) - n[1]) / n[2], 0.0, 1.0);
  return now.load > 0 ? -turned : turned;
}

/// The load hangs on a cord whose direction does not turn with the link: it leans by n[0] θ from the direction it has
/// at home, n[1] off the right angle, and the log holds what acts at home. n[0] = 1: a weight. In practice 0.5 … 1.5.
/// Gravity of the link itself is the same in every run: this is in proportion to the load.
double hanging_weight(const Moment& now, const N& n, N&) {
  return now.load * (std::cos(n[0] * now.theta + n[1]) / std::cos(n[1]) - 1.0);
}

/// A cell, and the control that pulls until the cell says so, that tires: beyond n[1] N it shows less and less, and
/// what pulls is more than the log says by the share n[0] of the square. In practice 10 … 50 % at full scale. What
/// gives is in proportion to the load: this has a threshold and bends upwards.
double tired_cell(const Moment& now, const N& n, N&) {
  const double beyond = std::max(0.0, std::abs(now.load) - n[1]);
  return (now.load > 0 ? n[0] : -n[0]) * beyond * beyond / n[1];
}

/// The sensor's cable is bent with the joint: a torque n[0] N·mm that turns round within 4 deg after a reversal (its
/// strands rub), small at n[1] rad, where it hangs free, and greater by all of it for a radian towards where it is
/// drawn tight. In practice 50 … 1000 N·mm. A bearing rubs the same everywhere and lets nothing move before it slides;
/// gravity has no memory.
double cable(const Moment& now, const N& n, N& memory) {
  constexpr double width = radians(2.0);
  if (memory.empty()) memory = {now.theta};
  const double bent = (now.theta - behind(now.theta, width, memory[0])) / width;
  return -n[0] * bent * (0.2 + std::abs(now.theta - n[1]));
}

/// A cable tie, a burr, a screw's head: the link runs against something soft before the end of its range. n[0] N·mm/rad
/// from θ = n[1] on, to the side of its sign. In practice 10⁴ … 10⁶. One-sided and sudden: nothing of the catalogue
/// begins at a place of θ.
double stop(const Moment& now, const N& n, N&) {
  return n[1] > 0 ? -n[0] * std::max(0.0, now.theta - n[1]) : n[0] * std::max(0.0, n[1] - now.theta);
}

/// A potentiometer whose track is worn through about θ = n[1], over n[0]: the wiper shows where it lost contact until
/// it is across. In practice 1 … 8 deg. No wave has a plateau that depends on where one comes from, and there is none
/// elsewhere, as with play.
double worn_track(const Moment& now, const N& n, N& memory) {
  const double half = 0.5 * n[0];
  if (memory.empty() || !(std::abs(now.theta - n[1]) < half)) memory = {now.theta};
  if (!(std::abs(now.theta - n[1]) < half)) return 0.0;
  return n[1] + (memory[0] < n[1] ? -half : half) - now.theta;
}

/// Link and tendons are a mass on springs, and every change of the motor's speed strikes it: what it shows rings with
/// n[1] rad/s and dies away within n[2] s. n[0] s: way for a change of speed by 1 rad/s. In practice 1/3 n[1] times
/// what it has to turn, 0.01 … 0.1. Lag goes with the speed and has one sign: this goes with its change and swings.
double ringing(const Moment& now, const N& n, N& memory) {
  if (memory.empty()) memory = {0.0, 0.0, now.alpha_speed, now.time};
  const double t = now.time - memory[3], damping = 1.0 / n[2];
  const double a = memory[0], b = (memory[1] + damping * a) / n[1];  // x = e^(−t/τ) (a cos ωt + b sin ωt)
  const double c = std::cos(n[1] * t), s = std::sin(n[1] * t), left = std::exp(-damping * t);
  const double x = left * (a * c + b * s);
  const double speed = left * n[1] * (b * c - a * s) - damping * x;
  memory = {x, speed - n[0] * n[1] * (now.alpha_speed - memory[2]), now.alpha_speed, now.time};
  return x;
}

// ---- what is wrong --------------------------------------------------------------------------------------------------

// clang-format off
std::vector<Fault> drive_faults() {
  return {
      {.name = "integrator_windup", .first = 0.03, .most = 0.3,
       .set = [](H& h, double s, const C& c, const J&) { h.shaft.push_back({"winding_up", {s, 0.3 + 1.7 * c.share}, winding_up}); }},
      {.name = "glued_scale", .first = 0.02, .most = 0.3,
       .set = [](H& h, double s, const C& c, const J& j) { h.shaft.push_back({"gap_in_scale", {c.sign * s, alpha_within(c, j)}, gap_in_scale}); }},
      {.name = "rubber_coupling", .first = 0.03, .most = 0.3,
       .set = [](H& h, double s, const C&, const J& j) { h.shaft.push_back({"rubber_spider", {s, 0.5 * pretension(j)}, rubber_spider}); },
       .kin = {"backlash"}},  // lost motion between motor and pulley, that the load takes up
  };
}

std::vector<Fault> tendon_faults() {
  return {
      {.name = "creeping_knot", .first = 0.02, .most = 0.5,
       .set = [](H& h, double s, const C&, const J& j) { h.longer[1].push_back({"creeping_knot", {s, 1.3 * pretension(j)}, creeping_knot}); },
       .kin = {"tendon_slip"}},  // material let go at a knot, bit by bit
      {.name = "unscrewing_turnbuckle", .first = 2e-3, .most = 0.05,
       .set = [](H& h, double s, const C&, const J&) { h.longer[0].push_back({"unscrewing", {s}, unscrewing}); },
       .kin = {"tendon_slip"}},
      {.name = "burr_under_load", .first = 0.2, .most = 1.5,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.longer[c.sign > 0 ? 1 : 0].push_back({"burr", {s, alpha_within(c, j), c.sign * 0.4 * pretension(j)}, burr});
       }},
      {.name = "spliced_tendon", .first = 0.1, .most = 2.0,
       .set = [](H& h, double s, const C& c, const J& j) { h.longer[0].push_back({"splice", {s, alpha_within(c, j)}, splice}); }},
      {.name = "opening_braid", .first = 0.1, .most = 1.0,
       .set = [](H& h, double s, const C& c, const J& j) {
         const N numbers = {s, 0.6 * pretension(j), 1.0 + 3.0 * c.share};
         h.longer[0].push_back({"open_braid", numbers, open_braid<0>});
         h.longer[1].push_back({"open_braid", numbers, open_braid<1>});
       }},
      {.name = "rubbing_strands", .first = 0.2, .most = 0.6,
       .set = [](H& h, double s, const C&, const J& j) {
         const double rest = pretension(j);
         const N numbers = {s * give(j), 0.1 * rest, 0.3 * rest, 0.7 * rest};
         h.longer[0].push_back({"rubbing_strands", numbers, rubbing_strands<0>});
         h.longer[1].push_back({"rubbing_strands", numbers, rubbing_strands<1>});
       },
       .kin = {"tendon_stretch"}},  // the middle of the loop
      {.name = "softer_when_warm", .first = 0.01, .most = 0.04,
       .set = [](H& h, double s, const C&, const J& j) {
         const N numbers = {s * give(j), pretension(j)};
         h.longer[0].push_back({"softer_warm", numbers, softer_warm<0>});
         h.longer[1].push_back({"softer_warm", numbers, softer_warm<1>});
       },
       .kin = {"tendon_stretch"}},  // another stiffness than declared, at all but one temperature
  };
}

std::vector<Fault> frame_faults() {
  return {
      {.name = "rolling_pin", .first = 0.1, .most = 1.5,
       .set = [](H& h, double s, const C& c, const J& j) {
         const Guides& guides = j.declared.guides;
         h.longer[1].push_back({"rolling_pin", {s, c.angle, 1.0 + 2.0 * c.share, guides.ED / guides.radius}, rolling_pin});
       }},
      {.name = "hexagonal_pin", .first = 0.3, .most = 1.0,
       .set = [](H& h, double s, const C& c, const J&) {
         const bool right = c.sign > 0;
         h.longer[right ? 1 : 0].push_back({"hexagon", {s, c.angle}, right ? hexagon<1> : hexagon<0>});
       },
       .kin = {"guide_radius"}},  // whoever looks there sees it
      {.name = "self_heating_frame", .first = 5e-3, .most = 0.2,
       .set = [](H& h, double s, const C& c, const J&) {
         const double cooling = 60.0 + 240.0 * c.share;
         h.longer[0].push_back({"warming_frame", {c.sign * s, cooling}, warming_frame});
         h.longer[1].push_back({"warming_frame", {-c.sign * s, cooling}, warming_frame});
       },
       .kin = {"thermal_expansion"}},  // of the frame, by its own heat
  };
}

std::vector<Fault> link_faults() {
  return {
      {.name = "loose_link_bolt", .first = 0.005, .most = 0.06,
       .set = [](H& h, double s, const C& c, const J& j) {
         h.reading.push_back({"loose_bolt", {s, (0.2 + 0.3 * c.share) * pretension(j), 0.4 * pretension(j)}, loose_bolt});
       },
       .kin = {"frame_compliance"}},  // a part of the structure that the load moves
      {.name = "hanging_weight", .first = 1.0, .most = 2.0,
       .set = [](H& h, double s, const C& c, const J&) { h.load.push_back({"hanging_weight", {s, 0.5 * std::sin(c.angle)}, hanging_weight}); },
       .kin = {"gravity"}},  // a weight whose lever turns with the joint
      {.name = "tired_load_cell", .first = 0.5, .most = 2.0,
       .set = [](H& h, double s, const C&, const J& j) { h.load.push_back({"tired_cell", {s, 0.3 * pretension(j)}, tired_cell}); },
       .kin = {"tendon_stretch"}},  // turned further by a newton of the log
      {.name = "cable_drag", .first = 100.0, .most = 5000.0,
       .set = [](H& h, double s, const C& c, const J& j) { h.torque.push_back({"cable", {s, end_of_range(c, j)}, cable}); },
       .kin = {"joint_friction"}},  // drag on the joint
      {.name = "early_stop", .first = 1e4, .most = 1e7,
       .set = [](H& h, double s, const C& c, const J& j) { h.torque.push_back({"stop", {s, (0.4 + 0.3 * c.share) * end_of_range(c, j)}, stop}); }},
      {.name = "worn_track", .first = 0.05, .most = 0.3,
       .set = [](H& h, double s, const C& c, const J& j) { h.reading.push_back({"worn_track", {s, theta_within(c, j)}, worn_track}); }},
      {.name = "ringing_link", .first = 0.02, .most = 0.5,
       .set = [](H& h, double s, const C& c, const J&) { h.reading.push_back({"ringing", {s, 10.0 + 20.0 * c.share, 0.5}, ringing}); }},
  };
}
// clang-format on

}  // namespace unseen

std::vector<Fault> unseen_faults() {
  using namespace unseen;
  return joined({drive_faults(), tendon_faults(), frame_faults(), link_faults()});
}

}  // namespace fusee::rig
