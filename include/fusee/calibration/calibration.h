/// \file
/// From a measured residual to named effects with their evidence.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fusee/base/run_context.h"
#include "fusee/joint/simulate.h"
#include "fusee/measurement/measurement.h"
#include "fusee/mechanism/effect.h"
#include "fusee/plan/bench_run.h"

namespace fusee {

struct CalibrationOptions {
  std::vector<std::string>
      hold_out;                  ///< names of runs kept for validation only; empty: whole runs are left out in turn
  bool look_for_effects = true;  ///< false: the file is known not to be of this joint (is_plainly_a_slip())
  bool audit = true;             ///< simulate joints without what was found, and count how often it would be named
  /// Beside those of the program, or in the place of one of the same name; they must outlive the call.
  std::vector<const Effect*> more_effects;
  std::vector<std::string>
      without;  ///< names of effects that are left out of the catalogue: what if none knew of them?
  /// The first runs were made in this state. Effects are then changes: added to it, they act in the later runs alone,
  /// beside a discrepancy that both states share. Fitted parameters are those of the later state, Calibration::identified
  /// is what was added, and no further runs are asked for.
  std::optional<EarlierState> earlier = {};
  RunContext context = {};
};

struct FittedParameter {
  std::string name;  ///< "EA_N": the unit stands in the name
  double value = 0;  ///< in that unit
  double low = 0;    ///< 95 % interval, whatever else of the catalogue may be there beside it
  double high = 0;
  double low_if_only = 0;  ///< the same if the effects that were found are all there is: never wider
  double high_if_only = 0;
  /// Its sign in words ("pins too high"), as far as the narrower interval knows it; empty where nothing
  /// has to be said.
  std::string sense = {};
};

/// Joints simulated without an effect, and in how many of them the same runs would have named it.
struct Audit {
  int worlds = 0;  ///< 0: not asked
  int named = 0;
};

/// Stands in a group beside names: what is there may have none.
inline constexpr const char* k_unmodelled = "unmodelled";

/// Something without a name that would do what a named effect does.
struct Unmodelled {
  /// Nats by which the data are likelier with the effect, whatever else has no name beside either; infinite: not asked.
  double behind = std::numeric_limits<double>::infinity();
  std::string words;           ///< what it would be: "a wave of 5.2 times a turn of the motor"; "" where nothing is
  std::string separating_run;  ///< what would tell it from the effect
  std::string doubt;           ///< why it may be that whatever the data say of it in the effect's place, or ""
};

/// Whether an effect is one thing: as large in every run, either way, everywhere and under any load.
struct Evenness {
  double uneven = 0;           ///< nats by which the data are likelier where it may be of another size …
  std::string words;           ///< … "from run to run"
  std::string separating_run;  ///< what would show whether it is
  /// What it does, rms, by what is left beside all that was found; infinite: not asked.
  double part = std::numeric_limits<double>::infinity();
};

/// A member of a group with its numbers.
struct MemberBeside {
  std::string name;
  std::vector<FittedParameter> parameters;
};

/// One effect that the data ask for, with all that would do as well.
struct FoundEffect {
  std::string name;
  /// `name` and every effect that would do nearly as well in its place; k_unmodelled where the data do not say that it
  /// is anything with a name.
  std::vector<std::string> group;
  ChainPlace place = ChainPlace::joint;
  std::vector<FittedParameter> parameters;
  /// Members of `group` that foretell runs that were left out better where they are there too.
  std::vector<MemberBeside> beside;
  /// Members of `group` that would do in its place, each with the numbers that it would have there.
  std::vector<MemberBeside> instead;
  double rms_drop = 0;  ///< of the held-out residual, rad; never below 0
  /// True if effects that do nothing explained the data as well in its place. An unmodelled cause then does, too.
  bool idle_did_as_well = false;
  double share = 0;     ///< part of the declared joint's held-out mean square that goes with it, 0 … 1
  double evidence = 0;  ///< log of how many times less likely the data are without it
  Audit audit;
  Unmodelled unmodelled;
  Evenness evenness;
  CorrectableBy correctable_by = CorrectableBy::nothing;
  /// A change's size by the standard error that the scatter from run to run gives it; infinite: not asked.
  double by_runs = std::numeric_limits<double>::infinity();
};

/// A candidate that was tried: the evidence for it, or against.
struct Candidate {
  std::string name;
  double evidence = 0;  ///< log of how many times likelier the data are with it than without
  bool accepted = false;
  std::string why;  ///< in words
};

/// A part of the error without a name: on what it depends, how large it is.
struct Unknown {
  std::string factor;   ///< "place", "direction", "load" …
  double order = 0;     ///< of a harmonic: times a turn; else 0
  double rms = 0;       ///< rad, over all rows in use
  double evidence = 0;  ///< log of how many times less likely the data are without it
  std::string words;    ///< on what it depends, and where in the chain such a thing can sit
  /// Its course over the seen span, rad: of what is in proportion to something at its largest, the motor on its way up
  /// and the load positive; none where place says nothing.
  std::vector<double> alpha;
  std::vector<double> theta;
};

/// What has no name and depends on place and direction alone, as a curve: for a table, and valid only where and as it
/// was seen. rad
struct EmpiricalCurve {
  bool used = false;          ///< data that it was not made from are nearer to the model with it, at every level
  std::string why;            ///< why not; "" of one that is used, and where nothing is without a name
  std::vector<double> alpha;  ///< places between which it is straight, over all that was seen both ways; none: no curve
  std::vector<double> up;     ///< measured − model there, α growing …
  std::vector<double> down;   ///< … and falling
  double held_out_effects = 0;  ///< rms of data that neither effects nor curve were made from: with the effects alone …
  double held_out_rms = 0;      ///< … and with the curve
  /// What the curve takes away there: its square is that of the one less that of the other.
  double gain = 0;

  /// Of a curve that is there, flat beyond its ends.
  double at(double place, bool rising) const;
};

struct ErrorFigures {
  double rms = 0;  ///< rad
  double max = 0;
  double held_out_rms = 0;
};

/// Rms over the later runs of what the earlier state does not show, rad: the discrepancy that both states share is taken
/// away.
struct StateDifference {
  double before = 0;  ///< with the joint as it was
  double after = 0;   ///< with the changes
};

struct Detectable {
  std::string name;
  double smallest = 0;  ///< rad at the joint
};

/// word() in words.h has the words.
enum class CalibrationVerdict { not_testable, not_repeatable, unexplained, confounded, explained, no_effect };

/// Rows that were left out, and the joint as all others have it.
struct LeftOut {
  std::vector<std::string> runs;  ///< names
  Imperfections identified;
};

struct Calibration {
  CalibrationVerdict verdict = CalibrationVerdict::not_testable;
  std::string summary;  ///< two sentences that a person can act on
  std::vector<FoundEffect> effects;
  Imperfections identified;       ///< what the effects amount to; all zero without any
  std::vector<LeftOut> left_out;  ///< by which a correction is measured; each run in one of them, or those kept
  /// Effects that fit the runs and are not reported: with them rows that were not fitted are predicted worse.
  std::vector<std::string> dropped;
  std::string noise_varies;  ///< how the noise depends on load and speed, in a sentence; "" where it does not
  std::vector<Candidate> tried;
  NoiseFloor noise;
  ErrorFigures before, after;
  StateDifference difference;                         ///< where CalibrationOptions::earlier is given
  std::vector<std::vector<double>> residuals_before;  ///< rad, run by run, sample by sample
  std::vector<std::vector<double>> residuals_after;
  std::vector<std::string> held_out_factors;  ///< "load", "speed"
  std::vector<std::string> held_out_runs;
  double rest_autocorrelation = 0;  ///< of the residual after all effects, row to row; 0: white
  double unexplained_rms = 0;
  std::vector<Unknown> unknown;   ///< the largest first
  std::vector<Unknown> instead;   ///< without a name, and as likely as names that were taken in its place
  EmpiricalCurve curve;           ///< of what of it depends on place and direction alone
  std::string unexplained_where;  ///< where in α, which direction, load, harmonic
  std::vector<Detectable> detectable;
  std::vector<std::string> null_combinations;  ///< accepted effects and rivals that do as well, with their numbers
  std::vector<NextMeasurement> next;           ///< the most decisive first
  Iso230 iso_before, iso_after;
};

/// Nothing is fitted before the noise floor is known; nothing is accepted that does not hold on data it did not see.
Calibration calibrate(const DeclaredMechanism& declared, const Measurement& measurement,
                      const CalibrationOptions& options = {});

}  // namespace fusee
