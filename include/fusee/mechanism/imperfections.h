/// \file
/// By how much a joint is not as declared, part by part in the order of the chain: motor sensor → shaft → pulley →
/// tendon → sheath → pins → joint → joint sensor. All zero: as declared. rad, mm, N, s.
///
/// What acts together stands together: sums, caches and corrections take parts, never lists of numbers. Which of these
/// numbers belong to which cause says effect.h.
#pragma once

#include <algorithm>
#include <cmath>

namespace fusee {

/// The shaft stands at α + offset + sin · sin α + cos · (cos α − 1), and a wave of the same kind in nα, where the
/// sensor shows α. rad
struct MotorSensorError {
  double offset = 0;
  double eccentricity_sin = 0;
  double eccentricity_cos = 0;
  double wave_sin = 0;
  double wave_cos = 0;
  double wave_order = 2;  ///< n

  bool operator==(const MotorSensorError&) const = default;
};

/// Between shaft and pulley.
struct ShaftError {
  double backlash = 0;  ///< full width, rad of α

  bool operator==(const ShaftError&) const = default;
};

/// How the pitch curves of both pulleys lie in the part beside where they were drawn. Drawing them the other way undoes
/// it.
struct OutlineError {
  double offset = 0;    ///< further out all round, mm
  double runout_x = 0;  ///< their centre off the axis, at home, mm
  double runout_y = 0;
  double wave_sin = 0;    ///< a wave all round: further out by sin nψ along the normal ψ of the part, mm
  double wave_cos = 0;    ///< and by cos nψ, mm
  double wave_order = 2;  ///< n

  bool operator==(const OutlineError&) const = default;
};

struct PulleyError {
  OutlineError outline;
  double scale = 0;  ///< pitch curves larger by this fraction

  bool operator==(const PulleyError&) const = default;
};

/// A cable that does not lie straight is longer by the way that its waves take. A pull straightens them: it gains
/// most · x/(1 + x) with x = rate · pull. Radians and units of load of a joint declared by a ratio; mm and N of a
/// tendon.
struct CableStiffening {
  double most = 0;  ///< gained under any pull, the waves gone
  double rate = 0;  ///< of straightening: half of it is gained at a pull of 1/rate

  /// Gained under `pull`; odd, since the cable of the other side takes a pull the other way.
  double gained(double pull) const {
    const double x = rate * pull;
    return most * x / (1.0 + std::abs(x));
  }

  /// Gained per pull, more of it. rad or mm per unit of pull
  double slope(double pull) const {
    const double straight = 1.0 + std::abs(rate * pull);
    return most * rate / (straight * straight);
  }
  /// Work that a pull from zero up to `pull` ≥ 0 stores in it.
  double energy(double pull) const {
    if (!(rate > 0)) return 0;
    const double x = rate * pull;
    return most / rate * (std::log1p(x) - x / (1.0 + x));
  }

  bool operator==(const CableStiffening&) const = default;
};

struct TendonError {
  double stretch = 0;          ///< added compliance as a fraction of the declared one: EA = EA0/(1 + stretch)
  double pretension = 0;       ///< added to that of tendon 1 at home, N; nothing where tendons hang loose
  double slack = 0;            ///< of both tendons together, beyond what pretension takes up, mm
  double creep = 0;            ///< compliance added in every decade of time that a tension acts, as a fraction
  double slip = 0;             ///< let go by the anchor of tendon 1 (of tendon 2 where negative) at `slip_time`, mm
  double slip_time = 0;        ///< s, on the bench's clock: runs one after another
  double thermal1 = 0;         ///< unloaded length of tendon 1 added per kelvin, as a fraction
  double thermal2 = 0;         ///< of tendon 2: one may lie nearer to what is warm
  double groove_friction = 0;  ///< added to the coefficient between tendon and groove
  CableStiffening waves = {};  ///< of each tendon between pin and joint, mm and N

  /// What slack leaves of the pretension: nothing, but for the last micrometre, over which a fit finds no jump.
  double pretension_share() const { return std::clamp(1.0 - slack / 1e-3, 0.0, 1.0); }

  bool operator==(const TendonError&) const = default;
};

/// Of both sheaths alike.
struct SheathError {
  double friction = 0;  ///< added to the friction coefficient times the bends, ln of a ratio of tensions
  double give = 0;      ///< added to what a sheath gets shorter by, mm/N

  bool operator==(const SheathError&) const = default;
};

struct PinPlaceError {
  double outward = 0;  ///< further from the middle, mm
  double down = 0;     ///< further from the joint, mm; the pulley's axis stays

  bool operator==(const PinPlaceError&) const = default;
};

struct PinError {
  PinPlaceError left;
  PinPlaceError right;
  double radius = 0;            ///< added to both pins' radius, mm
  double friction = 0;          ///< added to the capstan coefficient, of idlers to that of their bearings
  double bearing_friction = 0;  ///< added to the coefficient of idlers' bearings
  double give = 0;              ///< each pin moves along the tendon's force on it, mm/N

  bool operator==(const PinError&) const = default;
};

/// A torque against +θ beside what is declared: cos · cos θ + sin · sin θ, N·mm.
struct WeightError {
  double cos = 0;
  double sin = 0;

  bool operator==(const WeightError&) const = default;
};

/// Of the joint's drum, fixed to the link.
struct DrumError {
  double radius = 0;  ///< added to it, mm
  double across = 0;  ///< its centre off the joint's axis, in the link at home, to the right, mm
  double along = 0;   ///< and along OC

  bool operator==(const DrumError&) const = default;
};

/// Where a tendon ends beside where its own attachment is declared, in the link at home. mm
struct AttachmentError {
  double across = 0;  ///< to the right
  double along = 0;   ///< along OC

  bool operator==(const AttachmentError&) const = default;
};

/// A tendon's path beside all that is declared: longer by slope · θ + square · θ² + cube · θ³, θ to its own side.
/// Geometry that no effect has a name for, as a flexure whose centre wanders, or a cord that leaves its drum aslant.
struct PathError {
  double slope = 0;   ///< mm/rad
  double square = 0;  ///< mm/rad²
  double cube = 0;    ///< mm/rad³

  bool operator==(const PathError&) const = default;
};

/// Of both tendons, where RubbingError is what it says, N.
constexpr double k_usual_pull = 10.0;

/// Dry friction by laws that no effect has, N·mm on the joint where both tendons pull with k_usual_pull.
struct RubbingError {
  double by_area = 0;    ///< with the power 2/3 of each tendon's pull, as soft fibres on polished pins (Howell)
  double by_lesser = 0;  ///< with the pull of the tendon that pulls less, as of two that rub on each other

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
  double mean_load = 0;  ///< tip force beside the declared one, under which the joint is to follow its law, N

  bool operator==(const JointError&) const = default;
};

/// Friction that a pull has to overcome before the joint turns, on the mean over the cable's way.
struct CableFriction {
  double share = 0;     ///< of the load
  double unloaded = 0;  ///< and beside it, by what pulls the cables without load; units of load

  double at(double load) const { return unloaded + share * std::abs(load); }

  bool operator==(const CableFriction&) const = default;
};

/// A transmission whose ratio and compliance change with the angle, as a linkage behind the cable makes them. u: what
/// the declared ratio turns the joint by from home, rad.
struct RatioCurve {
  double square = 0;       ///< turned by square · u² beside u, 1/rad
  double cube = 0;         ///< and by cube · u³, 1/rad²
  double give_slope = 0;   ///< compliance added in proportion to u, 1 per unit of load
  double give_square = 0;  ///< and to u², 1/rad per unit of load

  /// Turned beside u under `load`, rad.
  double added(double u, double load) const {
    return u * (u * (square + u * cube) - load * (give_slope + u * give_square));
  }

  bool operator==(const RatioCurve&) const = default;
};

/// Of a joint declared by a ratio, whose tendons are not known. rad.
struct RatioJointError {
  RatioCurve curve;
  double compliance = 0;      ///< turned by a unit of load
  CableStiffening waves;      ///< what a cable that lies wavy gives beside that
  CableFriction friction;     ///< of the cable along its way
  double drift = 0;           ///< turned by a unit of load in every decade of time that it acts
  double slack = 0;           ///< play of α, full width, without load; it shrinks by 1 + slack_taken_up · |load|
  double slack_taken_up = 0;  ///< per unit of load
  double step = 0;            ///< turned at TendonError::slip_time
  double warmth = 0;          ///< turned by a kelvin

  bool operator==(const RatioJointError&) const = default;
};

/// It shows zero + (1 + gain) θ + sin · sin θ + cos · (cos θ − 1) and a wave of the same kind in nθ, late by `lag`.
struct JointSensorError {
  double zero = 0;  ///< rad
  double gain = 0;
  double eccentricity_sin = 0;  ///< rad
  double eccentricity_cos = 0;  ///< rad
  double wave_sin = 0;          ///< rad
  double wave_cos = 0;          ///< rad
  double wave_order = 2;        ///< n
  double lag = 0;               ///< s
  double first_order = 0;       ///< 0: all of it is late by that much; 1: a filter of that time constant

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
