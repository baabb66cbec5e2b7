/// \file
/// The joint as built: elastic tendons, friction, play and sensors, with history.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "fusee/base.h"
#include "fusee/mechanism.h"
#include "fusee/profile.h"
#include "fusee/transmission.h"

namespace fusee::joint {

// ---- Inputs on the bench --------------------------------------------------------------------------------------------
// Inputs to a joint on its bench: logged motor angles, loads and temperatures of each run.

/// One row of logged inputs.
struct BenchRow {
  double time = 0;   ///< s; 0 if not logged
  double alpha = 0;  ///< reading of the motor's sensor, rad
  double load = 0;   ///< tip force, positive against +θ, N; for a joint declared by a ratio in the log's own unit
  double temperature_C = 0;
};

/// Rotation of the encoders on their shafts, rad. The zero was set again after it, so that it only shifts the phase of
/// an encoder's periodic errors.
struct Mounting {
  double motor_sensor_turned = 0;
  double joint_sensor_turned = 0;

  bool operator==(const Mounting&) const = default;
};

/// The rows of one run, and which of them were logged.
struct BenchRun {
  std::vector<BenchRow> rows;  ///< sorted by time
  bool has_load = false;       ///< false: the declared load acts
  bool has_temperature = false;
  Mounting mounting = {};
};

/// Runs in chronological order.
using BenchLog = std::vector<BenchRun>;

/// Offsets for the times of each run, so that runs with restarted clocks follow one another. s
std::vector<double> bench_clock(const BenchLog& log);

// ---- Static model ---------------------------------------------------------------------------------------------------
// Static model of a joint: both tendon paths as mounted, their stiffness, friction and load.
//
// A tendon's path splits at a fixed point of the pin's rim: the part above depends only on θ, the part below only on
// α. A pulley made for one mechanism and mounted in another is therefore no special case.

/// A mechanism with identified pins, length, friction and tendon. Its pulley is still the declared one.
struct MountedMechanism {
  Mechanism mechanism;
  std::array<PathError, 2> longer = {};  ///< additional path lengths of the tendons: left, right
};

/// A tendon below its pin, in its right-hand image (increasing α winds in). mm, rad.
struct LowerPath {
  double p = 0;       ///< moment arm about the pulley's axis
  double normal = 0;  ///< direction of the line's outward normal
  /// Free span: from the pin's tangent point, or the sheath exit, to the contact on the pulley.
  double reach = 0;
  double wound = 0;  ///< arc length on the pulley as far as the contact, plus a constant
};

/// Both pulleys as made for one mechanism, with tendons from pins that may be elsewhere. Cheap to copy; immutable.
class MadePulleys {
 public:
  /// Pulleys of the target motion of `made_for`. Its law must exist over the range.
  explicit MadePulleys(const Mechanism& made_for) : declared_(made_for) {}

  /// Both pitch curves offset outwards by `by` (print offset, tendon thickness), mm.
  MadePulleys offset_by(double by) const;

  /// Both tendons (left, right) at the pulley angle `alpha`. NaN where a tendon touches a part of the curve outside the
  /// law's range.
  std::array<LowerPath, 2> paths(const std::array<transmission::LowerGuide, 2>& mounted, double alpha) const;
  std::array<LowerPath, 2> paths(const std::array<transmission::PinPlace, 2>& mounted, double alpha) const {
    return paths(std::array{mounted[0].lower(), mounted[1].lower()}, alpha);
  }
  /// The target motion of the mechanism that they were made for.
  const transmission::Transmission& declared() const { return declared_; }

 private:
  LowerPath path(transmission::Side side, const transmission::LowerGuide& mounted, double alpha,
                 const transmission::TransmissionPoint& first) const;

  transmission::Transmission declared_;
  double offset_ = 0;
};

/// Arc between the unwound end of the range and the tendon's knot, mm. An assumption: `fusee build` places 40° to 95°
/// of wrap there, and the file does not specify it. 15 mm more change the mean deflection by at most 0.6 % (R 100, r1
/// 16, 12 N, μ 0.05 to 0.5). Multi-turn tendons have body.spare_turns instead.
constexpr double k_arc_to_knot = 5.0;

struct UpperSpans;  // lookup tables of both upper spans over the joint angle

/// The static model of a joint, as plain values: a joint with other pins, stiffness or runout is a copy with members or
/// `lower` replaced.
struct JointModel {
  std::array<transmission::PinPlace, 2> pins;  ///< left, right, as mounted
  double lever = 0;                            ///< OC, at whose end a tip force acts, mm
  std::function<std::array<LowerPath, 2>(double alpha)> lower;
  std::function<double(double alpha)> expected;  ///< approximate θ, as a start for root finding
  double EA = 0;                                 ///< axial stiffness of a tendon: tension per strain, N
  transmission::GuideFriction guide;             ///< pins or idlers
  transmission::SheathLoad sheath;               ///< sheath of each tendon
  double pretension = 0;                         ///< of tendon 1 at home, unloaded, N
  double drum_friction = 0;                      ///< between tendon and drum, like groove_friction
  double slack = 0;                              ///< excess material of each tendon beyond the path, mm
  double bearing_friction = 0;                   ///< dry friction of the joint's bearing, N·mm
  RubbingError rubbing;                          ///< dry friction that depends on the tendons' tension
  CableStiffening waves;                         ///< waves of each tendon between its pin and its end
  double pin_compliance = 0;                     ///< compliance of a pin under its tendon's force, mm/N
  /// Capstan coefficient between tendon and groove, which limits the sliding of the wound tendon up to the knot.
  /// Infinite: the tendon keeps the strain of its winding; 0: it acts as part of the spring.
  double groove_friction = 0;
  double alpha_least = 0;  ///< range that the pulley was made for, rad; the knots lie beyond its ends
  double alpha_most = 0;
  /// Arc from the ends of the range to the knots, mm
  std::array<double, 2> arcs_to_knots = {k_arc_to_knot, k_arc_to_knot};
  double weight = 0;  ///< mass · g · lever, N·mm
  double tilt = 0;    ///< θ at which the link points straight up, rad
  Spring spring;
  double last_step = 1e-13;  ///< convergence limit of the equilibrium search for θ, rad
  double theta_least = 0;    ///< limits of θ between which both tendons have a moment arm about O, rad
  double theta_most = 0;
  std::shared_ptr<const UpperSpans> upper;  ///< tables for these pins and limits

  /// Total dry friction on the joint for tendons pulling with `left` and `right` N; N·mm.
  double dry_friction(double left, double right) const;

  /// Torque of weight and spring against +θ, N·mm, and its derivative.
  double own_torque(double theta) const { return weight * elementary::sin(tilt - theta) + spring.torque(theta); }
  double own_slope(double theta) const { return spring.stiffness - weight * elementary::cos(tilt - theta); }
};

/// Model of the joint as declared. Its law must exist over the range (Transmission::dead_centre() is null).
JointModel joint_model(const Mechanism& mechanism);
/// Model of the pulleys `made` in the mechanism `mounted`, whose own [pulley] law is ignored.
JointModel joint_model(const MadePulleys& made, const MountedMechanism& mounted);
/// Sets EA, friction, pretension, weight and spring of `mounted` in a model of the same geometry.
void set_statics(JointModel& model, const MountedMechanism& mounted);

// ---- Equilibrium ----------------------------------------------------------------------------------------------------
// The joint in quasi-static equilibrium along any sequence of pulley angles and loads, with history.
//
// Model: two elastic tendons that cannot push. Each has two spans with stick-slip capstan friction at the pin between
// them, and further spans with friction at each bend of a sheath. The wound tendon slides in its groove as far as
// friction permits (JointModel::groove_friction), as does the tendon on the joint's drum (drum_friction). Limits: the
// paper's [6]-[11] (fusee/transmission.h).

/// Changes of both tendons since home: creep, temperature, a slipping anchor. Not included in energies.
struct TendonChange {
  std::array<double, 2> expansion{};  ///< relative change of the unloaded length of tendon 1 and 2
  std::array<double, 2> released{};   ///< length released by the anchors of tendon 1 and 2 since home, mm
};

/// One step of a motion. The model's weight and spring act in addition to tip force and torque.
struct JointStep {
  double alpha = 0;      ///< rad
  double tip_force = 0;  ///< F_c across OC, positive against +θ, N
  double torque = 0;     ///< about O, positive against +θ, N·mm
  TendonChange tendon = {};
};

/// Motion of a tendon over its guide.
enum class PinContact {
  stick,      ///< no material crosses the pin; with a sheath: not all of the tendon slides
  slip_up,    ///< material crosses towards the joint: T_up = T_low e^{μφ}
  slip_down,  ///< towards the pulley: T_low = T_up e^{μφ}
  slack,      ///< no tension on either side
};

/// Tensions and lengths of one tendon in equilibrium.
struct TendonState {
  double upper = 0;    ///< tension between pin and C, N
  double lower = 0;    ///< tension between pulley and pin, N
  double end = 0;      ///< tension at the tendon's end; differs from `upper` by friction on a drum, N
  double slack = 0;    ///< excess of material over the path length, both spans, mm
  double stretch = 0;  ///< excess of path length over material, both spans, mm
  double wrap = 0;     ///< φ on the pin, rad; negative: the tendon would leave the pin, where the model ends
  PinContact contact = PinContact::stick;
};

/// Outcome of the equilibrium search.
enum class EquilibriumStatus {
  held,   ///< in equilibrium
  loose,  ///< both tendons slack: nothing holds the joint, and θ is arbitrary within the play
  /// No joint angle between the dead centres carries the load; the point repeats the last θ without tensions
  no_equilibrium,
};

/// State of the joint after one step. Energies and works are since home.
struct EquilibriumPoint {
  EquilibriumStatus status = EquilibriumStatus::held;
  double alpha = 0;  ///< rad
  double theta = 0;  ///< rad
  /// Rotation in −θ and in +θ until a tendon is taut, for a loose joint. rad
  double loose_below = 0;
  double loose_above = 0;
  TendonState t1;  ///< left
  TendonState t2;  ///< right
  /// Torque of the motor on the pulley, towards +α: T2_low p2 − T1_low p1, N·mm.
  double motor_torque = 0;
  double load_torque = 0;  ///< against +θ, N·mm
  /// Joint stiffness with the pulley fixed and no material crossing the pins, N·mm/rad: small disturbances, upper spans
  /// only.
  double stiffness_stuck = 0;
  /// Joint stiffness with pins and groove sliding at the present tension ratios: large disturbances, whole tendons.
  double stiffness = 0;
  double stored = 0;           ///< elastic energy relative to the unloaded home position, N·mm
  double friction = 0;         ///< work lost since home at pins, drum, sheaths and bearing, N·mm
  double groove_friction = 0;  ///< work lost since home in the grooves, N·mm
};

/// A joint in motion. A copy is a snapshot that continues from the same history.
class JointMotion {
 public:
  /// Starts at home, unloaded (without weight and spring): tendon 1 at the pretension, tendon 2 in balance with it,
  /// equal tension in both spans of each.
  explicit JointMotion(JointModel model);
  JointMotion(const JointMotion& other);
  JointMotion& operator=(const JointMotion& other);
  JointMotion(JointMotion&&) noexcept;
  JointMotion& operator=(JointMotion&&) noexcept;
  ~JointMotion();

  /// Moves directly to `step` and stays there. Within one step each pin slips at most one way, so steps should be about
  /// a degree. Without equilibrium the history is unchanged. Never returns NaN.
  EquilibriumPoint to(const JointStep& step);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Moves from home through all `steps` in order.
std::vector<EquilibriumPoint> follow(const JointModel& model, const std::vector<JointStep>& steps);

// ---- Identified joint -----------------------------------------------------------------------------------------------
// Application of identified deviations: computes the mounted joint and the pulley to make for it, so that the joint
// follows its target motion.
//
// Every command that needs the real joint calls identified_joint(). No later stage reads [identified], and the
// declaration is never overwritten.

/// The declared mechanism with the pins, length, friction and tendon of `imperfections`.
MountedMechanism mounted(const Mechanism& declared, const Imperfections& imperfections);

/// The identified joint, and the pulley to make for it.
struct IdentifiedJoint {
  /// The mounted mechanism with its identified weight. [pulley], range and shrinkage describe the pulley to make:
  /// deflected by the mean load, the joint follows the declared θ(α), and scale errors of making are compensated.
  Mechanism mechanism;
  /// Further manufacturing errors, which draw_for_making() compensates.
  OutlineError outline;
};
/// Accuracy of the compensating law of a compliant joint. whole: for the part to make. brief: 0.1°, about twenty times
/// as fast, for searches over hundreds of mechanisms.
enum class LawSearch { whole, brief };
/// Returns the declared mechanism when nothing relevant was identified.
IdentifiedJoint identified_joint(const DeclaredMechanism& declared, LawSearch search = LawSearch::whole);

/// The joint that a measurement is compared with: identified, with the pulley made for it, and with empty `identified`.
DeclaredMechanism expected_joint(const DeclaredMechanism& declared);

/// A curve point, displaced so that the manufacturing errors move it to its intended place.
profile::OutlinePoint drawn_for_making(profile::OutlinePoint point, const OutlineError& outline);
/// Displaces all points of both curves.
void draw_for_making(profile::SynthesisResult& synthesis, const OutlineError& outline);
/// The conditions that displaced curves violate, one per affected pulley. The correction of a wave may turn a sharp
/// bend inward.
std::vector<profile::Condition> turns_inward_as_drawn(const profile::SynthesisResult& drawn,
                                                      const OutlineError& outline);
/// Inverse of draw_for_making(): a closed floor with the manufacturing errors.
Polygon as_made(Polygon drawn, const OutlineError& outline);
/// Inverse of draw_for_making() for an open line. Normals are averaged over `beside` points on either side.
Polygon line_as_made(Polygon drawn, const OutlineError& outline, std::size_t beside);
/// An equivalent joint for a groove floor with an offset error. The tendon's radius is larger by that offset, and the
/// radii of pins and drum are smaller by it, so that all centre lines are those of the real joint.
Mechanism with_inset(const IdentifiedJoint& joint);

/// Assembly angle: position of the motor at which the tendons are tied, with the unloaded joint at home, so that the
/// loaded joint follows its target motion. rad. No pulley can correct it: assembled at 0, the joint has this offset at
/// every α, and compensation.csv contains it. 0 for a joint declared by a ratio.
double assembly_angle(const DeclaredMechanism& declared);

/// Choice of a round P1: allowed when the best r1 for the identified joint follows its compensating law closely enough.
struct RoundChoice {
  double r1 = 0;         ///< mm
  double max_error = 0;  ///< maximum error of θ, rad
  bool suffices = false;
};
/// The best round P1. Requires law = "compensate".
RoundChoice round_choice(const DeclaredMechanism& declared);

// ---- Simulation -----------------------------------------------------------------------------------------------------
// Simulation of a joint along logged motor angles, including its sensor.

/// Readings of the joint sensor, rad, per run and row.
using Readings = std::vector<std::vector<double>>;

/// State of the joint during the first runs of a log.
struct EarlierState {
  Imperfections joint;
  std::size_t runs = 0;  ///< number of runs in this state; the others were made later
};

/// Predicted readings of the joint `declared` with these imperfections. NaN where the joint has no equilibrium.
Readings predict(const Mechanism& declared, const Imperfections& imperfections, const BenchLog& log);

/// Predicted readings with runs of an earlier state, if any: `imperfections` are added to it and act only in the later
/// runs.
Readings predict(const Mechanism& declared, const Imperfections& imperfections, const BenchLog& log,
                 const std::optional<EarlierState>& earlier);

/// State of the joint at a row of a log. Unknown values are NaN. A joint declared by a ratio has only angles.
struct JointState {
  EquilibriumStatus status = EquilibriumStatus::held;
  double theta = std::numeric_limits<double>::quiet_NaN();  ///< true joint angle, rad; NaN without an equilibrium
  /// Reading of the joint's sensor, rad, as predict() returns it.
  double shown = std::numeric_limits<double>::quiet_NaN();
  double loose = 0;              ///< largest deviation from theta within the play, rad
  TendonState t1 = {}, t2 = {};  ///< left, right; N, mm
  double motor_torque = std::numeric_limits<double>::quiet_NaN();  ///< towards +α, N·mm
};

/// The states of the joint `declared` with these imperfections, per run and row.
std::vector<std::vector<JointState>> simulate(const Mechanism& declared, const Imperfections& imperfections,
                                              const BenchLog& log);

}  // namespace fusee::joint
