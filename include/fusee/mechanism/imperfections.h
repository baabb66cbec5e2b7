/// \file
/// By how much a joint is not as declared: one number for each way in which it can differ. All zero: as declared.
///
/// In the order of the chain motor sensor → shaft → pulley → tendon → pins → joint → joint sensor. rad, mm, N, s.
#pragma once

namespace fusee {

struct Imperfections {
  // Motor sensor: the shaft stands at α + offset + sin · sin α + cos · (cos α − 1).
  double motor_offset = 0;            ///< rad
  double motor_eccentricity_sin = 0;  ///< rad
  double motor_eccentricity_cos = 0;  ///< rad

  // Between shaft and pulley.
  double backlash = 0;                ///< full width, rad of α

  // Pulley, both halves alike.
  double radius_offset = 0;           ///< pitch curves further out by this all round, mm
  double pulley_scale = 0;            ///< pitch curves larger by this fraction
  double runout_x = 0;                ///< centre of the pitch curves off the axis, at home, mm
  double runout_y = 0;                ///< mm
  double profile_sin = 0;             ///< tendon wound too far twice per turn, as an angle: sin 2α, rad
  double profile_cos = 0;             ///< cos 2α − 1, rad

  // Tendon.
  double stretch = 0;                 ///< added compliance as a fraction of the declared one: EA = EA0/(1 + stretch)
  double pretension = 0;              ///< added to that of tendon 1 at home, N
  double slack = 0;                   ///< of both tendons together, beyond what pretension takes up, mm
  double creep = 0;                   ///< turned by the load in every decade of time, rad per unit of load
  double slip = 0;                    ///< step of θ from `slip_time` on, rad
  double slip_time = 0;               ///< s, on the measurement's clock
  double thermal = 0;                 ///< rad per K

  // Pins.
  double friction = 0;                ///< added to the capstan coefficient
  double guide_radius = 0;            ///< added to the pins' radius, mm
  double guide_outward = 0;           ///< both pins further from the middle, mm
  double guide_down = 0;              ///< both pins further from the joint, mm

  // Joint.
  double joint_length = 0;            ///< added to OC, mm
  double gravity_cos = 0;             ///< torque against +θ: cos · cos θ + sin · sin θ, N·mm
  double gravity_sin = 0;
  double mean_load = 0;               ///< tip force beside the declared one, under which the joint is to follow its law, N
  double compliance = 0;              ///< of a joint declared by a ratio: turned by the load, rad per unit of load
  double dry_friction = 0;            ///< of a joint declared by a ratio: half loop per unit of |load|, rad

  // Joint sensor: it shows zero + (1 + gain) θ + sin · sin θ + cos · (cos θ − 1), late by `lag`.
  double zero = 0;                    ///< rad
  double gain = 0;
  double joint_eccentricity_sin = 0;  ///< rad
  double joint_eccentricity_cos = 0;  ///< rad
  double lag = 0;                     ///< s

  bool operator==(const Imperfections&) const = default;
};

}  // namespace fusee
