/// \file
/// From a measured residual to identified effects with their evidence.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fusee/base.h"
#include "fusee/joint.h"
#include "fusee/measurement.h"
#include "fusee/plan.h"

namespace fusee {
struct Effect;  // mechanism/effect.h
}  // namespace fusee

namespace fusee::calibration {

// ---- Calibration ----------------------------------------------------------------------------------------------------
// Identification of joint errors from measurements: named effects with their evidence.

/// Search and validation of calibrate().
struct CalibrationOptions {
  std::vector<std::string> hold_out;  ///< names of runs for validation only; empty: whole runs are left out in turn
  bool search_effects = true;         ///< false: the file does not describe this joint (is_input_error_obvious())
  bool audit = true;                  ///< count false positives on synthetic data sets
  /// Added to the catalogue, or in the place of an effect of the same name; they must outlive the call.
  std::vector<const fusee::Effect*> more_effects;
  std::vector<std::string> without;  ///< names of effects that are excluded from the catalogue
  /// State of the joint in the first runs. Effects are then changes that act in the later runs only; both states share
  /// one discrepancy. Fitted parameters are those of the later state, Calibration::identified is the change, and no
  /// further runs are proposed.
  std::optional<joint::EarlierState> earlier = {};
  RunContext context = {};
};

/// Identified number of an effect, with its intervals.
struct FittedParameter {
  std::string name;  ///< "EA_N": the unit is part of the name
  double value = 0;  ///< in that unit
  double low = 0;    ///< 95 % interval, other effects of the catalogue marginalised
  double high = 0;
  double low_if_only = 0;  ///< 95 % interval if the found effects are the only ones: never wider
  double high_if_only = 0;
  /// Its sign in words ("both pulleys are too small") if the narrower interval has one sign; empty if it has no words.
  std::string sense = {};
  double rms = 0;              ///< its effect on the joint in these runs, rad; 0 if it was not fitted
  bool excludes_zero = false;  ///< true if the narrower interval of its effect does
};

/// Synthetic data sets without an effect, and in how many of them the effect would be reported.
struct Audit {
  int data_sets = 0;  ///< 0: no audit was made
  int false_positives = 0;
};

/// Name of the member that a group contains if its cause may be unmodelled.
inline constexpr const char* k_unmodelled = "unmodelled";

/// An unmodelled cause that would explain the same data as an effect.
struct UnmodelledAlternative {
  /// Log odds of the effect against the best unmodelled cause in its place, with unmodelled causes beside both;
  /// infinite: not computed.
  double log_odds = std::numeric_limits<double>::infinity();
  std::string words;           ///< the cause: "a wave of 5.2 times a turn of the motor"; "" without one
  std::string separating_run;  ///< run that distinguishes it from the effect
};

/// Member of a group with its parameters.
struct GroupMember {
  std::string name;
  std::vector<FittedParameter> parameters;
};

/// Effect that the data require, with every effect that explains them equally well.
struct FoundEffect {
  std::string name;
  /// `name` and every effect that is about equally likely in its place; k_unmodelled if the cause may be unmodelled.
  std::vector<std::string> group;
  ChainPlace place = ChainPlace::joint;
  std::vector<FittedParameter> parameters;
  /// Members of `group` with which held-out runs are predicted better when added to the found set.
  std::vector<GroupMember> beside;
  /// Members of `group` that can replace the effect, with the parameters that they have there.
  std::vector<GroupMember> alternatives;
  double rms_drop = 0;  ///< reduction of the held-out residual, rad; at least 0
  /// True if effects whose response is below the noise replaced it equally well. An unmodelled cause may then do so,
  /// too.
  bool idle_did_as_well = false;
  /// Share of the declared joint's held-out mean square that it removes, 0 … 1; of a change: StateChange::share.
  double share = 0;
  double evidence = 0;  ///< log Bayes factor of the set with it to the set without
  Audit audit;
  UnmodelledAlternative unmodelled;
  CorrectableBy correctable_by = CorrectableBy::nothing;
  /// Size of a change in standard errors, by the scatter from run to run; infinite: not computed.
  double by_runs = std::numeric_limits<double>::infinity();
};

/// Effect that was tested, with the evidence for or against it.
struct Candidate {
  std::string name;
  double evidence = 0;  ///< log Bayes factor of the set with it to the set without
  bool accepted = false;
  std::string why;  ///< reason for the decision, in words
};

/// Component of the model discrepancy: the factor that it depends on, and its size.
struct DiscrepancyComponent {
  std::string factor;   ///< "place", "direction", "load" …
  double order = 0;     ///< order of a harmonic, in periods a turn; otherwise 0
  double rms = 0;       ///< rad, over the rows in use
  double evidence = 0;  ///< log Bayes factor of the discrepancy with it to the discrepancy without
  std::string words;    ///< the dependence, and the parts of the chain that can cause it
  /// Component over the measured range of α, rad: for rising α, positive load, and the largest value of the factor that
  /// it scales with. Empty if it does not depend on place.
  std::vector<double> alpha;
  std::vector<double> theta;
};

/// Model discrepancy that depends on place and direction alone, as a curve for a table. Valid only over the measured
/// range and conditions. rad.
struct EmpiricalCurve {
  bool used = false;  ///< true if it lowers the error of held-out rows at every level of load and speed
  std::string why;    ///< why it is not used; "" if it is used, and if there is no discrepancy
  /// Nodes of the piecewise linear curve, over the range measured in both directions; empty: no curve.
  std::vector<double> alpha;
  std::vector<double> up;       ///< measured − model there, rising α
  std::vector<double> down;     ///< measured − model there, falling α
  double held_out_effects = 0;  ///< rms of held-out rows, corrected by the effects alone
  double held_out_rms = 0;      ///< rms of held-out rows, corrected by effects and curve
  /// Square root of the reduction of the held-out mean square by the curve, rad.
  double gain = 0;

  /// Value of a non-empty curve, constant beyond its ends.
  double at(double place, bool rising) const;
};

/// Deviation of the model from the measured θ, rad.
struct ErrorFigures {
  double rms = 0;  ///< rad
  double max = 0;
  double held_out_rms = 0;
};

/// Rms residual of the later runs after subtraction of the discrepancy that both states share, rad.
struct StateDifference {
  double before = 0;  ///< rms with the earlier joint
  double after = 0;   ///< rms with the changes
};

/// Effect that was not found, with the smallest size that these data show.
struct Detectable {
  std::string name;
  double smallest = 0;  ///< detectable error at the joint, rad
};

/// Outcome of calibrate(). word() in calibration/words.h gives its key in calibration.json.
enum class CalibrationVerdict { not_testable, not_repeatable, unexplained, confounded, explained, no_effect };

/// Held-out runs, and the joint that was identified from all other runs.
struct HeldOutFit {
  std::vector<std::string> runs;  ///< names
  Imperfections identified;
};

/// Result of calibrate(): effects, residuals, verdict and further measurements. rad.
struct Calibration {
  CalibrationVerdict verdict = CalibrationVerdict::not_testable;
  std::string summary;  ///< finding and figures in words
  std::vector<FoundEffect> effects;
  Imperfections identified;  ///< sum of all effects; all zero without any
  /// Estimates that validate a correction: each run is left out in one of them, or only the runs kept for validation.
  std::vector<HeldOutFit> left_out;
  /// Effects that fit the runs and are not reported, because held-out rows are predicted worse with them.
  std::vector<std::string> dropped;
  std::string noise_varies;  ///< dependence of the noise on load and speed, in a sentence; "" if there is none
  std::vector<Candidate> tried;
  measurement::NoiseFloor noise;
  ErrorFigures before;
  ErrorFigures after;          ///< corrected by the effects, and by the empirical curve if it is used
  ErrorFigures after_effects;  ///< corrected by the effects alone
  StateDifference difference;  ///< given if CalibrationOptions::earlier is
  /// rad, run by run, sample by sample; NaN in rows that are left out
  std::vector<std::vector<double>> residuals_before;
  std::vector<std::vector<double>> residuals_after;
  std::size_t rows_left_out = 0;  ///< rows far from their neighbours, which neither fits nor figures contain
  std::vector<std::string> held_out_factors;  ///< "load", "speed"
  std::vector<std::string> held_out_runs;
  double residual_autocorrelation = 0;  ///< lag-1 autocorrelation of the residual after all effects; 0: white
  double unexplained_rms = 0;
  std::vector<DiscrepancyComponent> discrepancy;  ///< components of the discrepancy, largest first
  EmpiricalCurve curve;                           ///< discrepancy that depends on place and direction alone
  std::string unexplained_where;                  ///< α, direction, load or harmonic at which the residual is largest
  std::vector<Detectable> detectable;
  std::vector<std::string> null_combinations;  ///< accepted effects and equally likely rivals, with their numbers
  std::vector<plan::NextMeasurement> next;     ///< most decisive first
  measurement::Iso230 iso_before, iso_after;
};

/// Identifies the effects of the catalogue that the data require. The noise floor is estimated first, from repeats.
/// Only effects that predict held-out rows are reported.
Calibration calibrate(const DeclaredMechanism& declared, const measurement::Measurement& measurement,
                      const CalibrationOptions& options = {});

/// Rejects the empirical curve of a calibration of `measurement`: no correction uses it, and no figure includes it.
void reject_curve(const measurement::Measurement& measurement, const std::string& why, Calibration& calibration);

// ---- Likely input errors --------------------------------------------------------------------------------------------
// Likely errors of the file or the logged columns (a wrong sign, unit or exchange), for data that no effect explains.
// Each hypothesis is corrected and compared with the same data.

/// Likely input error: the data are explained once it is corrected.
struct LikelyInputError {
  /// "guides.OE_mm"; "guides.EB_mm, guides.ED_mm" where two are exchanged; "load.tip_force_N" where nothing hung;
  /// "theta", "alpha" or both of the data; "alpha and theta at home" where neither sensor reads zero there.
  std::string key;
  std::vector<double> declared;  ///< values in the file, in its unit; 1 for a column of data
  std::vector<double> would_be;  ///< corrected values; for a column of data the factor on the logged angle, or degrees
  std::string question;          ///< question to the user: "is the sign right?"
  /// true if the pulley was made from the file as declared, and the joint is as corrected
  bool pulley_as_declared = false;
  /// Options of the same command that correct it, in a sentence; "" if the file or the log must be changed.
  std::string remedy = {};
  std::vector<std::string> beside = {};  ///< names of effects found in addition to it
  double rms = 0;                        ///< held-out rms after the correction, rad
};

/// Input errors whose correction explains the data, best first, equally likely ones after it. Empty if `found` explains
/// the data, or if no hypothesis does. `as_read`: runs before compare_with_declared().
std::vector<LikelyInputError> find_input_errors(const DeclaredMechanism& declared,
                                                const measurement::Measurement& as_read, const Calibration& found);

/// True if the residual of the declared file is far above the noise, but one corrected input error, without any fit,
/// leaves only noise or the residual of one fault. Effects fitted to such a file describe nothing, so the search for
/// effects is omitted.
bool is_input_error_obvious(const DeclaredMechanism& declared, const measurement::Measurement& as_read);

/// "guides.OE_mm = -40 in place of 40 would explain the data to 0.03°: is the sign right?"
std::string input_error_words(const LikelyInputError& error);

// ---- Comparison of two states ---------------------------------------------------------------------------------------
// Comparison of two measured states of one joint, by changes of the effects of the catalogue.

/// Outcome of compare_states().
enum class ComparisonVerdict { not_testable, not_comparable, no_change, changed };
/// Key in the JSON: "not_testable".
std::string_view word(ComparisonVerdict verdict);

/// Parameter of the joint in both states, in the unit that ends its name.
struct ChangedParameter {
  std::string name;
  double before = 0;
  double after = 0;
  double low = 0;  ///< 95 % interval of `after` − `before`
  double high = 0;

  double change() const { return after - before; }
};

/// Change that the runs show, with every change that explains them equally well.
struct StateChange {
  std::string name;
  std::vector<std::string> group;  ///< `name` first; k_unmodelled if the cause may be unmodelled
  ChainPlace place = ChainPlace::joint;
  std::vector<ChangedParameter> parameters;
  double rms_drop = 0;  ///< reduction of the held-out residual, rad
  double by_runs = 0;   ///< its size in standard errors, by the scatter from run to run
  double share = 0;     ///< share of the mean square of StateDifference::before that it removes, 0 … 1
};

/// Result of compare_states().
struct Comparison {
  ComparisonVerdict verdict = ComparisonVerdict::not_testable;
  std::string why;      ///< reason of not_testable and not_comparable: the fault, its place, the remedy
  Calibration before;   ///< calibration of the earlier runs alone
  Calibration changes;  ///< calibration of all runs, relative to the earlier state
  std::vector<StateChange> found;
  StateDifference difference;
};

/// Progress and stop of compare_states().
struct ComparisonOptions {
  RunContext context = {};
};

/// Runs of two states, compared with the declared joint.
struct ComparedRuns {
  measurement::Measurement before;
  measurement::Measurement after;
  measurement::Measurement both;  ///< earlier runs, then later runs
};

/// Calibrates the earlier runs, then searches the changes with which all runs are predicted. Runs that are not two
/// states of one joint give a verdict. Throws Stopped.
Comparison compare_states(const DeclaredMechanism& declared, const ComparedRuns& runs,
                          const ComparisonOptions& options = {});

}  // namespace fusee::calibration
