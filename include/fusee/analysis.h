/// \file
/// Forces, stiffness and sources of error over the range of a joint.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fusee/base.h"
#include "fusee/joint.h"
#include "fusee/profile.h"
#include "fusee/transmission.h"

namespace fusee::analysis {

// ---- Analysis -------------------------------------------------------------------------------------------------------
// Analysis of the transmission and its forces over the range: the paper's formulas, the full model, and the sources of
// joint angle errors.

struct AnalysisOptions {
  int steps = 60;          ///< steps of the table; home is an additional row
  double tolerance = 0.1;  ///< tolerance of every dimension in the error budget (95 % within ±), mm
  int samples = 1000;      ///< samples of the Monte Carlo simulation
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

/// Deviation of the joint from the declared law over the range due to one cause. rad.
struct ErrorSource {
  std::string name;     ///< "pin_radius_ignored"
  std::string meaning;  ///< description for a person
  double least = 0;     ///< most negative deviation of θ
  double most = 0;
  double worst_at = 0;  ///< α of the larger magnitude
};

/// Effect of a dimension's tolerance: half widths of the 95 % interval, at the α where they are largest.
struct ToleranceEffect {
  std::string key;                 ///< "guides.EB_mm"; "print_offset" (offset of both pulleys); "all"
  double theta_by_derivative = 0;  ///< error of the joint angle with tendon 1 taut, rad
  double theta_by_monte_carlo = 0;
  double theta_at = 0;             ///< α, rad
  double slack_by_derivative = 0;  ///< slack of tendon 2, mm
  double slack_by_monte_carlo = 0;
  double slack_at = 0;
};

/// Known strength of a tendon.
struct Strength {
  double tension = 0;  ///< without a knot, N
  double at_knot = 0;  ///< N
  std::string source;  ///< "tendon.strength_N", or the tendon of the catalogue
};

struct AnalysisResult {
  /// True if the law and both tendon paths exist over the range. Otherwise only `obstacles` and `advice` are set.
  bool exists = false;
  std::vector<profile::Condition>
      obstacles;  ///< failed conditions of a pulley; with `exists`, forces are known though no pulley can be made
  std::vector<profile::Change> advice;  ///< searched only if the law does not exist
  std::optional<profile::LayoutAdvice> layout_advice;  ///< as `advice`; set by the caller, who tries it by a build

  std::vector<AnalysisRow> rows;
  profile::SynthesisResult synthesis;  ///< the curves, if they can be drawn; its stroke has the same points as the rows
  TensionExtreme largest_tension;      ///< full model
  /// Maximum tension at the ends of both tendons, full model: the load of a knot at C, N.
  Extreme largest_at_joint;
  std::vector<DrumHold> on_drum;   ///< tendons that rub on a drum
  Extreme largest_paper_tension;   ///< T_b
  Extreme largest_torque;          ///< magnitude of the motor torque, full model, N·mm
  Extreme hysteresis;              ///< largest |θ rising − θ falling| at one α, rad
  std::vector<AlphaRange> slack1;  ///< where tendon 1 is slack (α increasing)
  std::vector<AlphaRange> slack2;
  std::vector<AlphaRange> untensioned;  ///< where both are slack, and nothing holds the joint
  /// The minimum pretension of tendon 1 that keeps both tendons taut over the range, N. Set if a tendon is slack and
  /// such a pretension exists.
  std::optional<double> taut_pretension;
  std::optional<double> lost_at;  ///< α of the first row without equilibrium
  std::optional<Strength> strength;
  /// α of the row where the largest tension exceeds the strength, or the tension at the joint the strength at a knot.
  std::optional<double> breaks_at;
  std::vector<ErrorSource> sources;
  std::vector<ToleranceEffect> tolerances;  ///< by key; "all" last
  std::vector<Diagnostic> warnings;         ///< set by the caller: plausibility warnings of the file
};

AnalysisResult analyse(const Mechanism& mechanism, const AnalysisOptions& options = {}, const RunContext& context = {});

/// Deviations of θ from the declared law by single causes: stretch, friction, and simplifications in drawing a pulley.
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

struct StrokePoint {
  joint::EquilibriumPoint rising;   ///< α increasing
  joint::EquilibriumPoint falling;  ///< α decreasing
};

/// The third cycle from home at each of `alphas` (increasing, with both ends of the range).
std::vector<StrokePoint> settled_stroke(const Mechanism& mechanism, const std::vector<double>& alphas);

}  // namespace fusee::analysis
