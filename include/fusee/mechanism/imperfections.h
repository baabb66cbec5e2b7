/// \file
/// Deviations of a joint from its declaration, in the order of the chain: motor sensor → shaft → pulley → tendon →
/// sheath → pins → joint → joint sensor. All zero: as declared. rad, mm, N, s.
///
/// Deviations that act together are grouped, so that sums, caches and corrections take parts rather than lists of
/// numbers. effect.h assigns the numbers to effects.
#pragma once

#include <algorithm>
#include <cmath>

namespace fusee {

/// When the sensor reads α, the shaft is at α + offset + sin · sin α + cos · (cos α − 1), plus a harmonic of the same
/// form in nα. rad
struct MotorSensorError {
  double offset = 0;
  double eccentricity_sin = 0;
  double eccentricity_cos = 0;
  double wave_sin = 0;
  double wave_cos = 0;
  double wave_order = 2;  ///< n

  bool operator==(const MotorSensorError&) const = default;
};

/// Play between shaft and pulley.
struct ShaftError {
  double backlash = 0;  ///< full width, rad of α

  bool operator==(const ShaftError&) const = default;
};

/// Deviation of both pulleys' pitch curves from the drawing. Drawing the opposite deviation corrects it.
struct OutlineError {
  double offset = 0;    ///< outward offset of the whole curve, mm
  double runout_x = 0;  ///< eccentricity of the centre, at home, mm
  double runout_y = 0;
  double wave_sin = 0;    ///< harmonic: outward offset sin nψ along the part's normal ψ, mm
  double wave_cos = 0;    ///< coefficient of cos nψ, mm
  double wave_order = 2;  ///< n

  bool operator==(const OutlineError&) const = default;
};

struct PulleyError {
  OutlineError outline;
  double scale = 0;  ///< relative enlargement of the pitch curves

  bool operator==(const PulleyError&) const = default;
};

/// Compliance of a wavy cable. A cable that is not straight is longer by the length of its waves. Tension straightens
/// it and gains most · x/(1 + x) with x = rate · pull. Units: rad and units of load for a joint declared by a ratio, mm
/// and N for a tendon.
struct CableStiffening {
  double most = 0;  ///< limit of the gained length, with all waves straightened
  double rate = 0;  ///< half of `most` is gained at a pull of 1/rate

  /// Length gained under `pull`; odd, since the cable of the other side takes a negative pull.
  double gained(double pull) const {
    const double x = rate * pull;
    return most * x / (1.0 + std::abs(x));
  }

  /// Derivative of gained(). rad or mm per unit of pull
  double slope(double pull) const {
    const double straight = 1.0 + std::abs(rate * pull);
    return most * rate / (straight * straight);
  }
  /// Work stored by a pull from zero to `pull` ≥ 0.
  double energy(double pull) const {
    if (!(rate > 0)) return 0;
    const double x = rate * pull;
    return most / rate * (std::log1p(x) - x / (1.0 + x));
  }

  bool operator==(const CableStiffening&) const = default;
};

struct TendonError {
  double stretch = 0;  ///< added compliance as a fraction of the declared one: EA = EA0/(1 + stretch)
  /// Added to the pretension of tendon 1 at home, N; without effect where tendons hang loose.
  double pretension = 0;
  double slack = 0;            ///< of both tendons together, beyond the length that pretension takes up, mm
  double creep = 0;            ///< relative compliance added per decade of time under tension
  double slip = 0;             ///< length released by the anchor of tendon 1 (tendon 2 if negative) at `slip_time`, mm
  double slip_time = 0;        ///< s, on the bench clock: runs in sequence
  double thermal1 = 0;         ///< relative elongation of unloaded tendon 1 per kelvin
  double thermal2 = 0;         ///< for tendon 2: one may be nearer to a heat source
  double groove_friction = 0;  ///< added to the coefficient between tendon and groove
  CableStiffening waves = {};  ///< waves of each tendon between pin and joint, mm and N

  /// Fraction of the pretension that remains with slack: zero, except for a ramp over the first micrometre, so that a
  /// fit meets no jump.
  double pretension_share() const { return std::clamp(1.0 - slack / 1e-3, 0.0, 1.0); }

  bool operator==(const TendonError&) const = default;
};

/// Deviation of both sheaths.
struct SheathError {
  double friction = 0;  ///< added to friction coefficient × total bend: ln of a tension ratio
  double give = 0;      ///< added to the axial compliance of a sheath, mm/N

  bool operator==(const SheathError&) const = default;
};

struct PinPlaceError {
  double outward = 0;  ///< further from the middle, mm
  double down = 0;     ///< further from the joint, mm; the pulley axis does not move

  bool operator==(const PinPlaceError&) const = default;
};

struct PinError {
  PinPlaceError left;
  PinPlaceError right;
  double radius = 0;            ///< added to the radius of both pins, mm
  double friction = 0;          ///< added to the capstan coefficient; for idlers, to that of their bearings
  double bearing_friction = 0;  ///< added to the coefficient of idlers' bearings
  double give = 0;              ///< displacement of each pin along the tendon's force on it, mm/N

  bool operator==(const PinError&) const = default;
};

/// Additional torque against +θ: cos · cos θ + sin · sin θ, N·mm.
struct WeightError {
  double cos = 0;
  double sin = 0;

  bool operator==(const WeightError&) const = default;
};

/// Deviation of the joint's drum, which is fixed to the link.
struct DrumError {
  double radius = 0;  ///< added to the radius, mm
  double across = 0;  ///< centre of the drum off the joint's axis, in the link at home, to the right, mm
  double along = 0;   ///< the same along OC

  bool operator==(const DrumError&) const = default;
};

/// Offset of a tendon's end from its declared attachment, in the link at home. mm
struct AttachmentError {
  double across = 0;  ///< to the right
  double along = 0;   ///< along OC

  bool operator==(const AttachmentError&) const = default;
};

/// Additional length of a tendon's path: slope · θ + square · θ² + cube · θ³, with θ towards its own side. Represents
/// unmodelled geometry, such as a flexure whose centre moves, or a cord that leaves its drum obliquely.
struct PathError {
  double slope = 0;   ///< mm/rad
  double square = 0;  ///< mm/rad²
  double cube = 0;    ///< mm/rad³

  bool operator==(const PathError&) const = default;
};

/// Tension of both tendons at which RubbingError is defined, N.
constexpr double k_usual_pull = 10.0;

/// Dry friction by laws outside the effect catalogue, as torque on the joint at k_usual_pull, N·mm.
struct RubbingError {
  /// Proportional to the power 2/3 of each tension, as for soft fibres on polished pins (Howell)
  double by_area = 0;
  double by_lesser = 0;  ///< proportional to the smaller tension, as for two tendons that rub on each other

  bool operator==(const RubbingError&) const = default;
};

struct JointError {
  double length = 0;    ///< added to OC, mm
  double friction = 0;  ///< dry friction of the bearing, N·mm
  RubbingError rubbing;
  DrumError drum;
  AttachmentError end1;
  AttachmentError end2;
  PathError path1;
  PathError path2;
  WeightError weight;
  double mean_load = 0;  ///< tip force beyond the declared one at which the joint must follow its target motion, N

  bool operator==(const JointError&) const = default;
};

/// Friction that a pull must overcome before the joint turns, averaged along the cable.
struct CableFriction {
  double share = 0;     ///< fraction of the load
  double unloaded = 0;  ///< additional friction due to the unloaded cable tension, in units of load

  double at(double load) const { return unloaded + share * std::abs(load); }

  bool operator==(const CableFriction&) const = default;
};

/// A ratio and a compliance that change with the angle, for example through a linkage behind the cable. u: rotation of
/// the joint from home by the declared ratio, rad.
struct RatioCurve {
  double square = 0;       ///< coefficient of u² in the rotation, 1/rad
  double cube = 0;         ///< coefficient of u³, 1/rad²
  double give_slope = 0;   ///< compliance per u, 1 per unit of load
  double give_square = 0;  ///< compliance per u², 1/rad per unit of load

  /// Rotation beyond u under `load`, rad.
  double added(double u, double load) const {
    return u * (u * (square + u * cube) - load * (give_slope + u * give_square));
  }

  bool operator==(const RatioCurve&) const = default;
};

/// Deviations of a joint declared by a ratio, whose tendons are unknown. rad.
struct RatioJointError {
  RatioCurve curve;
  double compliance = 0;      ///< rotation per unit of load
  CableStiffening waves;      ///< rotation as a wavy cable straightens
  CableFriction friction;     ///< friction of the cable along its path
  double drift = 0;           ///< rotation per unit of load per decade of time
  double slack = 0;           ///< play of α, full width, without load; divided by 1 + slack_taken_up · |load|
  double slack_taken_up = 0;  ///< per unit of load
  double step = 0;            ///< rotation at TendonError::slip_time
  double warmth = 0;          ///< rotation per kelvin

  bool operator==(const RatioJointError&) const = default;
};

/// Reading: zero + (1 + gain) θ + sin · sin θ + cos · (cos θ − 1), plus a harmonic of the same form in nθ, delayed by
/// `lag`.
struct JointSensorError {
  double zero = 0;  ///< rad
  double gain = 0;
  double eccentricity_sin = 0;  ///< rad
  double eccentricity_cos = 0;  ///< rad
  double wave_sin = 0;          ///< rad
  double wave_cos = 0;          ///< rad
  double wave_order = 2;        ///< n
  double lag = 0;               ///< s
  double first_order = 0;       ///< 0: pure delay; 1: first-order filter with that time constant

  bool operator==(const JointSensorError&) const = default;
};

struct Imperfections {
  MotorSensorError motor;
  ShaftError shaft;
  PulleyError pulley;
  TendonError tendon;
  SheathError sheath;
  PinError pins;
  JointError joint;
  RatioJointError ratio_joint;
  JointSensorError sensor;

  bool operator==(const Imperfections&) const = default;
};

}  // namespace fusee
