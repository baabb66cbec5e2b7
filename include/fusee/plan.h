/// \file
/// Experiment design: measurements at the bench, and the shortest set of runs that distinguishes the causes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fusee/base.h"
#include "fusee/joint.h"

namespace fusee {
struct EffectParameter;  // mechanism/effect.h
}  // namespace fusee

namespace fusee::plan {

// ---- Measurements at the bench --------------------------------------------------------------------------------------
// Measurements that a person can make at the bench: runs to drive and dimensions to read by hand. `fusee plan` and the
// next measurements of `fusee calibrate` share these types.

/// Range of motor angles, rad. Up to it, an error of period one turn is indistinguishable from a linear error.
inline constexpr double k_most_linear_range = radians(150.0);

/// A change on the bench before a run, undone after it.
enum class BenchChange {
  none,
  motor_sensor_turned,  ///< turned by a quarter turn against the pulley, home set again
  joint_sensor_turned,  ///< turned by a quarter turn against the joint, home set again
};
/// The instruction, such as "turn the joint's encoder on its axis by a quarter turn"; "" for none.
std::string_view words(BenchChange change);
/// The angles of both encoders on their shafts after that change.
joint::Mounting mounting_of(BenchChange change);

/// Strokes between two motor angles, there and back, at constant speed and load.
struct PlannedRun {
  double from = 0;  ///< motor angle at which the log begins, rad
  double to = 0;
  int cycles = 3;    ///< strokes there and back; the first stroke of a log only settles the play
  double speed = 0;  ///< of the motor, rad/s
  double load = 0;   ///< tip force, N; for a joint declared by a ratio in the unit of the log
  double dwell = 0;  ///< pause at the end of every stroke, s
  BenchChange change = BenchChange::none;
};

/// Duration of all strokes and dwells, min.
double minutes_of(const PlannedRun& run);
/// Time to hang the load and to turn the encoder there and back, min.
double setup_minutes_of(const PlannedRun& run);
/// A phrase such as "3 slow cycles at 5 N". `slow`, rad/s, is the speed that is called slow.
std::string words(const PlannedRun& run, double slow, const std::string& load_unit);
/// Rows that drive a simulation: `rows_a_stroke` rows evenly over every stroke, then the rows of its dwell.
joint::BenchRun driven(const PlannedRun& run, int rows_a_stroke);

/// A measurement that distinguishes causes that the runs so far do not.
struct NextMeasurement {
  std::optional<PlannedRun> run;  ///< a run to drive
  /// Parameters of one effect to read by hand, if there is no run. Without both, see `words`.
  std::vector<const fusee::EffectParameter*> readings;
  std::string words;  ///< the instruction
  std::string gain;   ///< what it distinguishes: "backlash from creep (4 × the uncertainty)"; "" if unknown
  std::vector<std::string> separates;  ///< names of effects; may include "unmodelled"
  double minutes = 0;                  ///< including the changes on the bench

  /// "run", "turn_sensor", the tool of a reading as "caliper", or "inspect".
  std::string_view kind() const;
  std::string text() const;  ///< `words` and `gain` in one sentence
};
/// A run with its instruction and minutes. `slow` and `load_unit` as in words().
NextMeasurement next_run(const PlannedRun& run, double slow, const std::string& load_unit);
/// Instruction of a hand measurement, with the form of the key that receives it: "enter it as prior.length_mm = [value,
/// uncertainty]".
std::string reading_words(const fusee::EffectParameter& reading);
/// Hand measurements of the parameters of one effect, at least one.
NextMeasurement next_reading(const std::vector<const fusee::EffectParameter*>& readings);
/// Any other measurement.
NextMeasurement next_inspection(const std::string& words);

/// Root mean square difference of two simulations of the same rows, rad. Rows without an angle do not count.
double rms_apart(const std::vector<std::vector<double>>& one, const std::vector<std::vector<double>>& other);

/// Parameters of this joint's effects that can be measured by hand and have no value in [prior] yet.
std::vector<const fusee::EffectParameter*> unread_numbers(const DeclaredMechanism& declared);

// ---- Plan -----------------------------------------------------------------------------------------------------------
// Experiment design: the shortest set of runs that distinguishes the causes which matter for this joint, the smallest
// size of each cause that these runs detect, and the expected false-positive rate.
//
// Each candidate run is simulated with each cause of the catalogue at its usual size (EffectParameter::prior). Two
// causes are resolved if their responses differ by more than the noise and by more than the accuracy of the model.
// Runs are chosen greedily by gain per minute. The model is linear in the causes, so sizes are right to some tens
// of percent.

/// Conditions at the bench.
struct PlanOptions {
  double noise = radians(0.02);  ///< standard deviation of the joint's sensor, rad
  double minutes = 15;           ///< time at the bench
  std::vector<double> loads;     ///< tip forces to hang on, N; empty: chosen by the planner
  std::vector<double> speeds;    ///< motor speeds, rad/s; empty: chosen by the planner. The lowest is called "slow"
  /// Motor range, rad. Default: the joint's range, or one turn for a joint declared by a ratio.
  std::optional<std::pair<double, double>> range;
  std::uint64_t seed = 1;  ///< seed of the synthetic data sets
};

/// A run, or a dimension to read by hand.
struct PlanStep {
  std::optional<PlannedRun> run;
  const fusee::EffectParameter* reading = nullptr;
  std::string words;
  double minutes = 0;                 ///< including the changes on the bench
  double setup_minutes = 0;           ///< part of `minutes` that the changes take
  double end_minute = 0;              ///< from the beginning of the plan to the end of this step
  std::vector<std::string> detects;   ///< causes that this step detects first
  std::vector<std::string> resolves;  ///< pairs that this step resolves first: "backlash from capstan_friction, creep"
};

/// A cause, and how well the planned runs detect it.
struct PlannedCause {
  std::string name;
  double usual = 0;     ///< response of the joint at the cause's usual size, rms over these runs, rad
  double smallest = 0;  ///< smallest detectable response, same measure
  /// Smallest response that identifies this cause alone; empty if another cause mimics it at every size.
  std::optional<double> smallest_alone;
  /// `smallest` as a value of the cause's first key of [identified]: {"backlash_deg", 0.03}.
  std::string key;
  double smallest_key = 0;
  std::vector<std::string> rivals;  ///< causes that these runs do not distinguish from it at its usual size
};

/// Outcomes over synthetic data sets whose cause is known.
struct FalsePositives {
  int samples = 0;
  int wrong = 0;  ///< data sets for which only causes that are not present were reported
  int alone = 0;  ///< data sets for which the true cause was reported alone
  int group = 0;  ///< data sets for which the true cause was reported in a group
};

/// Result of plan_runs().
struct Plan {
  std::vector<PlanStep> steps;                                ///< by gain per minute; empty if no run fits
  std::vector<PlanStep> beyond;                               ///< steps that more minutes would add
  double minutes = 0;                                         ///< of all steps
  std::vector<PlannedCause> causes;                           ///< in the order of the drive chain
  std::vector<std::pair<std::string, std::string>> left_out;  ///< effects without a plan, and the reason
  std::vector<std::vector<std::string>> groups;               ///< causes that the runs do not resolve
  FalsePositives nothing;                                     ///< over data sets without a cause
  FalsePositives one;                                         ///< over data sets with one cause
  FalsePositives unmodelled;  ///< over data sets with one cause that is not in the catalogue
  double slow = 0;            ///< rad/s
  double from = 0, to = 0;    ///< motor range, rad
  std::string load_unit = "N";
  int first_run = 1;  ///< number of the first run's file
  /// Largest magnitude of a load at which both tendons of the declared joint stay taut, N. Set if a planned load exceeds
  /// it.
  std::optional<double> taut_load = std::nullopt;

  /// "a tendon slackens at loads beyond 4.2 N: …"; "" without taut_load.
  std::string slack_words() const;
};

/// Plans the runs. The joint's law must exist over its range. If no run fits into the minutes, `steps` is empty. Throws
/// InputError for a load under which the joint has no equilibrium.
Plan plan_runs(const DeclaredMechanism& declared, const PlanOptions& options = {}, const RunContext& context = {});

}  // namespace fusee::plan
