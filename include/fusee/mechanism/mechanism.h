/// \file
/// A joint as declared: plain values, in the paper's symbols. Angles in rad, lengths in mm, forces in N, stresses in
/// MPa.
///
/// Joint axis O is the origin; y points to the tendon's attachment C at home; C = R (sin θ, cos θ). Guide pins stand at
/// B (−EB, −OE) and D (ED, −OE); the pulley's axis G is at (0, −OE − EF). Tendon 1 runs C → B → P1 on the left, tendon
/// 2 C → D → P2 on the right. α > 0 turns the pulley clockwise: tendon 1 is paid out, tendon 2 wound in, θ grows.
///
/// Every number here has one row in the field table (fields.h): its key, unit, range, default and meaning.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "fusee/base/units.h"
#include "fusee/mechanism/imperfections.h"

namespace fusee {

/// Where a tendon ends, in the link's frame at home. mm
struct Attachment {
  double across = 0;  ///< to the right
  double along = 0;   ///< along OC

  bool operator==(const Attachment&) const = default;
};

struct Joint {
  double R = 0;          ///< OC, from the joint axis to the tendons' attachment
  double theta_min = 0;  ///< rad, < 0 or = 0: home lies within the range
  double theta_max = 0;  ///< rad
  /// Of the drum itself about O, fixed to the link; 0: none. A tendon that would cut it lies on it, its centre line
  /// half its thickness further out, as on a pin.
  double drum_radius = 0;
  double drum_mu = 0;                                    ///< between tendon and drum
  std::optional<Attachment> attachment1 = std::nullopt;  ///< of tendon 1 where it is not C
  std::optional<Attachment> attachment2 = std::nullopt;
  /// The drum's centre off O, fixed to the link. No key has it: joints are found to be so (mounted()).
  Attachment drum_centre = {};

  bool operator==(const Joint&) const = default;

  /// Both tendons end in C, and there is no drum: the joint of the paper.
  bool is_plain() const { return drum_radius == 0 && !attachment1 && !attachment2; }
};

enum class GuideKind { pin, idler };

struct Guides {
  double EB = 0;      ///< pin B stands at (−EB, −OE)
  double ED = 0;      ///< pin D stands at (ED, −OE)
  double OE = 0;      ///< positive: the pins are below the joint, away from C
  double radius = 0;  ///< of the pin itself; 0 is a point
  double mu = 0;      ///< capstan coefficient at the pins
  /// D stands lower than B by this, at (ED, −OE − this). No key has it: joints are found to be so (mounted()).
  double D_below_B = 0;
  GuideKind kind = GuideKind::pin;  ///< idler: turns on a bearing, and the tendon does not slide on it
  double bearing_radius = 0;        ///< of an idler's bearing, where its friction acts
  double bearing_friction = 0;
  bool collar = false;  ///< a groove or collar keeps the tendon at the guide's height where it is wound several times

  bool operator==(const Guides&) const = default;
};

/// A Bowden sheath round each tendon, from its pin to the motor: the pulley lies where the motor is. The tendon goes
/// straight down from its pin's outer side into the sheath, and comes out of it at the mouth, a point of its centre
/// line.
struct Sheath {
  double length = 0;       ///< of each tendon's; 0: there is none
  double bend = 0;         ///< sum of its bends, rad
  double mu = 0;           ///< capstan coefficient in it
  double stiffness = 0;    ///< in compression, N/mm; 0: rigid
  double exit_across = 0;  ///< mouths stand at (± this, exit_above) from the pulley's axis
  double exit_above = 0;

  bool operator==(const Sheath&) const = default;

  bool is_there() const { return length > 0; }
};

enum class Law { compensate, linear, table, torque };
enum class Method { exact, paper };
/// automatic: a tendon is wound several times, in a helical groove, where one turn does not suffice.
enum class WindingChoice { automatic, one_turn };

/// One row of a declared law θ(α). rad.
struct LawRow {
  double alpha = 0;
  double theta = 0;

  bool operator==(const LawRow&) const = default;
};

/// One row of a wanted motor torque over the joint's angle.
struct TorqueRow {
  double theta = 0;   ///< rad
  double torque = 0;  ///< of the motor, towards +α, N·mm

  bool operator==(const TorqueRow&) const = default;
};

/// Where the pulley sits and what it must do. (The body that comes out is solid/pulley.h's Pulley.)
struct PulleyDrive {
  double EF = 0;  ///< from the pins' line down to the pulley's axis G; with a sheath only where it is drawn
  double r1 = 0;  ///< P1's pitch radius (law = compensate)
  Law law = Law::compensate;
  double ratio = 0;          ///< α per θ (law = linear)
  std::string table;         ///< the CSV of law = table, as written in the file
  std::vector<LawRow> rows;  ///< its contents, by increasing α
  double motor_torque = 0;   ///< what holds the load at every θ, towards +α, N·mm (law = torque); 0: the table says
  std::string torque_table;  ///< the CSV of law = torque, as written in the file; "": motor_torque everywhere
  std::vector<TorqueRow> torque_rows;  ///< its contents, by increasing θ
  Method method = Method::exact;
  double mu = 0;  ///< friction between tendon and groove, effective
  WindingChoice winding = WindingChoice::automatic;

  bool operator==(const PulleyDrive&) const = default;
};

struct Tendon {
  double diameter = 0;
  double modulus = 0;          ///< Young's modulus, MPa
  double pretension = 0;       ///< of tendon 1 at home, N
  double bend_ratio = 0;       ///< smallest D/d before a warning
  double strength = 0;         ///< the tension at which it breaks without a knot, N; 0: not known
  double knot_efficiency = 1;  ///< share of it that is left at a knot

  bool operator==(const Tendon&) const = default;
};

/// Tension per strain of a round tendon, E · πd²/4, N; of numbers of any kind.
template <typename S>
S stiffness_of_section(const S& modulus, const S& diameter) {
  return modulus * 0.25 * k_pi * diameter * diameter;
}
inline double section_stiffness(const Tendon& tendon) { return stiffness_of_section(tendon.modulus, tendon.diameter); }

/// What the joint carries. Forces and torques are positive against +θ: they load tendon 2.
struct Load {
  double tip_force = 0;  ///< F_c across OC, N
  double torque = 0;     ///< about O, N·mm
  double mass = 0;       ///< of the link, kg
  double lever = 0;      ///< from O along OC to the centre of that mass
  double tilt = 0;       ///< the joint angle at which OC points straight up, rad

  bool operator==(const Load&) const = default;
};

/// On the joint's axis, between base and link: against +θ with preload + stiffness (θ − free).
struct Spring {
  double stiffness = 0;  ///< N·mm/rad
  double preload = 0;    ///< at the angle `free`, N·mm
  double free = 0;       ///< rad

  bool operator==(const Spring&) const = default;

  double torque(double theta) const { return preload + stiffness * (theta - free); }
};

/// All that turns a joint by itself: what law = torque holds.
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

/// The printed body. 0 stands for "automatic" where the field table says so; solid/layout.h resolves it.
struct Body {
  Groove groove = Groove::u;
  double groove_angle = 0;  ///< full angle between the walls, rad
  double groove_depth = 0;  ///< lip above the floor; 0: 2 d, at least 0.8 mm
  double seat_ratio = 0;    ///< seat radius of a U groove per tendon diameter
  Flange flange = Flange::follow;
  double flange_thickness = 0;  ///< at the lip
  double hub_diameter = 0;      ///< 0: from the bore and the set screw
  double hub_height = 0;        ///< above the top flange; 0: no hub. Without room for one it is left out
  Bore bore = Bore::round;
  double bore_diameter = 0;    ///< shaft diameter, across flats for hex and square; 0: 5, or what there is room for
  double bore_flat = 0;        ///< D bore: from the flat to the far side; 0: 0.9 × the diameter
  std::string horn = "own";    ///< bore = horn: a name of catalogue.h; own: Mechanism::horn
  std::string shaft = "none";  ///< a name of catalogue.h; the reader gave bore, bore_diameter and bore_flat its numbers
  std::string set_screw;       ///< "auto" (M3 where the hub has room for it, else none), "none", "M2" … "M6"
  bool nut_trap = false;
  double anchor_hole = 0;   ///< width of the tie-off channel; 0: d + 0.3 mm, at least 0.6 mm
  double knot_pocket = 0;   ///< diameter; 0: 3.5 d, or what there is room for
  double wrap = 0;          ///< least wrap between the active arc and a tie-off, rad; 0: as much as there is room for
  Tail tail = Tail::slot;   ///< where the end of a tendon lies beyond its knot
  std::string clamp_screw;  ///< over the tail: "none", "M2" … "M3"
  Marks marks = Marks::engraved;
  double mark_depth = 0;
  double min_wall = 0;     ///< 0: 1.2 mm, thinner on small pulleys
  double lead = 0;         ///< of helical grooves: least height from turn to turn; 0: what groove and rib need
  double spare_turns = 1;  ///< of helical grooves, before and after what the range winds

  bool operator==(const Body&) const = default;
};

/// A servo's horn that the pulley is screwed onto, or (with `spline_teeth`) the servo's toothed output shaft itself.
struct Horn {
  double bolt_circle = 0;      ///< diameter of the circle through the screws' centres
  int bolt_count = 0;          ///< screws, evenly on that circle
  double bolt_hole = 0;        ///< diameter of the holes that they pass through
  double first_bolt = 0;       ///< direction of the first, from +x, rad
  double centre_hole = 0;      ///< for the screw that holds the horn on the servo, its head and its driver
  double boss_diameter = 0;    ///< of what stands above the horn's face and sinks into the pulley
  double boss_height = 0;      ///< how far it stands above that face; 0: the horn is flat
  int spline_teeth = 0;        ///< of the output shaft
  double spline_diameter = 0;  ///< over the teeth
  double spline_depth = 0;     ///< of a tooth
  double spline_length = 0;    ///< how far the shaft reaches into the pulley; 0: its teeth go through

  bool operator==(const Horn&) const = default;
};

struct Material {
  std::string name;
  double shrinkage = 0;          ///< fraction by which a print comes out smaller
  double hole_compensation = 0;  ///< added to the diameter of holes, mm
  double elephant_foot = 0;      ///< chamfer at the bed, at most; a thin lip gets a smaller one, mm

  bool operator==(const Material&) const = default;
};

enum class Parts { automatic, one, two };

/// How the part is printed.
struct Print {
  Parts parts = Parts::automatic;  ///< one: P1 and P2 in one piece; two: each for itself, pinned together
  double overhang = 0;             ///< the flattest slope above the horizontal that a face looking down may have, rad
  bool supports = false;           ///< true: the printer makes supports, nothing is shaped to need none
  double nozzle = 0;               ///< width of the line that the printer lays, mm

  bool operator==(const Print&) const = default;
};

/// Cutting the part as a stack of plates.
struct Cut {
  double kerf = 0;
  double plate = 0;  ///< plate thickness
  double sheet_width = 0;
  double sheet_height = 0;
  double dowel = 0;  ///< dowel hole diameter

  bool operator==(const Cut&) const = default;
};

/// What `fusee optimize` may change and what it is after: the texts of [optimize] as they were written (and found to be
/// well formed); optimize/problem.h gives them their meaning.
struct Optimization {
  std::vector<std::string> objectives;  ///< names of optimize/objectives.h
  std::vector<std::string> variables;   ///< keys of the field table
  std::vector<double> lower;            ///< one a variable, in the file's units
  std::vector<double> upper;
  std::vector<std::string> tied;         ///< "guides.EB_mm = guides.ED_mm"
  std::vector<std::string> constraints;  ///< "guides.EB_mm <= 0.5 * joint.length_mm"
  bool feasible = false;                 ///< only designs of which a pulley can be made

  bool operator==(const Optimization&) const = default;
};

/// A joint that is not this mechanism, for calibration alone: θ = offset + α/ratio.
struct RatioTransmission {
  double ratio = 0;

  bool operator==(const RatioTransmission&) const = default;
};

/// What was measured of the joint by hand: value and its standard uncertainty, in the file's unit; empty where nothing
/// was.
struct Prior {
  std::vector<double> EB, ED, OE, EF, guide_radius, length, radius_offset, pulley_scale, modulus;
  std::vector<double> drum_radius, attachment1_across, attachment1_along, attachment2_across, attachment2_along;
  std::vector<double> OE1, OE2, motor_offset, backlash, runout_x, runout_y, guide_give, zero, gain;

  bool operator==(const Prior&) const = default;
};

/// A mechanism, whosoever's: as declared, as mounted, or as it is made. A plain value, whose copies are made in
/// mechanism.cpp: in two dozen files that take one they were compiled again and again.
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
  /// What law = torque was declared against, where the joint carries something else by now (keep_law(), load.h). No key
  /// has it.
  std::optional<JointLoad> law_load = std::nullopt;
  Body body;
  Horn horn;  ///< of [horn], one's own; horn_of() (catalogue.h) says which one is mounted
  Material material;
  Print print;
  Cut cut;
  std::optional<RatioTransmission> transmission;  ///< set: joint, guides and pulley are not declared

  bool operator==(const Mechanism&) const = default;

  /// Pin radius to the tendon's centre line: ρp of mechanics, mm.
  double guide_pitch_radius() const { return guides.radius + 0.5 * tendon.diameter; }
  /// The same as equations and drawings see it: 0 where method = "paper" takes pins for points and tendons for lines.
  /// In every other method the tendon runs at half its thickness round a pin of radius 0 too.
  double seen_pitch_radius() const { return pulley.method == Method::paper ? 0.0 : guide_pitch_radius(); }
  /// Whether a pin is a point, for everything that asks.
  bool has_point_pins() const { return seen_pitch_radius() == 0; }
  /// Of the drum, to the centre line of a tendon that lies on it; 0 without a drum. mm
  double drum_pitch_radius() const { return joint.drum_radius != 0 ? joint.drum_radius + 0.5 * tendon.diameter : 0.0; }
  /// The joint that the paper's formulas are of: one lever point, and pins above their pulley.
  bool is_papers() const { return joint.is_plain() && guides.kind == GuideKind::pin && !sheath.is_there(); }
  /// From a groove's floor to its lip, "automatic" resolved: a slack tendon stays in, and a printer can make the lip.
  /// mm
  double groove_depth() const {
    return body.groove_depth > 0 ? body.groove_depth : std::max(2.0 * tendon.diameter, 0.8);
  }
};

/// All that a file says: the mechanism as declared, what was found to be otherwise, and what is asked. What must work
/// in the joint as it is goes through as_it_is() (joint/as_it_is.h), which alone reads `identified`.
struct DeclaredMechanism : Mechanism {
  Optimization optimize;
  Imperfections identified;  ///< what fusee calibrate found; all zero: as declared
  Prior prior;

  DeclaredMechanism();
  /// Of which no more is known.
  explicit DeclaredMechanism(Mechanism mechanism);
  DeclaredMechanism(const DeclaredMechanism&);
  DeclaredMechanism(DeclaredMechanism&&) noexcept;
  DeclaredMechanism& operator=(const DeclaredMechanism&);
  DeclaredMechanism& operator=(DeclaredMechanism&&) noexcept;
  ~DeclaredMechanism();
  bool operator==(const DeclaredMechanism&) const = default;
};

}  // namespace fusee
