// Faults of the motor's sensor, the motor, its gear and the shaft.
#include "rig/fault_table.h"

namespace fusee::rig::fault_table {

// clang-format off
std::vector<Fault> motor_faults() { return {
  {.split = "named", .name = "motor_offset", .first = 0.01, .most = 0.2,
   .set = [](H& h, double s, const C& c, const J&) { h.motor_offset = c.sign * s; },
   .kin = {"zero_offset"},  // only the slope of the transmission separates them
   .numbers = [](const H& h, const J&) -> Numbers { return {{"offset_deg", degrees(h.motor_offset)}}; }},
  {.split = "named", .name = "motor_sensor_eccentricity", .first = 0.01, .most = 0.2,
   .set = [](H& h, double s, const C& c, const J&) { h.motor_eccentricity = s, h.motor_eccentricity_phase = c.angle; },
   .kin = {"pulley_runout"},  // one period per turn of the same shaft
   .numbers = [](const H& h, const J&) { return wave(h.motor_eccentricity, h.motor_eccentricity_phase); }},
  {.split = "named", .name = "motor_sensor_harmonic", .first = 0.01, .most = 0.2,
   .set = [](H& h, double s, const C& c, const J&) { h.motor_harmonic = s, h.motor_harmonic_phase = c.angle, h.motor_harmonic_order = order_of(c); },
   .kin = {"profile_error"},  // same order, same shaft
   .numbers = [](const H& h, const J&) { return wave(h.motor_harmonic, h.motor_harmonic_phase, h.motor_harmonic_order); }},
  {.split = "named", .name = "backlash", .first = 0.02, .most = 0.2,
   .set = [](H& h, double s, const C&, const J&) { h.backlash = s; },
   .kin = {"slack"},  // lost motion
   .numbers = [](const H& h, const J&) -> Numbers { return {{"width_deg", degrees(h.backlash)}}; }},

  {.split = "tuning", .name = "motor_cogging", .first = 0.005, .most = 0.2,
   .set = [](H& h, double s, const C&, const J&) { h.cogging = s; },
   .kin = {"motor_sensor_harmonic"}},  // periodic in the same shaft
  // Error of a gear with a non-integer ratio, 3.7 periods a turn. n: amplitude, phase.
  {.split = "tuning", .name = "gearbox_error", .first = 0.005, .most = 0.2,
   .kin = {"motor_sensor_harmonic"},  // over half a turn, order 3.7 resembles order 4
   .place = Place::shaft, .parameters = [](const D& d) -> N { return {d.size, d.angle}; },
   .act = [](const M& now, const N& n, N&) { return n[0] * (std::sin(3.7 * now.alpha + n[1]) - std::sin(n[1])); }},
  // A set screw holds until the shaft is twisted by n[0] rad, then slips back by n[0]. Memory: α, twist.
  {.split = "tuning", .name = "jumping_hub", .first = 0.01, .most = 0.2,
   .kin = {"backlash"},  // lost motion between shaft and pulley
   .place = Place::shaft, .act = [](const M& now, const N& n, N& memory) {
     if (memory.empty()) memory = {now.alpha, 0.0};
     memory[1] = std::fmod(memory[1] + (now.alpha - memory[0]), n[0]);
     memory[0] = now.alpha;
     return -memory[1];
   }},
  // While α rises faster than n[0] rad/s, the counter of the motor loses the share n[1] of its counts. Memory: loss.
  {.split = "tuning", .name = "lost_counts", .first = 1e-3, .most = 0.05,
   .kin = {"motor_offset"},  // afterwards an offset of the motor's sensor
   .place = Place::shaft, .parameters = [](const D& d) -> N { return {radians(50.0), d.size}; },
   .act = [](const M& now, const N& n, N& memory) {
     if (memory.empty()) memory = {0.0};
     if (now.alpha_speed > n[0]) memory[0] += n[1] * now.alpha_speed * now.seconds;
     return memory[0];
   }},
  {.split = "tuning", .name = "bedding_in", .first = 0.02, .most = 0.3,
   .set = [](H& h, double s, const C& c, const J&) { h.bedding = c.sign * s; }},

  // A magnetic coupling lags by n[0] asin(load / n[1]) rad. n[0]: one over the pole pairs, 1/20 … 1/4. n[1]: load at
  // which it slips, N.
  {.split = "heldout_13", .name = "magnets_for_coupling_leaning", .first = 0.02, .most = 0.25,
   .kin = {"tendon_stretch"},  // small loads
   .place = Place::shaft, .parameters = [](const D& d) -> N { return {d.size, (2.0 + 2.0 * d.share) * d.pretension()}; },
   .act = [](const M& now, const N& n, N&) { return -n[0] * std::asin(std::clamp(now.load / n[1], -0.98, 0.98)); }},
  // A proportionally controlled direct drive whose torque constant has n[2] waves a turn, phase n[3]: its error under
  // n[1] N varies by n[0] rad (0.1 … 2 deg).
  {.split = "heldout_13", .name = "motor_of_uneven_force", .first = 0.01, .most = 0.15,
   .place = Place::shaft, .parameters = [](const D& d) -> N { return {d.size, d.pretension(), 3.0 + std::floor(11.9 * d.share), d.angle}; },
   .act = [](const M& now, const N& n, N&) { return -n[0] * now.load / n[1] * std::sin(n[2] * now.alpha + n[3]); }},
  // A split anti-backlash gear: a load to the side n[2] beats its spring between n[1] N and 1.25 n[1] N, and the shaft
  // falls back by the play n[0] rad (0.2 … 2 deg).
  {.split = "heldout_13", .name = "split_gear_pushed_open", .first = 0.01, .most = 0.12,
   .place = Place::shaft, .parameters = [](const D& d) -> N { return {d.size, (0.2 + 0.4 * d.share) * d.pretension(), d.sign}; },
   .act = [](const M& now, const N& n, N&) { return -n[2] * n[0] * std::clamp((n[2] * now.load / n[1] - 1.0) / 0.25, 0.0, 1.0); }},
  // Hysteresis of a strain wave gear's twist: n[0] rad to either side (0.02 … 0.5 deg), reversed once the load has
  // changed by twice n[2] of n[1] N. Memory: the load followed.
  {.split = "heldout_13", .name = "strain_wave_gear_rubbing_within", .first = 5e-3, .most = 0.08,
   .place = Place::shaft, .parameters = [](const D& d) -> N { return {d.size, d.pretension(), 0.1}; },
   .act = [](const M& now, const N& n, N& memory) {
     if (memory.empty()) memory = {0.0};
     const double load = now.load / n[1];
     return n[0] * (load - behind(load, n[2], memory[0])) / n[2];
   }},
  // A worm shortens as it cools and turns its wheel: n[0] rad/K (5e-5 … 3e-3, printed).
  {.split = "heldout_13", .name = "worm_shrinking_in_cold", .first = 5e-4, .most = 0.01,
   .kin = {"thermal_expansion"},  // of tendons at different temperatures
   .place = Place::shaft, .parameters = [](const D& d) -> N { return {d.sign * d.size}; },
   .act = [](const M& now, const N& n, N&) { return n[0] * now.warmth; }},
  // A vee belt sinks into its smaller wheel under load of either sign: the ratio changes by n[0] at n[1] N (0.001 …
  // 0.03).
  {.split = "heldout_13", .name = "vee_belt_sinking_into_its_wheel", .first = 0.01, .most = 0.15,
   .place = Place::shaft, .parameters = [](const D& d) -> N { return {d.size, d.pretension()}; },
   .act = [](const M& now, const N& n, N&) { return -n[0] * now.alpha * std::abs(now.load) / n[1]; }},
  // A plain bearing with oil: the shaft's centre follows Sommerfeld's half circle, 2 ε √(1 − ε²) n[0] mm to the side
  // with ε = 1 / (1 + speed / n[1]); one tendon gets longer, the other shorter (0.02 … 0.5 mm).
  {.split = "heldout_13", .name = "shaft_carried_aside_by_oil", .first = 0.1, .most = 1.5,
   .place = Place::both_tendons, .parameters = [](const D& d) -> N { return {d.sign * d.size, 0.2 + 1.8 * d.share}; },
   .act = [](const M& now, const N& n, N&) {
     const double low = 1.0 / (1.0 + std::abs(now.alpha_speed) / n[1]);
     return apart(now) * n[0] * sign_of(now.alpha_speed) * 2.0 * low * std::sqrt(1.0 - low * low);
   }},
}; }
// clang-format on

}  // namespace fusee::rig::fault_table
