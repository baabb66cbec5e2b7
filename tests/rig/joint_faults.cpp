// Faults of the link, its drum and bearing, and of the load.
#include "rig/fault_table.h"

namespace fusee::rig::fault_table {

namespace {

Fault attachment(const char* name, decltype(Fault::set) set, decltype(Fault::numbers) numbers) {
  return {.split = "wide",
          .name = name,
          .first = 0.5,
          .most = 4.0,
          .set = set,
          .kin = {"guide_position"},
          .numbers = numbers};
}
template <std::size_t tendon>
void move_end(H& h, double size, const C& c, const J&) {
  h.end_moved[tendon] = size * Vec2(std::cos(c.angle), std::sin(c.angle));
}
template <std::size_t tendon>
Numbers report_end(const H& h, const J&) {
  return {{"across_mm", h.end_moved[tendon].x()}, {"along_mm", h.end_moved[tendon].y()}};
}

}  // namespace

// clang-format off
std::vector<Fault> joint_faults() { return {
  {.split = "named", .name = "joint_length", .first = 0.5, .most = 6.0,
   .set = [](H& h, double s, const C& c, const J&) { h.joint_length = c.sign * s; },
   .kin = {"guide_position", "joint_sensor_gain"},  // smooth in θ, almost proportional
   .numbers = [](const H& h, const J& j) -> Numbers { return {{"length_mm", j.declared.joint.R + h.joint_length}}; }},
  {.split = "named", .name = "gravity", .first = 300.0, .most = 20000.0,
   .set = [](H& h, double s, const C& c, const J&) { h.gravity = s, h.gravity_direction = c.angle; },
   .numbers = [](const H& h, const J&) -> Numbers {
     return {{"cos_Nmm", h.gravity * std::sin(h.gravity_direction)}, {"sin_Nmm", -h.gravity * std::cos(h.gravity_direction)}};
   }},
  {.split = "named", .name = "joint_friction", .first = 20.0, .most = 4000.0,
   .set = [](H& h, double s, const C&, const J&) { h.bearing = s; },
   .kin = {"capstan_friction"},
   .numbers = [](const H& h, const J&) -> Numbers { return {{"torque_Nmm", h.bearing}}; }},

  {.split = "wide", .name = "drum_radius", .first = 0.1, .most = 1.0,
   .set = [](H& h, double s, const C& c, const J&) { h.drum_radius = c.sign * s; },
   .kin = {"joint_sensor_gain", "radius_offset", "pulley_scale"},  // all change the ratio
   .numbers = [](const H& h, const J& j) -> Numbers { return {{"radius_mm", j.declared.joint.drum_radius + h.drum_radius}}; }},
  {.split = "wide", .name = "drum_runout", .first = 0.1, .most = 1.0,
   .set = [](H& h, double s, const C& c, const J&) { h.drum_runout = s, h.drum_runout_phase = c.angle; },
   .kin = {"joint_sensor_eccentricity"},  // one period per turn of the same link
   .numbers = [](const H& h, const J&) -> Numbers {
     return {{"across_mm", h.drum_runout * std::cos(h.drum_runout_phase)}, {"along_mm", h.drum_runout * std::sin(h.drum_runout_phase)}};
   }},
  attachment("attachment1_place", move_end<0>, report_end<0>),
  attachment("attachment2_place", move_end<1>, report_end<1>),

  {.split = "tuning", .name = "sticking_bearing", .first = 20.0, .most = 4000.0,
   .set = [](H& h, double s, const C&, const J&) { h.bearing = s, h.bearing_stick = 0.6 * s; },
   .kin = {"joint_friction"}},
  // Dry friction of n[0] N·mm at one place of the bearing, θ = n[1].
  {.split = "tuning", .name = "rubbing_place", .first = 50.0, .most = 8000.0, .kin = {"joint_friction"},
   .place = Place::dry_friction, .parameters = [](const D& d) -> N { return {d.size, d.theta_within()}; },
   .act = [](const M& now, const N& n, N&) { return n[0] * bump((now.theta - n[1]) / radians(4.0)); }},
  // Viscous damping by grease in the joint: n[0] N·mm·s.
  {.split = "tuning", .name = "grease", .first = 100.0, .most = 1e6,
   .kin = {"sensor_lag"},  // damping with compliance is a first-order lag
   .place = Place::joint_torque, .act = [](const M& now, const N& n, N&) { return -n[0] * now.theta_speed; }},
  // Bearing clearance: the axis is displaced by n[0] mm in the direction of the resultant force. Forces that balance
  // about the axis act at the link's end, so the displacement is along the link. Memory: first direction.
  {.split = "tuning", .name = "loose_axis", .first = 0.1, .most = 1.5, .kin = {"joint_length", "guide_position"},
   .place = Place::both_tendons, .act = [](const M& now, const N& n, N& memory) {
     const Vec2 force = force_on_axis(now);
     if (force.norm() < 1e-9) return 0.0;
     const Vec2 push = force.normalized();
     if (memory.empty()) memory = {push.x(), push.y()};
     return longer_by(now, n[0] * (push - Vec2(memory[0], memory[1])));
   }},
  // Tendons are tied to a ring that slides along the link: n[0] mm further out at 0.5 rad, with θ².
  {.split = "tuning", .name = "sliding_ring", .first = 0.2, .most = 5.0, .kin = {"joint_length"},
   .place = Place::both_tendons, .parameters = [](const D& d) -> N { return {d.sign * d.size}; },
   .act = [](const M& now, const N& n, N&) {
     const double out = n[0] * now.theta * now.theta / 0.25;
     return longer_by(now, out * Vec2(std::sin(now.theta), std::cos(now.theta)));
   }},

  // A flexure as joint: its centre moves along its middle line by n[0] mm at n[1] rad, with θ², and takes the link
  // along.
  {.split = "regression", .name = "flexure_wandering", .first = 0.2, .most = 2.0,
   .place = Place::both_tendons, .parameters = [](const D& d) -> N {
     const Joint& joint = d.joint.declared.joint;
     return {d.sign * d.size, std::max(joint.theta_max, -joint.theta_min)};
   },
   .act = [](const M& now, const N& n, N&) {
     const double far = now.theta / n[1];
     return longer_by(now, n[0] * far * far * Vec2(std::sin(0.5 * now.theta), std::cos(0.5 * now.theta)));
   }},
  // Soft fibres on polished pins: friction with the pull to the power of 2/3 (Hertz, Howell), n[0] N·mm at n[1] N each.
  {.split = "regression", .name = "fibres_rubbing_by_howells_law", .first = 300.0, .most = 8000.0,
   .kin = {"capstan_friction"},  // below proportionality
   .place = Place::dry_friction, .parameters = [](const D& d) -> N { return {d.size, d.pretension()}; },
   .act = [](const M& now, const N& n, N&) {
     const auto rubs = [&](double tension) { return std::pow(std::max(0.0, tension) / n[1], 2.0 / 3.0); };
     return 0.5 * n[0] * (rubs(now.tension[0]) + rubs(now.tension[1]));
   }},

  // A ball in a hollow link rolls to its lower end once |θ| exceeds n[1]: n[0] N·mm there (5 … 300). Memory: side, last
  // θ.
  {.split = "heldout_13", .name = "ball_rolling_in_hollow_link", .first = 200.0, .most = 5000.0,
   .place = Place::joint_torque, .parameters = [](const D& d) -> N { return {d.sign * d.size, radians(2.0 + 8.0 * d.share)}; },
   .act = [](const M& now, const N& n, N& memory) {
     if (memory.empty()) memory = {0.0, 0.0};
     if (std::abs(memory[1]) > n[1]) memory[0] = sign_of(memory[1]);
     memory[1] = now.theta;
     return n[0] * memory[0] * std::cos(now.theta);
   }},
  // A bearing's outer ring creeps in its seat, a rad per n[1] rad of the motor's path from n[2] on: the axis moves on a
  // circle of n[0] mm (0.01 … 0.2). Memory: α, path.
  {.split = "heldout_13", .name = "bearing_ring_creeping_round", .first = 0.1, .most = 1.0,
   .place = Place::both_tendons, .parameters = [](const D& d) -> N { return {d.size, 4.0 + 12.0 * d.share, d.angle}; },
   .act = [](const M& now, const N& n, N& memory) {
     if (memory.empty()) memory = {now.alpha, 0.0};
     memory[1] += motor_path(now, memory[0]);
     const double round = n[2] + memory[1] / n[1];
     return longer_by(now, n[0] * Vec2(std::cos(round) - std::cos(n[2]), std::sin(round) - std::sin(n[2])));
   }},
  // A ball catch on the axle: n[1] notches a turn, phase n[2], up to n[0] N·mm towards the nearest (50 … 1000).
  {.split = "heldout_13", .name = "axle_with_ball_catch", .first = 200.0, .most = 3000.0,
   .place = Place::joint_torque, .parameters = [](const D& d) -> N { return {d.size, 12.0 + std::floor(18.9 * d.share), d.angle}; },
   .act = [](const M& now, const N& n, N&) { return -n[0] * std::sin(n[1] * now.theta + n[2]); }},
  // Drag under water, with the square of the speed: n[0] N·mm at 1 rad/s of the motor (20 … 3000).
  {.split = "heldout_13", .name = "link_moved_under_water", .first = 500.0, .most = 8000.0,
   .place = Place::joint_torque, .act = [](const M& now, const N& n, N&) { return -n[0] * now.alpha_speed * std::abs(now.alpha_speed); }},
  // Gusts: n[0] N·mm on average (5 … 200), the square of a wind with correlation time n[1] s; n[2]: its seed. Memory:
  // wind, steps.
  {.split = "heldout_13", .name = "gusts_through_a_window", .first = 200.0, .most = 3000.0,
   .place = Place::joint_torque, .parameters = [](const D& d) -> N { return {d.sign * d.size, 1.0 + 5.0 * d.share, chance(d)}; },
   .act = [](const M& now, const N& n, N& memory) {
     if (memory.empty()) memory = {0.0, 0.0};
     const double decay = std::exp(-std::max(0.0, now.seconds) / n[1]);
     memory[0] = decay * memory[0] + std::sqrt(1.0 - decay * decay) * numbered(n[2] + memory[1]++, 149).normal();
     return n[0] * memory[0] * memory[0];
   }},
  // An axle nut turns with the link: it tightens on the way to +θ and loosens by 4/5 on the way back; friction of n[0]
  // N·mm/rad (50 … 2000). Memory: θ, tightened by.
  {.split = "heldout_13", .name = "axle_nut_tightening_itself", .first = 500.0, .most = 8000.0,
   .place = Place::dry_friction, .act = [](const M& now, const N& n, N& memory) {
     if (memory.empty()) memory = {now.theta, 0.0};
     const double way = now.theta - memory[0];
     memory[0] = now.theta;
     memory[1] = std::max(0.0, memory[1] + (way > 0 ? way : 0.8 * way));
     return n[0] * memory[1];
   }},
  // A pneumatic load from a leaking tank, refilled every n[1] s (8 … 60): it falls by the share n[0] (0.02 … 0.3) in
  // between, right on average; n[2]: phase.
  {.split = "heldout_13", .name = "compressor_refilling_its_tank", .first = 0.1, .most = 0.8,
   .place = Place::load, .parameters = [](const D& d) -> N { return {d.size, 8.0 + 32.0 * d.share, d.angle / k_two_pi}; },
   .act = [](const M& now, const N& n, N&) { return now.load * n[0] * (0.5 - fraction(now.time / n[1] + n[2])); }},
  // A pneumatic load through a throttle: it follows the logged one with the time constant n[0] s (0.2 … 10). Memory:
  // load.
  {.split = "heldout_13", .name = "air_for_load_throttled", .first = 1.0, .most = 12.0,
   .place = Place::load, .act = [](const M& now, const N& n, N& memory) {
     if (memory.empty()) memory = {0.0};
     if (!(n[0] > 0)) return 0.0 * (memory[0] = now.load);
     return followed(now.load, std::max(0.0, now.seconds), n[0], memory[0]) - now.load;
   }},
  // A voltage-driven motor as load: its pull changes by n[0] N at 1 rad/s of the pulley (0.2 … 5); none without a load.
  {.split = "heldout_13", .name = "motor_for_load_a_dynamo", .first = 1.0, .most = 15.0,
   .place = Place::load, .act = [](const M& now, const N& n, N&) { return now.load != 0 ? n[0] * now.alpha_speed : 0.0; }},
  // A cylinder on liquid gas: the load changes by the share n[0] per K (0.003 … 0.03).
  {.split = "heldout_13", .name = "gas_for_load_cooling", .first = 0.01, .most = 0.08,
   .place = Place::load, .act = [](const M& now, const N& n, N&) { return now.load * std::clamp(n[0] * now.warmth, -0.95, 0.95); }},
}; }
// clang-format on

}  // namespace fusee::rig::fault_table
