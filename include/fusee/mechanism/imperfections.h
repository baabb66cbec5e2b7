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
  double profile_sin = 0;             ///< a wave all round: pitch curves further out by sin nψ along the normal ψ of the part, mm
  double profile_cos = 0;             ///< and by cos nψ, mm
  double profile_harmonic = 2;        ///< n

  // Tendon.
  double stretch = 0;                 ///< added compliance as a fraction of the declared one: EA = EA0/(1 + stretch)
  double pretension = 0;              ///< added to that of tendon 1 at home, N
  double slack = 0;                   ///< of both tendons together, beyond what pretension takes up, mm
  double creep = 0;                   ///< compliance added in every decade of time since a run began, as a fraction
  double slip = 0;                    ///< let go by the anchor of tendon 1 (of tendon 2 where negative) at `slip_time`, mm
  double slip_time = 0;               ///< s, on the bench's clock: runs one after another
  double thermal1 = 0;                ///< unloaded length of tendon 1 added per kelvin, as a fraction
  double thermal2 = 0;                ///< of tendon 2: one may lie nearer to what is warm

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
  // Of a joint declared by a ratio, whose tendons are not known; rad.
  double compliance = 0;              ///< turned by a unit of load
  double dry_friction = 0;            ///< half loop per unit of |load|
  double drift = 0;                   ///< turned by a unit of load in every decade of time since a run began
  double step = 0;                    ///< turned at `slip_time`
  double warmth = 0;                  ///< turned by a kelvin

  // Joint sensor: it shows zero + (1 + gain) θ + sin · sin θ + cos · (cos θ − 1), late by `lag`.
  double zero = 0;                    ///< rad
  double gain = 0;
  double joint_eccentricity_sin = 0;  ///< rad
  double joint_eccentricity_cos = 0;  ///< rad
  double lag = 0;                     ///< s

  bool operator==(const Imperfections&) const = default;
};

}  // namespace fusee
