#include <cmath>

#include "rig/faults.h"

namespace fusee::rig {
namespace wide_list {

using namespace short_names;

Fault attachment(const std::string& name, void (*set)(H&, double, const C&, const J&),
                 Numbers (*numbers)(const H&, const J&)) {
  return {.name = name, .first = 0.5, .most = 4.0, .set = set, .kin = {"guide_position"}, .numbers = numbers};
}

template <std::size_t tendon>
void move_end(H& h, double size, const C& c, const J&) {
  h.end_moved[tendon] = size * Vec2(std::cos(c.angle), std::sin(c.angle));
}
template <std::size_t tendon>
Numbers end_numbers(const H& h, const J&) {
  return {{"across_mm", h.end_moved[tendon].x()}, {"along_mm", h.end_moved[tendon].y()}};
}

}  // namespace wide_list

// clang-format off
std::vector<Fault> wide_faults() {
  using namespace wide_list;
  return {
      {.name = "drum_radius", .first = 0.1, .most = 1.0,
       .set = [](H& h, double s, const C& c, const J&) { h.drum_radius = c.sign * s; },
       .kin = {"joint_sensor_gain", "radius_offset", "pulley_scale"},  // a ratio, all of them
       .numbers = [](const H& h, const J& j) -> Numbers { return {{"radius_mm", j.declared.joint.drum_radius + h.drum_radius}}; }},
      {.name = "drum_runout", .first = 0.1, .most = 1.0,
       .set = [](H& h, double s, const C& c, const J&) { h.drum_runout = s, h.drum_runout_phase = c.angle; },
       .kin = {"joint_sensor_eccentricity"},  // once a turn of the same link
       .numbers = [](const H& h, const J&) -> Numbers {
         return {{"across_mm", h.drum_runout * std::cos(h.drum_runout_phase)}, {"along_mm", h.drum_runout * std::sin(h.drum_runout_phase)}};
       }},
      attachment("attachment1_place", move_end<0>, end_numbers<0>),
      attachment("attachment2_place", move_end<1>, end_numbers<1>),
      {.name = "idler_friction", .first = 0.1, .most = 1.5,
       .set = [](H& h, double s, const C&, const J&) { h.bearing_friction = s; },
       .kin = {"joint_friction"},  // dry friction against the joint's motion
       .numbers = [](const H& h, const J& j) -> Numbers { return {{"mu", j.declared.guides.bearing_friction + h.bearing_friction}}; }},
      {.name = "sheath_friction", .first = 0.1, .most = 0.8,
       .set = [](H& h, double s, const C&, const J&) { h.sheath_friction = s; },
       .kin = {"capstan_friction"},
       .numbers = [](const H& h, const J& j) -> Numbers { return {{"mu_bend", j.declared.sheath.mu * j.declared.sheath.bend + h.sheath_friction}}; }},
      {.name = "sheath_stiffness", .first = 0.01, .most = 0.1,
       .set = [](H& h, double s, const C&, const J&) { h.sheath_give = s; },
       .kin = {"tendon_stretch", "frame_compliance"},  // springs along the tendon
       .numbers = [](const H& h, const J& j) -> Numbers {
         const double stiffness = j.declared.sheath.stiffness;
         return {{"mm_per_N", (stiffness > 0 ? 1.0 / stiffness : 0.0) + h.sheath_give}};
       }},
  };
}
// clang-format on

}  // namespace fusee::rig
