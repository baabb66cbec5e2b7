/// \file
/// A joint as plain values: as declared, and its deviations from the declaration.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "fusee/base.h"

namespace fusee {

// ---- Deviations -----------------------------------------------------------------------------------------------------
// Deviations of a joint from its declaration, in the order of the chain: motor sensor → shaft → pulley → tendon →
// sheath → pins → joint → joint sensor. All zero: as declared. rad, mm, N, s.
//
// Deviations that act together are grouped, so that sums, caches and corrections take parts rather than lists of
// numbers. effect.h assigns the numbers to effects.

/// When the sensor reads α, the shaft is at α + offset + eccentricity_sin · sin α + eccentricity_cos · (cos α − 1)
/// + wave_sin · sin nα + wave_cos · (cos nα − 1). rad.
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

/// Deviation of both pulleys.
struct PulleyError {
  OutlineError outline;
  double scale = 0;  ///< relative enlargement of the pitch curves

  bool operator==(const PulleyError&) const = default;
};

/// Compliance of a wavy cable. A cable that is not straight is longer by the length of its waves. Tension straightens
/// it, and the path gains the length most · x/(1 + x) with x = rate · pull. Units: rad and units of load for a joint
/// declared by a ratio, mm and N for a tendon.
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
    return most / rate * (elementary::log1p(x) - x / (1.0 + x));
  }

  bool operator==(const CableStiffening&) const = default;
};

/// Deviation of both tendons.
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
  double friction = 0;    ///< added to friction coefficient × total bend: ln of a tension ratio
  double compliance = 0;  ///< added to the axial compliance of a sheath, mm/N

  bool operator==(const SheathError&) const = default;
};

/// Displacement of a guide pin.
struct PinPlaceError {
  double outward = 0;  ///< further from the middle, mm
  double down = 0;     ///< further from the joint, mm; the pulley axis does not move

  bool operator==(const PinPlaceError&) const = default;
};

/// Deviation of both guide pins.
struct PinError {
  PinPlaceError left;
  PinPlaceError right;
  double radius = 0;            ///< added to the radius of both pins, mm
  double friction = 0;          ///< added to the capstan coefficient; for idlers, to that of their bearings
  double bearing_friction = 0;  ///< added to the coefficient of idlers' bearings
  double compliance = 0;        ///< displacement of each pin along the tendon's force on it, mm/N

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

/// Deviation of the joint: geometry, friction, weight.
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

  /// Friction at a load, in units of load.
  double at(double load) const { return unloaded + share * std::abs(load); }

  bool operator==(const CableFriction&) const = default;
};

/// A ratio and a compliance that change with the angle, for example through a linkage behind the cable. u: rotation of
/// the joint from home by the declared ratio, rad.
struct RatioCurve {
  double linear = 0;             ///< coefficient of u: relative error of the ratio
  double square = 0;             ///< coefficient of u² in the rotation, 1/rad
  double cube = 0;               ///< coefficient of u³, 1/rad²
  double compliance_slope = 0;   ///< compliance per u, 1 per unit of load
  double compliance_square = 0;  ///< compliance per u², 1/rad per unit of load

  /// Rotation beyond u under `load`, rad.
  double added(double u, double load) const {
    return u * (linear + u * (square + u * cube) - load * (compliance_slope + u * compliance_square));
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

/// Reading: zero + (1 + gain) θ + eccentricity_sin · sin θ + eccentricity_cos · (cos θ − 1) + wave_sin · sin nθ
/// + wave_cos · (cos nθ − 1), delayed by `lag`.
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

/// All deviations of a joint. All zero: as declared.
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

/// Place of an effect in the chain from motor to sensor.
enum class ChainPlace { motor_sensor, shaft, pulley, tendon, sheath, pins, joint, joint_sensor };
std::string_view word(ChainPlace place);  ///< "motor sensor"

/// The means that corrects the error of an effect.
enum class CorrectableBy { nothing, table, pulley };
std::string_view word(CorrectableBy remedy);  ///< "pulley", "table" or ""

// ---- Declaration ----------------------------------------------------------------------------------------------------
// A joint as declared: plain values, in the paper's symbols. Angles in rad, lengths in mm, forces in N, stresses in
// MPa (N/mm²).
//
// The joint axis O is the origin. y points to the tendons' attachment C at home: C = R (sin θ, cos θ). The guide pins
// are B (−EB, −OE) and D (ED, −OE); the pulley's axis G is (0, −OE − EF). Tendon 1 runs C → B → P1 on the left, tendon
// 2 C → D → P2 on the right. α > 0 turns the pulley clockwise: tendon 1 is paid out, tendon 2 is wound in, and θ
// increases.
//
// Each number has one row in the field table (fusee/mechanism_file.h) with its key, unit, range, default and meaning.

/// The end of a tendon, in the link's frame at home. mm
struct Attachment {
  double across = 0;  ///< to the right
  double along = 0;   ///< along OC

  bool operator==(const Attachment&) const = default;
};

/// The joint's axis, range and tendon attachments. mm, rad.
struct Joint {
  double R = 0;          ///< OC, from the joint axis to the tendons' attachment
  double theta_min = 0;  ///< rad, ≤ 0: home lies within the range
  double theta_max = 0;  ///< rad
  /// Radius of a drum about O, fixed to the link; 0: none. A tendon wraps on it, its centre line half a thickness
  /// further out, as on a pin.
  double drum_radius = 0;
  double drum_mu = 0;                                    ///< capstan coefficient between tendon and drum
  std::optional<Attachment> attachment1 = std::nullopt;  ///< end of tendon 1 where it is not C
  std::optional<Attachment> attachment2 = std::nullopt;
  /// Offset of the drum's centre from O, fixed to the link. No key sets it; calibration identifies it (mounted()).
  Attachment drum_centre = {};

  bool operator==(const Joint&) const = default;

  /// True for the paper's joint: both tendons end at C and there is no drum.
  bool is_plain() const { return drum_radius == 0 && !attachment1 && !attachment2; }
};

/// A pin is fixed and the tendon slides on it; an idler turns on a bearing.
enum class GuideKind { pin, idler };

/// The two guides between joint and pulley. mm.
struct Guides {
  double EB = 0;      ///< pin B is at (−EB, −OE)
  double ED = 0;      ///< pin D is at (ED, −OE)
  double OE = 0;      ///< positive: the pins are below the joint, away from C
  double radius = 0;  ///< radius of the pin itself; 0: a point
  double mu = 0;      ///< capstan coefficient at the pins
  /// Distance of D below B: D is at (ED, −OE − D_below_B). No key sets it; calibration identifies it (mounted()).
  double D_below_B = 0;
  GuideKind kind = GuideKind::pin;  ///< idler: turns on a bearing, without sliding of the tendon
  double bearing_radius = 0;        ///< friction radius of an idler's bearing
  double bearing_friction = 0;
  bool collar = false;  ///< a collar holds multi-turn tendons at the guide's height

  bool operator==(const Guides&) const = default;
};

/// A Bowden sheath on each tendon, from its pin to the motor, where the pulley is. The tendon runs from its pin's outer
/// side straight down into the sheath and leaves it at the exit, a point of its centre line.
struct Sheath {
  double length = 0;       ///< length of each sheath; 0: none
  double bend = 0;         ///< total bend, rad
  double mu = 0;           ///< capstan coefficient in the sheath
  double stiffness = 0;    ///< axial stiffness in compression, N/mm; 0: rigid
  double exit_across = 0;  ///< exits are at (± exit_across, exit_above) from the pulley's axis
  double exit_above = 0;

  bool operator==(const Sheath&) const = default;

  bool is_there() const { return length > 0; }
};

/// The origin of θ(α): Transmission lists the formulas.
enum class Law { compensate, linear, table, torque };
/// exact: pins and tendons have their thickness; paper: points and lines.
enum class Method { exact, paper };
/// automatic: multi-turn helical grooves where one turn does not suffice.
enum class WindingChoice { automatic, one_turn };

/// One row of a table law θ(α). rad.
struct LawRow {
  double alpha = 0;
  double theta = 0;

  bool operator==(const LawRow&) const = default;
};

/// One row of a wanted motor torque over the joint angle.
struct TorqueRow {
  double theta = 0;   ///< rad
  double torque = 0;  ///< of the motor, towards +α, N·mm

  bool operator==(const TorqueRow&) const = default;
};

/// Place and function of the pulley. (solid::Pulley is the resulting part.)
struct PulleyDrive {
  double EF = 0;  ///< from the line of the pins down to the pulley's axis G; with a sheath only for drawings
  double r1 = 0;  ///< P1's pitch radius (law = compensate)
  Law law = Law::compensate;
  double ratio = 0;          ///< α per θ (law = linear)
  std::string table;         ///< the CSV of law = table, as written in the file
  std::vector<LawRow> rows;  ///< its contents, by increasing α
  /// Torque that holds the load at every θ, towards +α, N·mm (law = torque); 0: given by the table.
  double motor_torque = 0;
  std::string torque_table;            ///< the CSV of law = torque, as written in the file; "": motor_torque everywhere
  std::vector<TorqueRow> torque_rows;  ///< its contents, by increasing θ
  Method method = Method::exact;
  double mu = 0;  ///< effective friction coefficient between tendon and groove
  WindingChoice winding = WindingChoice::automatic;

  bool operator==(const PulleyDrive&) const = default;
};

/// Both tendons. mm, N, MPa.
struct Tendon {
  double diameter = 0;
  double modulus = 0;          ///< Young's modulus, MPa
  double pretension = 0;       ///< pretension of tendon 1 at home, N
  double bend_ratio = 0;       ///< bend diameter / tendon diameter (D/d) below which a warning is given
  double strength = 0;         ///< breaking tension without a knot, N; 0: unknown
  double knot_efficiency = 1;  ///< fraction of the strength that remains at a knot

  bool operator==(const Tendon&) const = default;
};

/// Axial stiffness of a round tendon, E · πd²/4, N.
template <typename S>
S stiffness_of_section(const S& modulus, const S& diameter) {
  return modulus * 0.25 * k_pi * diameter * diameter;
}
inline double section_stiffness(const Tendon& tendon) { return stiffness_of_section(tendon.modulus, tendon.diameter); }

/// The load on the joint. Forces and torques are positive against +θ: they load tendon 2.
struct Load {
  double tip_force = 0;  ///< F_c across OC, N
  double torque = 0;     ///< about O, N·mm
  double mass_kg = 0;    ///< of the link
  double lever = 0;      ///< from O along OC to the centre of mass
  double tilt = 0;       ///< the joint angle at which OC points straight up, rad

  bool operator==(const Load&) const = default;
};

/// Spring on the joint's axis, between base and link. Torque against +θ: preload + stiffness (θ − free).
struct Spring {
  double stiffness = 0;  ///< N·mm/rad
  double preload = 0;    ///< at the angle `free`, N·mm
  double free = 0;       ///< rad

  bool operator==(const Spring&) const = default;

  /// Torque against +θ at `theta` (rad), N·mm.
  double torque(double theta) const { return preload + stiffness * (theta - free); }
};

/// The motor that turns the pulley. A travel, torque or speed of 0 is not written; the model supplies it
/// (mechanism/catalogue.h).
struct Motor {
  std::string model = "none";    ///< a name of the catalogue
  double travel = 0;             ///< angle from one end of its range to the other, rad
  double stall_torque = 0;       ///< N·mm
  double speed = 0;              ///< without load, rad/s
  double gear_ratio = 1;         ///< turns of the motor per turn of the pulley, by a gearbox between them
  double gear_efficiency = 0.9;  ///< of that gearbox; not used for gear_ratio = 1
  double joint_speed = 0;        ///< required of the joint under the load, rad/s
  bool enforce = false;          ///< a joint that needs more than the motor gives is refused

  bool operator==(const Motor&) const = default;

  bool is_there() const { return *this != Motor{}; }
};

/// All passive torques on a joint, which the motor holds for law = torque.
struct JointLoad {
  double lever = 0;  ///< OC, at whose end the tip force acts, mm
  Load load;
  Spring spring;

  bool operator==(const JointLoad&) const = default;
};

/// Cross-section of the grooves.
enum class Groove { u, v, flat };
/// Rim of the flanges: parallel to the grooves, or a circle.
enum class Flange { follow, round };
/// Shape of the bore. horn: screwed onto a servo horn.
enum class Bore { round, d, hex, square, keyway, horn };
/// Home mark, clocking mark and labels on the faces.
enum class Marks { engraved, raised, none };
/// Place of a tendon's end beyond its knot: a slot of the face, or none.
enum class Tail { slot, none };

/// The printed body. 0 means "automatic" where the field table says so; fusee/solid.h resolves it.
struct Body {
  Groove groove = Groove::u;
  double groove_angle = 0;  ///< full angle between the walls, rad
  double groove_depth = 0;  ///< groove edge above the floor; 0: 2 d, at least 0.8 mm
  double seat_ratio = 0;    ///< seat radius of a U groove / tendon diameter
  Flange flange = Flange::follow;
  double flange_thickness = 0;  ///< at the groove edge
  double hub_diameter = 0;      ///< 0: from the bore and the set screw
  double hub_height = 0;        ///< above the top flange; 0: no hub. Omitted where it does not fit
  Bore bore = Bore::round;
  double bore_diameter = 0;    ///< shaft diameter, across flats for hex and square; 0: 5, less where space is short
  double bore_flat = 0;        ///< D bore: from the flat to the far side; 0: 0.9 × the diameter
  std::string horn = "own";    ///< bore = horn: a name of catalogue.h; own: Mechanism::horn
  std::string shaft = "none";  ///< a name of catalogue.h, from which the reader sets bore, bore_diameter and bore_flat
  std::string set_screw;       ///< "auto" (M3 where it fits into the hub, else none), "none", "M2" … "M6"
  bool nut_trap = false;
  double anchor_hole = 0;   ///< width of the tie-off channel; 0: d + 0.3 mm, at least 0.6 mm
  double knot_pocket = 0;   ///< diameter; 0: 3.5 d, less where space is short
  double wrap = 0;          ///< minimum wrap between the active arc and a tie-off, rad; 0: as much as fits
  Tail tail = Tail::slot;   ///< place of a tendon's end beyond its knot
  std::string clamp_screw;  ///< clamps the tail: "none", "M2" … "M3"
  Marks marks = Marks::engraved;
  double mark_depth = 0;
  double min_wall = 0;     ///< 0: 1.2 mm, thinner on small pulleys
  double room = 0;         ///< largest diameter of the part; 0: no limit
  double lead = 0;         ///< minimum pitch of helical grooves; 0: as groove and rib require
  double spare_turns = 1;  ///< turns of helical grooves before and after those that the range winds

  bool operator==(const Body&) const = default;
};

/// A servo horn that the pulley is screwed onto, or (with `spline_teeth`) the servo's splined output shaft.
struct Horn {
  double bolt_circle = 0;      ///< diameter of the circle through the screws' centres
  int bolt_count = 0;          ///< number of screws, evenly spaced on that circle
  double bolt_hole = 0;        ///< diameter of the screws' clearance holes
  double first_bolt = 0;       ///< direction of the first screw, from +x, rad
  double centre_hole = 0;      ///< access for the screw that holds the horn on the servo, its head and its driver
  double boss_diameter = 0;    ///< boss on the horn's face, which sinks into the pulley
  double boss_height = 0;      ///< its height above that face; 0: the horn is flat
  int spline_teeth = 0;        ///< teeth of the output shaft
  double spline_diameter = 0;  ///< over the teeth
  double spline_depth = 0;     ///< of a tooth
  double spline_length = 0;    ///< length of the shaft in the pulley; 0: the teeth go through

  bool operator==(const Horn&) const = default;
};

/// Effects of the printed material.
struct Material {
  std::string name;
  double shrinkage = 0;          ///< relative shrinkage of a print
  double hole_compensation = 0;  ///< added to the diameter of holes, mm
  double elephant_foot = 0;      ///< maximum chamfer at the bed; smaller at a thin groove edge, mm

  bool operator==(const Material&) const = default;
};

/// Number of printed parts.
enum class Parts { automatic, one, two };

/// Print settings.
struct Print {
  Parts parts = Parts::automatic;  ///< one: P1 and P2 in one part; two: separate parts, pinned together
  double overhang = 0;             ///< flattest printable slope of a downward face above the horizontal, rad
  bool supports = false;           ///< true: the printer adds supports, and the part is not shaped to avoid them
  double nozzle = 0;               ///< line width of the printer, mm

  bool operator==(const Print&) const = default;
};

/// Settings for cutting the part as a stack of plates. mm.
struct Cut {
  double kerf = 0;   ///< width of the cut
  double plate = 0;  ///< plate thickness
  double sheet_width = 0;
  double sheet_height = 0;
  double dowel = 0;  ///< dowel hole diameter

  bool operator==(const Cut&) const = default;
};

/// The [optimize] table: its texts as written, checked for syntax. fusee/optimize.h interprets them.
struct Optimization {
  std::vector<std::string> objectives;  ///< names of fusee/optimize.h
  std::vector<std::string> variables;   ///< keys of the field table
  std::vector<double> lower;            ///< one per variable, in the file's units
  std::vector<double> upper;
  std::vector<std::string> tied;         ///< "guides.EB_mm = guides.ED_mm"
  std::vector<std::string> constraints;  ///< "guides.EB_mm <= 0.5 * joint.length_mm"
  bool feasible = false;                 ///< only designs for which a pulley can be made

  bool operator==(const Optimization&) const = default;
};

/// A joint declared by a ratio, for calibration only: θ = offset + α/ratio.
struct RatioTransmission {
  double ratio = 0;

  bool operator==(const RatioTransmission&) const = default;
};

/// Manual measurements of the joint: value and standard uncertainty in mm, MPa and mm/N, or the unit that ends the
/// name; empty if not measured.
struct Prior {
  std::vector<double> EB, ED, OE, EF, guide_radius, length, radius_offset, pulley_scale, modulus;
  std::vector<double> drum_radius, attachment1_across, attachment1_along, attachment2_across, attachment2_along;
  std::vector<double> OE1, OE2, motor_offset_deg, backlash_deg, runout_x, runout_y, guide_compliance, zero_deg,
      gain_percent;

  bool operator==(const Prior&) const = default;
};

/// Unit of the lengths in a mechanism file, for reading and writing. Values in memory are always mm.
enum class LengthUnit { mm, inch };

/// A mechanism as declared, as mounted, or as made. Its special members are defined in mechanism.cpp to save compile
/// time in two dozen files.
struct Mechanism {
  Mechanism();
  Mechanism(const Mechanism&);
  Mechanism(Mechanism&&) noexcept;
  Mechanism& operator=(const Mechanism&);
  Mechanism& operator=(Mechanism&&) noexcept;
  ~Mechanism();

  std::string name;
  LengthUnit units = LengthUnit::mm;
  Joint joint;
  Guides guides;
  Sheath sheath;
  PulleyDrive pulley;
  Tendon tendon;
  Load load;
  Spring spring;
  Motor motor;
  /// The load that defines law = torque, when the joint now carries a different one (keep_law(), load.h). No key sets
  /// it.
  std::optional<JointLoad> law_load = std::nullopt;
  Body body;
  Horn horn;  ///< from [horn]; horn_of() (catalogue.h) selects the mounted one
  Material material;
  Print print;
  Cut cut;
  std::optional<RatioTransmission> transmission;  ///< set: joint, guides and pulley are not declared

  bool operator==(const Mechanism&) const = default;

  /// ρp: pin radius to the tendon's centre line, mm.
  double guide_pitch_radius() const { return guides.radius + 0.5 * tendon.diameter; }
  /// Pin radius to the tendon's centre line, as equations and drawings use it. 0 for method = "paper", which treats
  /// pins as points and tendons as lines. Otherwise a pin of radius 0 still has half the tendon's thickness.
  double seen_pitch_radius() const { return pulley.method == Method::paper ? 0.0 : guide_pitch_radius(); }
  /// True when pins are treated as points.
  bool has_point_pins() const { return seen_pitch_radius() == 0; }
  /// Drum radius to the centre line of a tendon; 0 without a drum. mm
  double drum_pitch_radius() const { return joint.drum_radius != 0 ? joint.drum_radius + 0.5 * tendon.diameter : 0.0; }
  /// True for the joint of the paper's formulas: one attachment, fixed pins, no sheath.
  bool is_papers() const { return joint.is_plain() && guides.kind == GuideKind::pin && !sheath.is_there(); }
  /// Groove depth from floor to edge, "automatic" resolved: deep enough to hold a slack tendon and to print. mm
  double groove_depth() const {
    return body.groove_depth > 0 ? body.groove_depth : std::max(2.0 * tendon.diameter, 0.8);
  }
};

/// The complete content of a file: the declared mechanism, the identified deviations, priors and optimization. Only
/// identified_joint() (fusee/joint.h) reads `identified`.
struct DeclaredMechanism : Mechanism {
  Optimization optimize;
  Imperfections identified;  ///< result of fusee calibrate; all zero: as declared
  Prior prior;

  DeclaredMechanism();
  /// A declaration without identified deviations.
  explicit DeclaredMechanism(Mechanism mechanism);
  DeclaredMechanism(const DeclaredMechanism&);
  DeclaredMechanism(DeclaredMechanism&&) noexcept;
  DeclaredMechanism& operator=(const DeclaredMechanism&);
  DeclaredMechanism& operator=(DeclaredMechanism&&) noexcept;
  ~DeclaredMechanism();
  bool operator==(const DeclaredMechanism&) const = default;
};

}  // namespace fusee
