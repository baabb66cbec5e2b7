/// \file
/// The transmission and its forces over the whole range: the paper's chain beside the full model, and what makes the
/// joint miss its angle.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fusee/base/diagnostics.h"
#include "fusee/joint/equilibrium.h"
#include "fusee/profile/synthesis.h"
#include "fusee/transmission/tension.h"

namespace fusee {

struct AnalysisOptions {
  int steps = 60;          ///< of the table; home is a row of its own
  double tolerance = 0.1;  ///< of every dimension in the error budget: 95 % lie within ± this, mm
  int samples = 1000;      ///< of the Monte Carlo
  std::uint64_t seed = 1;
  std::function<void()> between_samples =
      {};  ///< called for each joint of the Monte Carlo; what it throws stops the work
};

/// One place of the stroke. The full model has been through a cycle before, so that where it started is forgotten.
struct AnalysisRow {
  TransmissionPoint declared;
  PaperForces paper;
  EquilibriumPoint rising;   ///< full model, α growing
  EquilibriumPoint falling;  ///< α falling
};

/// A largest value and where it is.
struct Extreme {
  double value = 0;
  double alpha = 0;  ///< rad
};

struct TensionExtreme {
  double tension = 0;  ///< N
  double alpha = 0;    ///< rad
  Side tendon = Side::right;
  bool below_pin = false;
  bool rising = false;  ///< α growing
};

/// One tendon that rubs on the joint's drum: its end is at what the span has, but for a factor within 1/ratio … ratio.
struct DrumHold {
  Side tendon = Side::right;
  double wrap = 0;   ///< the largest angle that it lies on the drum with, rad
  double ratio = 1;  ///< there: e^{μφ}
  Extreme at_end;    ///< the largest tension at its end, N
};

/// A part of the range, by the table's rows. rad.
struct AlphaRange {
  double from = 0;
  double to = 0;
};

/// By how much one cause moves the joint from the declared law, over the range. rad.
struct ErrorSource {
  std::string name;     ///< "pin_radius_ignored"
  std::string meaning;  ///< for a person
  double least = 0;     ///< most negative deviation of θ
  double most = 0;
  double worst_at = 0;  ///< α of the larger of both
};

/// What a dimension's tolerance does. Half widths of the range that holds 95 %, at the α where they are largest.
struct ToleranceEffect {
  std::string key;                 ///< "guides.EB_mm"; "print_offset" (both pulleys larger all round); "all"
  double theta_by_derivative = 0;  ///< of the joint angle, tendon 1 taut, rad
  double theta_by_monte_carlo = 0;
  double theta_at = 0;             ///< α, rad
  double slack_by_derivative = 0;  ///< of tendon 2, mm
  double slack_by_monte_carlo = 0;
  double slack_at = 0;
};

/// What a tendon bears, where it is known.
struct Strength {
  double tension = 0;  ///< without a knot, N
  double at_knot = 0;  ///< N
  std::string source;  ///< "tendon.strength_N", or the tendon of the catalogue
};

struct AnalysisResult {
  /// The law and both tendon paths exist over the range. Else everything but `obstacles` and `advice` is empty.
  bool exists = false;
  std::vector<Condition>
      obstacles;  ///< failed conditions of a pulley; with `exists`, forces are known though no pulley can be made
  std::vector<Change> advice;  ///< searched only when it does not exist

  std::vector<AnalysisRow> rows;
  SynthesisResult synthesis;       ///< the curves, where they can be drawn; its stroke has the rows' places
  TensionExtreme largest_tension;  ///< full model
  Extreme largest_at_joint;        ///< of both tendons at their ends, full model: what a knot at C bears, N
  std::vector<DrumHold> on_drum;   ///< of the tendons that rub on a drum; empty where nothing does
  Extreme largest_paper_tension;   ///< T_b
  Extreme largest_torque;          ///< of the motor, |.|, full model, N·mm
  Extreme hysteresis;              ///< largest |θ rising − θ falling| at one α, rad
  std::vector<AlphaRange> slack1;  ///< where tendon 1 is slack (rising)
  std::vector<AlphaRange> slack2;
  std::vector<AlphaRange> untensioned;  ///< where both are: nothing holds the joint
  /// The least pretension of tendon 1 that keeps both tendons taut all over the range, N; when one is slack and there
  /// is such a pretension.
  std::optional<double> taut_pretension;
  std::optional<double> lost_at;  ///< α of the first row without equilibrium
  std::optional<Strength> strength;
  /// α of the row at which the largest tension passes the strength, that above the pins the strength at a knot.
  std::optional<double> breaks_at;
  std::vector<ErrorSource> sources;
  std::vector<ToleranceEffect> tolerances;  ///< by key; "all" last
  std::vector<Diagnostic> warnings;         ///< by the verb: what plausibility.h doubts in the file
};

AnalysisResult analyse(const Mechanism& mechanism, const AnalysisOptions& options = {});

/// Deviations of θ from the declared law, each cause alone: stretch, friction, and what is ignored when a pulley is
/// drawn.
std::vector<ErrorSource> error_sources(const Mechanism& mechanism);
/// Both roads for every dimension of the mechanism.
std::vector<ToleranceEffect> tolerance_effects(const Mechanism& mechanism, const AnalysisOptions& options);
/// "tendon 2 below pin D"; behind a sheath there is no pin: "tendon 2 between sheath and pulley".
std::string place_words(const TensionExtreme& extreme, const Mechanism& mechanism);
/// What the tendons bear at most.
struct LargestTensions {
  TensionExtreme anywhere;
  Extreme at_joint;  ///< of both tendons: at the knots at C, N
};
/// Of the full model on the way up and down through `alphas` (increasing, both ends of the range among them).
LargestTensions largest_tensions(const Mechanism& mechanism, const std::vector<double>& alphas);
/// The declared strength, or that of the catalogue's tendon with this diameter and modulus.
std::optional<Strength> tendon_strength(const Tendon& tendon);
/// The same, or else an estimate that says so: the nearest tendon of the catalogue, by its section.
std::optional<Strength> likely_strength(const Tendon& tendon);
/// What to say of a tendon that breaks, at its knot at C or elsewhere: an error, of no place. Nothing where it holds.
std::optional<Diagnostic> tendon_breaks(const LargestTensions& largest, const Strength& strength);

}  // namespace fusee
