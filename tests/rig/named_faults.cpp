#include <cmath>

#include "rig/faults.h"

namespace fusee::rig {
namespace named_list {

using namespace short_names;

double percent(double share) { return 100.0 * share; }

Numbers wave(double amplitude, double phase, const char* sin_name = "sin_deg", const char* cos_name = "cos_deg") {
  return {{sin_name, degrees(amplitude * std::cos(phase))}, {cos_name, degrees(amplitude * std::sin(phase))}};
}

double section(const J& j) {
  const double d = j.declared.tendon.diameter;
  return 0.25 * k_pi * d * d;
}

int order_of(const C& c) { return c.share < 0.7 ? 2 : 3; }

/// One pin in three by itself, both differently in the rest.
void move_pins(H& h, double s, const C& c) {
  const auto side = c.sign > 0 ? 1u : 0u;
  h.pin_outward[side] = s * std::cos(c.angle);
  h.pin_down[side] = s * std::sin(c.angle);
  if (c.share < 1.0 / 3.0) return;
  const double other = c.angle + k_two_pi * c.share;
  h.pin_outward[1 - side] = 0.7 * s * std::cos(other);
  h.pin_down[1 - side] = 0.7 * s * std::sin(other);
}

// clang-format off
std::vector<Fault> motor_faults() {
  return {
      {.name = "motor_offset", .first = 0.01, .most = 0.2,
       .set = [](H& h, double s, const C& c, const J&) { h.motor_offset = c.sign * s; },
       .kin = {"zero_offset"},  // told apart by the transmission's slope alone
       .numbers = [](const H& h, const J&) -> Numbers { return {{"offset_deg", degrees(h.motor_offset)}}; }},
      {.name = "motor_sensor_eccentricity", .first = 0.01, .most = 0.2,
       .set = [](H& h, double s, const C& c, const J&) { h.motor_eccentricity = s, h.motor_eccentricity_phase = c.angle; },
       .kin = {"pulley_runout"},  // once a turn of the same shaft
       .numbers = [](const H& h, const J&) { return wave(h.motor_eccentricity, h.motor_eccentricity_phase); }},
      {.name = "motor_sensor_harmonic", .first = 0.01, .most = 0.2,
       .set = [](H& h, double s, const C& c, const J&) { h.motor_harmonic = s, h.motor_harmonic_phase = c.angle, h.motor_harmonic_order = order_of(c); },
       .kin = {"profile_error"},  // as often a turn of the same shaft
       .numbers = [](const H& h, const J&) {
         Numbers all = wave(h.motor_harmonic, h.motor_harmonic_phase);
         all.emplace_back("harmonic", h.motor_harmonic_order);
         return all;
       }},
      {.name = "backlash", .first = 0.02, .most = 0.2,
       .set = [](H& h, double s, const C&, const J&) { h.backlash = s; },
       .kin = {"slack"},  // lost motion
       .numbers = [](const H& h, const J&) -> Numbers { return {{"width_deg", degrees(h.backlash)}}; }},
  };
}

std::vector<Fault> pulley_faults() {
  return {
      {.name = "radius_offset", .first = 0.1, .most = 1.0,
       .set = [](H& h, double s, const C& c, const J&) { h.radius_offset = c.sign * s; },
       .kin = {"pulley_scale"},  // the same on a round pulley
       .numbers = [](const H& h, const J&) -> Numbers { return {{"offset_mm", h.radius_offset}}; }},
      {.name = "pulley_scale", .first = 0.01, .most = 0.06,
       .set = [](H& h, double s, const C& c, const J&) { h.pulley_scale = c.sign * s; },
       .kin = {"radius_offset"},
       .numbers = [](const H& h, const J&) -> Numbers { return {{"scale_percent", percent(h.pulley_scale)}}; }},
      {.name = "pulley_runout", .first = 0.1, .most = 1.5,
       .set = [](H& h, double s, const C& c, const J&) { h.runout_x = s * std::cos(c.angle), h.runout_y = s * std::sin(c.angle); },
       .kin = {"motor_sensor_eccentricity"},
       .numbers = [](const H& h, const J&) -> Numbers { return {{"x_mm", h.runout_x}, {"y_mm", h.runout_y}}; }},
      {.name = "profile_error", .first = 0.05, .most = 0.3,
       .set = [](H& h, double s, const C& c, const J&) { h.profile_error = s, h.profile_phase = c.angle, h.profile_harmonic = c.share < 0.5 ? 2 : 3; },
       .kin = {"motor_sensor_harmonic"},
       .numbers = [](const H& h, const J&) -> Numbers {
         return {{"sin_mm", -h.profile_error * std::sin(h.profile_phase)}, {"cos_mm", h.profile_error * std::cos(h.profile_phase)},
                 {"harmonic", h.profile_harmonic}};
       }},
      // From polished to gripping; a groove of 50° has 2.4 times the friction of its material.
      {.name = "groove_friction", .first = 0.15, .most = 0.3,
       .set = [](H& h, double s, const C& c, const J&) { h.groove_friction = c.sign > 0 ? 0.2 + s : std::max(0.05, 0.2 - 0.5 * s); },
       .numbers = [](const H& h, const J&) -> Numbers { return {{"mu", h.groove_friction}}; },
       .least_seen = 0.5},
  };
}

std::vector<Fault> tendon_faults() {
  return {
      {.name = "tendon_stretch", .first = 1.0, .most = 12.0,
       .set = [](H& h, double s, const C&, const J& j) { h.modulus = j.declared.tendon.modulus / (1.0 + s); },
       .kin = {"frame_compliance"},  // in proportion to the tension, both
       .numbers = [](const H& h, const J& j) -> Numbers { return {{"EA_N", h.modulus * section(j)}}; }},
      {.name = "slack", .first = 0.1, .most = 3.0,
       .set = [](H& h, double s, const C&, const J&) { h.slack = s; },
       .kin = {"backlash"},
       .numbers = [](const H& h, const J&) -> Numbers { return {{"slack_mm", h.slack}}; }},
      {.name = "creep", .first = 0.1, .most = 1.5,
       .set = [](H& h, double s, const C&, const J&) { h.creep = s; },
       .numbers = [](const H& h, const J&) -> Numbers { return {{"compliance_percent_per_decade", percent(h.creep)}}; }},
      {.name = "tendon_slip", .first = 0.1, .most = 2.0,
       .set = [](H& h, double s, const C& c, const J&) { h.slip = s, h.slip_side = 1, h.slip_run = 1, h.slip_at = 0.3 + 0.4 * c.share; }},
      {.name = "thermal_expansion", .first = 2e-5, .most = 4e-4,
       .set = [](H& h, double s, const C&, const J&) { h.expansion = s; },
       .numbers = [](const H& h, const J&) -> Numbers {
         return {{"tendon1_ppm_per_K", 1e6 * h.expansion * h.expansion_other}, {"tendon2_ppm_per_K", 1e6 * h.expansion}};
       }},
  };
}

std::vector<Fault> pin_faults() {
  return {
      {.name = "capstan_friction", .first = 0.2, .most = 1.5,
       .set = [](H& h, double s, const C&, const J&) { h.friction = s; },
       .kin = {"joint_friction"},  // dry friction against the joint's motion
       .numbers = [](const H& h, const J& j) -> Numbers { return {{"mu", j.declared.guides.mu + h.friction}}; }},
      {.name = "guide_radius", .first = 0.5, .most = 6.0,
       .set = [](H& h, double s, const C&, const J&) { h.guide_radius = s; },
       .kin = {"guide_position"},  // a thicker pin stands further out
       .numbers = [](const H& h, const J& j) -> Numbers { return {{"radius_mm", j.declared.guides.radius + h.guide_radius}}; }},
      {.name = "guide_position", .first = 0.5, .most = 4.0,
       .set = [](H& h, double s, const C& c, const J&) { move_pins(h, s, c); },
       .kin = {"guide_radius", "joint_length"},
       .numbers = [](const H& h, const J&) -> Numbers {
         return {{"outward1_mm", h.pin_outward[0]}, {"down1_mm", h.pin_down[0]}, {"outward2_mm", h.pin_outward[1]}, {"down2_mm", h.pin_down[1]}};
       }},
      {.name = "frame_compliance", .first = 1e-3, .most = 0.2,
       .set = [](H& h, double s, const C&, const J&) { h.frame_give = s; },
       .kin = {"tendon_stretch"},
       .numbers = [](const H& h, const J&) -> Numbers { return {{"mm_per_N", h.frame_give}}; }},
  };
}

std::vector<Fault> joint_faults() {
  return {
      {.name = "joint_length", .first = 0.5, .most = 6.0,
       .set = [](H& h, double s, const C& c, const J&) { h.joint_length = c.sign * s; },
       .kin = {"guide_position", "joint_sensor_gain"},  // smooth in θ, near to a proportion
       .numbers = [](const H& h, const J& j) -> Numbers { return {{"length_mm", j.declared.joint.R + h.joint_length}}; }},
      {.name = "gravity", .first = 300.0, .most = 20000.0,
       .set = [](H& h, double s, const C& c, const J&) { h.gravity = s, h.gravity_direction = c.angle; },
       .numbers = [](const H& h, const J&) -> Numbers {
         return {{"cos_Nmm", h.gravity * std::sin(h.gravity_direction)}, {"sin_Nmm", -h.gravity * std::cos(h.gravity_direction)}};
       }},
      {.name = "joint_friction", .first = 20.0, .most = 4000.0,
       .set = [](H& h, double s, const C&, const J&) { h.bearing = s; },
       .kin = {"capstan_friction"},
       .numbers = [](const H& h, const J&) -> Numbers { return {{"torque_Nmm", h.bearing}}; }},
      {.name = "zero_offset", .first = 0.002, .most = 0.05,
       .set = [](H& h, double s, const C& c, const J&) { h.zero = c.sign * s; },
       .kin = {"motor_offset"},
       .numbers = [](const H& h, const J&) -> Numbers { return {{"offset_deg", degrees(h.zero)}}; }},
      {.name = "joint_sensor_gain", .first = 0.005, .most = 0.1,
       .set = [](H& h, double s, const C& c, const J&) { h.gain = c.sign * s; },
       .kin = {"pulley_scale", "joint_length"},  // in proportion to θ, nearly
       .numbers = [](const H& h, const J&) -> Numbers { return {{"gain_percent", percent(h.gain)}}; }},
      {.name = "joint_sensor_eccentricity", .first = 0.01, .most = 0.2,
       .set = [](H& h, double s, const C& c, const J&) { h.joint_eccentricity = s, h.joint_eccentricity_phase = c.angle; },
       .kin = {"joint_sensor_gain"},  // its slope
       .numbers = [](const H& h, const J&) { return wave(h.joint_eccentricity, h.joint_eccentricity_phase); }},
      {.name = "joint_sensor_harmonic", .first = 0.005, .most = 0.2,
       .set = [](H& h, double s, const C& c, const J&) { h.joint_harmonic = s, h.joint_harmonic_phase = c.angle, h.joint_harmonic_order = order_of(c); },
       .kin = {"joint_sensor_eccentricity"},  // over a sixth of a turn
       .numbers = [](const H& h, const J&) {
         Numbers all = wave(h.joint_harmonic, h.joint_harmonic_phase);
         all.emplace_back("harmonic", h.joint_harmonic_order);
         return all;
       }},
      {.name = "sensor_lag", .first = 0.02, .most = 0.5,
       .set = [](H& h, double s, const C& c, const J&) { (c.share < 0.5 ? h.lag : h.lag_filter) = s; },
       .numbers = [](const H& h, const J&) -> Numbers { return {{"lag_ms", 1e3 * (h.lag + h.lag_filter)}}; }},
  };
}
// clang-format on

}  // namespace named_list

std::vector<Fault> named_faults() {
  using namespace named_list;
  return joined({motor_faults(), pulley_faults(), tendon_faults(), pin_faults(), joint_faults()});
}

}  // namespace fusee::rig
