/// \file
/// Forces, stiffness and sources of error over the range of a joint.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fusee/base.h"
#include "fusee/joint.h"
#include "fusee/mechanism_file.h"
#include "fusee/profile.h"
#include "fusee/transmission.h"

namespace fusee::analysis {

// ---- Analysis -------------------------------------------------------------------------------------------------------
// Analysis of the transmission and its forces over the range: the paper's formulas, the full model, and the sources of
// joint angle errors.

/// Size and seed of analyse().
struct AnalysisOptions {
  int steps = 60;                    ///< steps of the table; home is an additional row
  double dimension_tolerance = 0.1;  ///< of every dimension in the error budget, 95 % within ±, mm
  int samples = 1000;                ///< samples of the Monte Carlo simulation
  std::uint64_t seed = 1;
};

/// One point of the stroke. The full model has completed a cycle before, so that its start has no influence.
struct AnalysisRow {
  transmission::TransmissionPoint declared;
  transmission::PaperForces paper;
  joint::EquilibriumPoint rising;   ///< full model, α increasing
  joint::EquilibriumPoint falling;  ///< full model, α decreasing
};

/// A maximum and its position.
struct Extreme {
  double value = 0;
  double alpha = 0;  ///< rad
};

/// A maximum tension, its position, its tendon and span, and the direction of motion.
struct TensionExtreme {
  double tension = 0;  ///< N
  double alpha = 0;    ///< rad
  transmission::Side tendon = transmission::Side::right;
  bool below_pin = false;
  bool rising = false;  ///< α increasing
};

/// A tendon that rubs on the joint's drum. The tension at its end is that of the span times a factor between 1/ratio
/// and ratio.
struct DrumHold {
  transmission::Side tendon = transmission::Side::right;
  double wrap = 0;   ///< maximum wrap angle on the drum, rad
  double ratio = 1;  ///< e^{μφ} at that wrap
  Extreme at_end;    ///< maximum tension at its end, N
};

/// A part of the range, delimited by rows of the table. rad.
struct AlphaRange {
  double from = 0;
  double to = 0;
};

/// Deviation of the joint from its target motion over the range due to one cause. rad.
struct ErrorSource {
  std::string name;     ///< "pin_radius_ignored"
  std::string meaning;  ///< description for a person
  double least = 0;     ///< most negative deviation of θ
  double most = 0;      ///< most positive deviation of θ
  double worst_at = 0;  ///< α of the larger of both magnitudes
};

/// Effect of a dimension's tolerance: half widths of the 95 % interval, at the α where they are largest.
struct ToleranceEffect {
  std::string key;                 ///< "guides.EB_mm"; "print_offset" (offset of both pulleys); "all"
  double theta_by_derivative = 0;  ///< error of the joint angle with tendon 1 taut, rad
  double theta_by_monte_carlo = 0;
  double theta_at = 0;              ///< α, rad
  double excess_by_derivative = 0;  ///< excess length of tendon 2, mm
  double excess_by_monte_carlo = 0;
  double excess_at = 0;
};

/// Known strength of a tendon.
struct Strength {
  double tension = 0;  ///< without a knot, N
  double at_knot = 0;  ///< N
  std::string source;  ///< "tendon.strength_N", or the tendon of the catalogue
};

/// Requirements of the joint on its motor, beside the limits of the motor.
struct MotorCheck {
  std::string model;              ///< of the catalogue; "" for a motor with numbers of its own
  bool enforced = false;          ///< the joint is refused unless every condition holds
  bool holds = false;             ///< the motor can hold its torque continuously
  double travel = 0;              ///< required: from the lowest α to the highest, rad
  double travel_limit = 0;        ///< rad; this and the other limits are 0 where they are unknown
  Extreme torque;                 ///< required: largest magnitude under the load, in both directions, N·mm
  double torque_limit = 0;        ///< at stall, N·mm
  double ratio = 0;               ///< largest |dα/dθ|
  double speed_limit = 0;         ///< of the motor without load, rad/s
  double joint_speed_free = 0;    ///< speed of the joint without load, where it is lowest, rad/s
  double joint_speed = 0;         ///< the same under the load, rad/s
  double joint_speed_needed = 0;  ///< rad/s; 0: none is required
  /// "motor_travel", "motor_torque", "motor_speed": those with a known limit.
  std::vector<profile::Condition> conditions;
  /// Models of the catalogue behind the file's gearbox, "NEMA17-48mm 5:1": those that fit the bore first, or the input
  /// of the gearbox; the weakest first. Behind a gearbox the model of the file is the first, and no other has a horn.
  std::vector<std::string> sufficient_models;
  std::vector<double> sufficient_torques;  ///< their stall torques behind the gearbox, N·mm
  std::size_t fitting_models = 0;          ///< number of sufficient_models that fit the bore, or the gearbox
  bool is_fit_known = false;               ///< the file states a shaft, a horn, or a model behind its gearbox
  bool has_gearbox = false;
  std::string strongest_model;  ///< of the catalogue, of those that fit the bore; "" without one
  std::string misfit;           ///< why the model does not fit the bore; "" if it does
  std::string misfit_hint;
  /// Set by the caller: changes with which every condition holds and the pulley passes every check of a full build.
  profile::Advice advice;

  bool ok() const { return profile::failed_of(conditions).empty(); }
  /// "N20-298-LP, the strongest that fits the bore, has margin 1.03, and 2 is advised"; "" if that model suffices, or if
  /// the catalogue has none that fits.
  std::string strongest_text() const;
  /// "suitable: XL330-M288 (margin 2.4) or 12 more", "suitable with another bore: …", "no motor of the catalogue
  /// suffices". Models with another bore or gearbox are a text of their own. The margin is that of the torque.
  std::vector<std::string> models_texts() const;
  /// models_texts() in one line.
  std::string models_text() const;
};

/// The full model over the range under [load] and [spring]: what a build reports beside its geometric error.
struct UnderLoad {
  std::vector<AnalysisRow> rows;
  TensionExtreme largest_tension;
  Extreme largest_at_joint;  ///< tension at the ends of both tendons: the load of a knot at C, N
  Extreme largest_torque;    ///< magnitude of the motor torque, N·mm
  Extreme hysteresis;        ///< largest |θ rising − θ falling| at one α, rad
  Extreme theta_error;       ///< largest |θ − declared θ| in either direction, rad
  /// Ranges in which tendon 1 is slack (without tension) in either direction.
  std::vector<AlphaRange> slack1;
  std::vector<AlphaRange> slack2;
  std::vector<AlphaRange> untensioned;  ///< where both are slack, and nothing holds the joint
  /// The minimum pretension of tendon 1 that keeps both tendons taut over the range, N. Set if a tendon is slack and
  /// such a pretension exists.
  std::optional<double> taut_pretension;
  std::optional<double> lost_at;  ///< α of the first row without equilibrium
  std::optional<Strength> strength;
  /// α of the row where the largest tension exceeds the strength, or the tension at the joint the strength at a knot.
  std::optional<double> breaks_at;
  std::optional<MotorCheck> motor;  ///< for a mechanism with [motor]

  /// Breaking strength per largest tension, or that of a knot per tension at the joint if it is less. Empty if the
  /// strength is unknown or no tendon is tensioned.
  std::optional<double> safety_factor() const;
  /// The least tension of any tendon in both directions, with its place, N. Empty if one is slack, or without
  /// equilibrium.
  std::optional<Extreme> least_tension() const;
  /// True if these ranges of slack are the whole range.
  bool is_whole_range(const std::vector<AlphaRange>& ranges) const;
};

/// Result of analyse(). Rows follow α over the range.
struct AnalysisResult : UnderLoad {
  /// True if the law and both tendon paths exist over the range. Otherwise only `obstacles` and `advice` are set.
  bool exists = false;
  /// Failed conditions of a pulley. With `exists`, forces are known though no pulley can be made.
  std::vector<profile::Condition> obstacles;
  std::vector<profile::Change> advice;                 ///< searched only if the law does not exist
  std::optional<profile::LayoutAdvice> layout_advice;  ///< as `advice`; set by the caller, who tries it by a build

  profile::SynthesisResult synthesis;  ///< the curves, if they can be drawn; its stroke has the same points as the rows
  std::vector<DrumHold> on_drum;       ///< tendons that rub on a drum
  Extreme largest_paper_tension;       ///< T_b
  std::vector<ErrorSource> sources;
  std::vector<ToleranceEffect> tolerances;  ///< by key; "all" last
  std::vector<Diagnostic> warnings;         ///< set by the caller: plausibility warnings of the file
};

/// Analyses a joint with tendons over its range. A law that does not exist is a value. Throws Stopped.
AnalysisResult analyse(const Mechanism& mechanism, const AnalysisOptions& options = {}, const RunContext& context = {});

/// The effects of the load at `steps` + 1 angles of the range and at home. The law must exist over the range.
UnderLoad under_load(const Mechanism& mechanism, int steps = AnalysisOptions{}.steps);

/// An error, without a place, for a load that no joint angle carries. Null if the joint has an equilibrium over the
/// whole range.
std::optional<Diagnostic> no_equilibrium(const UnderLoad& load);

/// The conditions of the mechanism's motor that fail, for searches. If its travel is too small, only this condition is
/// returned, and no equilibrium is computed. The law must exist over the range.
std::vector<profile::Condition> motor_obstacles(const Mechanism& mechanism);
/// A warning, or an error if the motor is enforced, for each failed condition, at the key of its limit. The hint
/// contains the advice and the models that would suffice.
std::vector<Diagnostic> motor_warnings(const MotorCheck& motor, const MechanismFile& file);

/// Deviations of θ from the target motion by single causes: stretch, friction, and simplifications in drawing a pulley.
std::vector<ErrorSource> error_sources(const Mechanism& mechanism);
/// Tolerance effects of every dimension by both methods.
std::vector<ToleranceEffect> tolerance_effects(const Mechanism& mechanism, const AnalysisOptions& options,
                                               const RunContext& context = {});
/// "tendon 2 below pin D"; with a sheath there is no pin below: "tendon 2 between sheath and pulley".
std::string place_words(const TensionExtreme& extreme, const Mechanism& mechanism);
/// Maximum tensions of the tendons.
struct LargestTensions {
  TensionExtreme anywhere;
  Extreme at_joint;  ///< at the ends of both tendons: the knots at C, N
};
/// Maximum tensions of the full model in a cycle through `alphas` (increasing, with both ends of the range).
LargestTensions largest_tensions(const Mechanism& mechanism, const std::vector<double>& alphas);
/// The declared strength, or that of the catalogue's tendon with this diameter and modulus.
std::optional<Strength> tendon_strength(const Tendon& tendon);
/// As tendon_strength(), or an estimate, described as such, from the nearest tendon of the catalogue by its
/// cross-section.
std::optional<Strength> likely_strength(const Tendon& tendon);
/// An error, without a place, for a tendon that breaks at its knot at C or elsewhere. Null if it holds.
std::optional<Diagnostic> tendon_breaks(const LargestTensions& largest, const Strength& strength);

// ---- Stroke ---------------------------------------------------------------------------------------------------------
// The full model over a cycle of the declared load, after settling.

/// The settled joint at one α, in both directions of motion.
struct StrokePoint {
  joint::EquilibriumPoint rising;   ///< α increasing
  joint::EquilibriumPoint falling;  ///< α decreasing
};

/// The third cycle from home at each of `alphas` (increasing, with both ends of the range).
std::vector<StrokePoint> settled_stroke(const Mechanism& mechanism, const std::vector<double>& alphas);

}  // namespace fusee::analysis
