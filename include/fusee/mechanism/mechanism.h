/// \file
/// A joint as declared: plain values, in the paper's symbols. Angles in rad, lengths in mm, forces in N, stresses in
/// MPa.
///
/// The joint axis O is the origin. y points to the tendons' attachment C at home: C = R (sin θ, cos θ). The guide pins
/// are B (−EB, −OE) and D (ED, −OE); the pulley's axis G is (0, −OE − EF). Tendon 1 runs C → B → P1 on the left, tendon
/// 2 C → D → P2 on the right. α > 0 turns the pulley clockwise: tendon 1 is paid out, tendon 2 is wound in, and θ
/// increases.
///
/// Each number has one row in the field table (fields.h) with its key, unit, range, default and meaning.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "fusee/base/units.h"
#include "fusee/mechanism/imperfections.h"

namespace fusee {

/// The end of a tendon, in the link's frame at home. mm
struct Attachment {
  double across = 0;  ///< to the right
  double along = 0;   ///< along OC

  bool operator==(const Attachment&) const = default;
};

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

enum class GuideKind { pin, idler };

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

enum class Law { compensate, linear, table, torque };
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

/// Place and function of the pulley. (solid/pulley.h's Pulley is the resulting part.)
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

struct Tendon {
  double diameter = 0;
  double modulus = 0;          ///< Young's modulus, MPa
  double pretension = 0;       ///< pretension of tendon 1 at home, N
  double bend_ratio = 0;       ///< minimum D/d before a warning
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
  double mass = 0;       ///< of the link, kg
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

  double torque(double theta) const { return preload + stiffness * (theta - free); }
};

/// All passive torques on a joint: what law = torque holds.
struct JointLoad {
  double lever = 0;  ///< OC, at whose end the tip force acts, mm
  Load load;
  Spring spring;

  bool operator==(const JointLoad&) const = default;
};

enum class Groove { u, v, flat };
enum class Flange { follow, round };
enum class Bore { round, d, hex, square, keyway, horn };
enum class Marks { engraved, raised, none };
enum class Tail { slot, none };

/// The printed body. 0 means "automatic" where the field table says so; solid/layout.h resolves it.
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

struct Material {
  std::string name;
  double shrinkage = 0;          ///< relative shrinkage of a print
  double hole_compensation = 0;  ///< added to the diameter of holes, mm
  double elephant_foot = 0;      ///< maximum chamfer at the bed; smaller at a thin groove edge, mm

  bool operator==(const Material&) const = default;
};

enum class Parts { automatic, one, two };

/// Print settings.
struct Print {
  Parts parts = Parts::automatic;  ///< one: P1 and P2 in one part; two: separate parts, pinned together
  double overhang = 0;             ///< flattest printable slope of a downward face above the horizontal, rad
  bool supports = false;           ///< true: the printer adds supports, and the part is not shaped to avoid them
  double nozzle = 0;               ///< line width of the printer, mm

  bool operator==(const Print&) const = default;
};

/// Settings for cutting the part as a stack of plates.
struct Cut {
  double kerf = 0;
  double plate = 0;  ///< plate thickness
  double sheet_width = 0;
  double sheet_height = 0;
  double dowel = 0;  ///< dowel hole diameter

  bool operator==(const Cut&) const = default;
};

/// The [optimize] table: its texts as written, checked for syntax. optimize/problem.h interprets them.
struct Optimization {
  std::vector<std::string> objectives;  ///< names of optimize/objectives.h
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

/// Manual measurements of the joint: value and standard uncertainty, in the file's unit; empty if not measured.
struct Prior {
  std::vector<double> EB, ED, OE, EF, guide_radius, length, radius_offset, pulley_scale, modulus;
  std::vector<double> drum_radius, attachment1_across, attachment1_along, attachment2_across, attachment2_along;
  std::vector<double> OE1, OE2, motor_offset, backlash, runout_x, runout_y, guide_give, zero, gain;

  bool operator==(const Prior&) const = default;
};

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
  Joint joint;
  Guides guides;
  Sheath sheath;
  PulleyDrive pulley;
  Tendon tendon;
  Load load;
  Spring spring;
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
/// as_it_is() (joint/as_it_is.h) reads `identified`.
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
