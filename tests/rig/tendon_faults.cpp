// Faults of pulleys, tendons, sheaths, pins and frame.
#include "rig/fault_table.h"

namespace fusee::rig::fault_table {

namespace {

double section(const J& j) {
  const double d = j.declared.tendon.diameter;
  return 0.25 * k_pi * d * d;
}

/// Displaces one pin in a third of the cases, else both differently.
void move_pins(H& h, double s, const C& c) {
  const auto side = c.sign > 0 ? 1u : 0u;
  h.pin_outward[side] = s * std::cos(c.angle);
  h.pin_down[side] = s * std::sin(c.angle);
  if (c.share < 1.0 / 3.0) return;
  const double other = c.angle + k_two_pi * c.share;
  h.pin_outward[1 - side] = 0.7 * s * std::cos(other);
  h.pin_down[1 - side] = 0.7 * s * std::sin(other);
}

}  // namespace

// clang-format off
std::vector<Fault> tendon_faults() { return {
  {.split = "named", .name = "radius_offset", .first = 0.1, .most = 1.0,
   .set = [](H& h, double s, const C& c, const J&) { h.radius_offset = c.sign * s; },
   .kin = {"pulley_scale"},  // identical on a round pulley
   .numbers = [](const H& h, const J&) -> Numbers { return {{"offset_mm", h.radius_offset}}; }},
  {.split = "named", .name = "pulley_scale", .first = 0.01, .most = 0.06,
   .set = [](H& h, double s, const C& c, const J&) { h.pulley_scale = c.sign * s; },
   .kin = {"radius_offset"},
   .numbers = [](const H& h, const J&) -> Numbers { return {{"scale_percent", percent(h.pulley_scale)}}; }},
  {.split = "named", .name = "pulley_runout", .first = 0.1, .most = 1.5,
   .set = [](H& h, double s, const C& c, const J&) { h.runout_x = s * std::cos(c.angle), h.runout_y = s * std::sin(c.angle); },
   .kin = {"motor_sensor_eccentricity"},
   .numbers = [](const H& h, const J&) -> Numbers { return {{"x_mm", h.runout_x}, {"y_mm", h.runout_y}}; }},
  {.split = "named", .name = "profile_error", .first = 0.05, .most = 0.3,
   .set = [](H& h, double s, const C& c, const J&) { h.profile_error = s, h.profile_phase = c.angle, h.profile_harmonic = c.share < 0.5 ? 2 : 3; },
   .kin = {"motor_sensor_harmonic"},
   .numbers = [](const H& h, const J&) -> Numbers {
     return {{"sin_mm", -h.profile_error * std::sin(h.profile_phase)}, {"cos_mm", h.profile_error * std::cos(h.profile_phase)},
             {"harmonic", h.profile_harmonic}};
   }},
  // μ from polished to rough. A groove of 50° has 2.4 times the friction of its material (wedge).
  {.split = "named", .name = "groove_friction", .first = 0.15, .most = 0.3,
   .set = [](H& h, double s, const C& c, const J&) { h.groove_friction = c.sign > 0 ? 0.2 + s : std::max(0.05, 0.2 - 0.5 * s); },
   .numbers = [](const H& h, const J&) -> Numbers { return {{"mu", h.groove_friction}}; },
   .least_seen = 0.5},
  {.split = "named", .name = "tendon_stretch", .first = 1.0, .most = 12.0,
   .set = [](H& h, double s, const C&, const J& j) { h.modulus = j.declared.tendon.modulus / (1.0 + s); },
   .kin = {"frame_compliance"},  // both proportional to the tension
   .numbers = [](const H& h, const J& j) -> Numbers { return {{"EA_N", h.modulus * section(j)}}; }},
  {.split = "named", .name = "slack", .first = 0.1, .most = 3.0,
   .set = [](H& h, double s, const C&, const J&) { h.slack = s; },
   .kin = {"backlash"},
   .numbers = [](const H& h, const J&) -> Numbers { return {{"slack_mm", h.slack}}; }},
  {.split = "named", .name = "creep", .first = 0.1, .most = 1.5,
   .set = [](H& h, double s, const C&, const J&) { h.creep = s; },
   .numbers = [](const H& h, const J&) -> Numbers { return {{"compliance_percent_per_decade", percent(h.creep)}}; }},
  {.split = "named", .name = "tendon_slip", .first = 0.1, .most = 2.0,
   .set = [](H& h, double s, const C& c, const J&) { h.slip = s, h.slip_side = 1, h.slip_run = 1, h.slip_at = 0.3 + 0.4 * c.share; }},
  {.split = "named", .name = "thermal_expansion", .first = 2e-5, .most = 4e-4,
   .set = [](H& h, double s, const C&, const J&) { h.expansion = s; },
   .numbers = [](const H& h, const J&) -> Numbers {
     return {{"tendon1_ppm_per_K", 1e6 * h.expansion * h.expansion_other}, {"tendon2_ppm_per_K", 1e6 * h.expansion}};
   }},
  {.split = "named", .name = "capstan_friction", .first = 0.2, .most = 1.5,
   .set = [](H& h, double s, const C&, const J&) { h.friction = s; },
   .kin = {"joint_friction"},  // dry friction against the joint's motion
   .numbers = [](const H& h, const J& j) -> Numbers { return {{"mu", j.declared.guides.mu + h.friction}}; }},
  {.split = "named", .name = "guide_radius", .first = 0.5, .most = 6.0,
   .set = [](H& h, double s, const C&, const J&) { h.guide_radius = s; },
   .kin = {"guide_position"},  // a thicker pin stands further out
   .numbers = [](const H& h, const J& j) -> Numbers { return {{"radius_mm", j.declared.guides.radius + h.guide_radius}}; }},
  {.split = "named", .name = "guide_position", .first = 0.5, .most = 4.0,
   .set = [](H& h, double s, const C& c, const J&) { move_pins(h, s, c); },
   .kin = {"guide_radius", "joint_length"},
   .numbers = [](const H& h, const J&) -> Numbers {
     return {{"outward1_mm", h.pin_outward[0]}, {"down1_mm", h.pin_down[0]}, {"outward2_mm", h.pin_outward[1]}, {"down2_mm", h.pin_down[1]}};
   }},
  {.split = "named", .name = "frame_compliance", .first = 1e-3, .most = 0.2,
   .set = [](H& h, double s, const C&, const J&) { h.frame_compliance = s; },
   .kin = {"tendon_stretch"},
   .numbers = [](const H& h, const J&) -> Numbers { return {{"mm_per_N", h.frame_compliance}}; }},

  {.split = "wide", .name = "idler_friction", .first = 0.1, .most = 1.5,
   .set = [](H& h, double s, const C&, const J&) { h.bearing_friction = s; },
   .kin = {"joint_friction"},  // dry friction against the joint's motion
   .numbers = [](const H& h, const J& j) -> Numbers { return {{"mu", j.declared.guides.bearing_friction + h.bearing_friction}}; }},
  {.split = "wide", .name = "sheath_friction", .first = 0.1, .most = 0.8,
   .set = [](H& h, double s, const C&, const J&) { h.sheath_friction = s; },
   .kin = {"capstan_friction"},
   .numbers = [](const H& h, const J& j) -> Numbers { return {{"mu_bend", j.declared.sheath.mu * j.declared.sheath.bend + h.sheath_friction}}; }},
  {.split = "wide", .name = "sheath_stiffness", .first = 0.01, .most = 0.1,
   .set = [](H& h, double s, const C&, const J&) { h.sheath_compliance = s; },
   .kin = {"tendon_stretch", "frame_compliance"},  // springs along the tendon
   .numbers = [](const H& h, const J& j) -> Numbers {
     const double stiffness = j.declared.sheath.stiffness;
     return {{"mm_per_N", (stiffness > 0 ? 1.0 / stiffness : 0.0) + h.sheath_compliance}};
   }},

  {.split = "tuning", .name = "lump", .first = 0.1, .most = 3.0,
   .set = [](H& h, double s, const C& c, const J& j) {
     h.lump = c.sign * s, h.lump_width = radians(7.0), h.lump_at = Draw{c, s, j}.alpha_within();
   }},
  // Overlapping turns: from α = n[1] on, the tendon winds at a radius larger by n[0] mm.
  {.split = "tuning", .name = "on_its_own_turns", .first = 0.2, .most = 4.0,
   .place = Place::tendon_2, .parameters = [](const D& d) -> N { return {d.size, d.alpha_within()}; },
   .act = [](const M& now, const N& n, N&) { return n[0] * std::max(0.0, now.alpha - n[1]); }},
  // The tendon climbs the groove's flank by n[0] mm about α = n[1] while it is wound in.
  {.split = "tuning", .name = "climbing_flank", .first = 0.1, .most = 3.0,
   .place = Place::tendon_2, .parameters = [](const D& d) -> N { return {d.size, d.alpha_within()}; },
   .act = [](const M& now, const N& n, N&) { return now.direction > 0 ? n[0] * bump((now.alpha - n[1]) / radians(6.0)) : 0.0; }},
  // A flat of depth n[0] mm on the pin, in contact with the tendon about θ = n[1].
  {.split = "tuning", .name = "flat_on_pin", .first = 0.1, .most = 3.0,
   .place = Place::tendon_2, .parameters = [](const D& d) -> N { return {d.size, d.theta_within()}; },
   .act = [](const M& now, const N& n, N&) {
     const double x = (now.theta - n[1]) / radians(6.0);
     return -n[0] * std::max(0.0, 1.0 - x * x);
   }},
  // A knot tightens by up to n[0] mm with the maximum tension so far: 63 % of it n[1] N above the first tension.
  {.split = "tuning", .name = "tightening_knots", .first = 0.1, .most = 1.5,
   .kin = {"tendon_slip"},  // tendon released at a knot
   .place = Place::both_tendons, .parameters = [](const D& d) -> N { return {d.size, d.pretension()}; },
   .act = [](const M& now, const N& n, N& memory) {
     const double tension = now.tension[now.side];
     if (tension <= 0) return memory.empty() ? 0.0 : -n[0] * (1.0 - std::exp(-(memory[1] - memory[0]) / n[1]));
     if (memory.empty()) memory = {tension, tension};
     memory[1] = std::max(memory[1], tension);
     return -n[0] * (1.0 - std::exp(-(memory[1] - memory[0]) / n[1]));
   }},
  // T = E' ε (1 + ε/h): softer than declared at low tension, stiffer at high tension.
  {.split = "tuning", .name = "hardening_tendon", .first = 3.0, .most = 60.0,
   .set = [](H& h, double s, const C&, const J& j) {
     const Tendon& tendon = j.declared.tendon;
     h.hardening = tendon.pretension / (tendon.modulus * 0.25 * k_pi * tendon.diameter * tendon.diameter);
     h.modulus = tendon.modulus / (1.0 + s);
   },
   .kin = {"tendon_stretch"}},

  // A drum without groove: the tendon is perpendicular to its axis only at α = n[1]. Elsewhere its path is longer, by
  // n[0] mm at the distance n[2], with the square of the distance.
  {.split = "regression", .name = "turns_side_by_side", .first = 0.1, .most = 1.5,
   .place = Place::one_tendon, .parameters = [](const D& d) -> N { return {d.size, d.alpha_within(), 0.5 * (d.joint.alpha_max - d.joint.alpha_min)}; },
   .act = [](const M& now, const N& n, N&) {
     const auto squared = [&](double alpha) { return (alpha - n[1]) * (alpha - n[1]) / (n[2] * n[2]); };
     return n[0] * (squared(now.alpha) - squared(0.0));
   }},
  // A knot creeps while its tension rises above n[1] N: n[0] mm per n[1] N of rise. Memory: tension, slip.
  {.split = "regression", .name = "creeping_knot", .first = 0.02, .most = 0.5,
   .kin = {"tendon_slip"},  // slip in small steps
   .place = Place::tendon_2, .parameters = [](const D& d) -> N { return {d.size, 1.3 * d.pretension()}; },
   .act = [](const M& now, const N& n, N& memory) {
     const double tension = now.tension[now.side];
     if (memory.empty()) memory = {tension, 0.0};
     memory[1] += std::max(0.0, std::max(tension, n[1]) - std::max(memory[0], n[1])) / n[1];
     memory[0] = tension;
     return -n[0] * memory[1];
   }},

  // A superelastic tendon is n[0] mm longer (0.2 … 5) once transformed: from n[1] N over n[3] N, and back from n[2] +
  // n[3] down to n[2] N. Memory: the share transformed.
  {.split = "heldout_13", .name = "tendon_changing_its_crystals", .first = 0.3, .most = 3.0,
   .place = Place::both_tendons, .parameters = [](const D& d) -> N { return {d.size, 1.25 * d.pretension(), 0.95 * d.pretension(), 0.4 * d.pretension()}; },
   .act = [](const M& now, const N& n, N& memory) {
     if (memory.empty()) memory = {0.0};
     const auto share = [&](double from) { return std::clamp((now.tension[now.side] - from) / n[3], 0.0, 1.0); };
     return n[0] * (memory[0] = std::clamp(memory[0], share(n[1]), share(n[2])));
   }},
  // A panel that carries the pins snaps over by n[0] mm (0.05 … 1) at n[1] N to the side n[2], and back at a third of
  // that to the other side. Memory: 1 while it is over.
  {.split = "heldout_13", .name = "panel_popping_like_an_oil_can", .first = 0.2, .most = 2.0,
   .place = Place::both_tendons, .parameters = [](const D& d) -> N { return {d.size, (0.2 + 0.3 * d.share) * d.pretension(), d.sign}; },
   .act = [](const M& now, const N& n, N& memory) {
     if (memory.empty()) memory = {0.0};
     const double load = n[2] * now.load / n[1];
     if (load >= 1.0) memory[0] = 1.0;
     if (load <= -1.0 / 3.0) memory[0] = 0.0;
     return -apart(now) * n[2] * n[0] * memory[0];
   }},
  // A lock nut works loose by vibration (Junker): n[0] mm shorter per rad at 1 rad/s, with the square of the speed up
  // to 3 rad/s (1e-4 … 0.05 mm). Memory: α, path times speed squared.
  {.split = "heldout_13", .name = "lock_nut_shaken_loose", .first = 0.01, .most = 0.15,
   .place = Place::one_tendon, .act = [](const M& now, const N& n, N& memory) {
     if (memory.empty()) memory = {now.alpha, 0.0};
     memory[1] += motor_path(now, memory[0]) * std::pow(std::min(3.0, std::abs(now.alpha_speed)), 2);
     return -n[0] * memory[1];
   }},
  // A ferrule slips n[0] mm (0.02 … 0.5) whenever a load above n[1] N is put on. Memory: 1 under load, times so far.
  {.split = "heldout_13", .name = "ferrule_slipping_at_each_jerk", .first = 0.2, .most = 3.0,
   .kin = {"tendon_slip"},  // several slips
   .place = Place::one_tendon, .parameters = [](const D& d) -> N { return {d.size, 0.05 * d.pretension()}; },
   .act = [](const M& now, const N& n, N& memory) {
     if (memory.empty()) memory = {0.0, 0.0};
     const double loaded = std::abs(now.load) > n[1] ? 1.0 : 0.0;
     if (loaded > memory[0]) memory[1] += 1.0;
     memory[0] = loaded;
     return n[0] * memory[1];
   }},
  // A tape on a crowned drum wanders to one side while wound in, to the other while let out: ±n[0] mm (0.05 … 0.5),
  // with the constant n[1] rad of path. Memory: α, place.
  {.split = "heldout_13", .name = "tape_wandering_on_its_drum", .first = 0.2, .most = 2.5,
   .place = Place::one_tendon, .parameters = [](const D& d) -> N { return {d.size, 0.3 + 0.7 * d.share}; },
   .act = [](const M& now, const N& n, N& memory) {
     if (memory.empty()) memory = {now.alpha, 0.0};
     const double path = motor_path(now, memory[0]);
     return n[0] * followed(now.direction, path, n[1], memory[1]);
   }},
  // Galling of dry steel on steel: at last a friction of n[0] N·mm (100 … 3000) at n[1] N in both tendons, 63 % of it
  // after n[2] rad under that pull. Memory: α, work.
  {.split = "heldout_13", .name = "wires_and_pins_galling", .first = 500.0, .most = 8000.0,
   .kin = {"capstan_friction"},  // its final state
   .place = Place::dry_friction, .parameters = [](const D& d) -> N { return {d.size, d.pretension(), 5.0 + 20.0 * d.share}; },
   .act = [](const M& now, const N& n, N& memory) {
     if (memory.empty()) memory = {now.alpha, 0.0};
     const double pull = mean_tension(now) / n[1];
     memory[1] += pull * motor_path(now, memory[0]);
     return n[0] * pull * (1.0 - std::exp(-memory[1] / n[2]));
   }},
  // A compression spring in the tendon: n[0] mm per n[2] N, the pretension (0.2 … 5), until its coils touch at n[1] N.
  {.split = "heldout_13", .name = "buffer_spring_closing_up", .first = 0.15, .most = 2.0,
   .kin = {"tendon_stretch"},  // below the contact force
   .place = Place::both_tendons, .parameters = [](const D& d) -> N { return {d.size, (1.1 + 0.8 * d.share) * d.pretension(), d.pretension()}; },
   .act = [](const M& now, const N& n, N&) { return n[0] * (std::clamp(now.tension[now.side], 0.0, n[1]) / n[2] - 1.0); }},
  // Beyond θ = n[2], towards the side n[3], the far tendon bends over an edge: a friction that rises over n[4] rad to
  // n[0] N·mm at n[1] N (50 … 2000).
  {.split = "heldout_13", .name = "tendon_over_edge_of_cover", .first = 500.0, .most = 10000.0,
   .place = Place::dry_friction, .parameters = [](const D& d) -> N { return {d.size, d.pretension(), d.theta_within(), d.sign, 0.3}; },
   .act = [](const M& now, const N& n, N&) {
     const double pull = std::max(0.0, now.tension[n[3] > 0 ? 0 : 1]) / n[1];
     return n[0] * pull * std::clamp(n[3] * (now.theta - n[2]) / n[4], 0.0, 1.0);
   }},
}; }
// clang-format on

}  // namespace fusee::rig::fault_table
