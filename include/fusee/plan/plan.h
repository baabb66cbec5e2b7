/// \file
/// Experiment design: the shortest set of runs that distinguishes the causes which matter for this joint, the smallest
/// size of each cause that these runs detect, and the expected false-positive rate.
///
/// Each candidate run is simulated with each cause of the catalogue at its usual size (EffectParameter::prior). Two
/// causes are resolved if their responses differ by more than the noise and by more than the accuracy of the model.
/// Runs are chosen greedily by gain per minute. The model is linear in the causes, so sizes are right to some tens of
/// per cent.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fusee/base/run_context.h"
#include "fusee/plan/bench_run.h"

namespace fusee {

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
  const EffectParameter* reading = nullptr;
  std::string words;
  double minutes = 0;              ///< including the changes on the bench
  double setup = 0;                ///< part of `minutes` that the changes take
  double by = 0;                   ///< minutes from the beginning to the end of this step
  std::vector<std::string> sees;   ///< causes that this step detects first
  std::vector<std::string> tells;  ///< pairs that this step resolves first: "backlash from capstan_friction, creep"
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
  int wrong = 0;  ///< only causes that are not present were named
  int alone = 0;  ///< the true cause was named alone
  int group = 0;  ///< the true cause was named in a group
};

struct Plan {
  std::vector<PlanStep> steps;                                ///< by gain per minute; empty if no run fits
  std::vector<PlanStep> beyond;                               ///< steps that more minutes would add
  double minutes = 0;                                         ///< of all steps
  std::vector<PlannedCause> causes;                           ///< in the order of the drive chain
  std::vector<std::pair<std::string, std::string>> left_out;  ///< effects without a plan, and the reason
  std::vector<std::vector<std::string>> groups;               ///< causes that the runs do not resolve
  FalsePositives nothing, one, unmodelled;  ///< without cause; with one cause; with one that is not in the catalogue
  double slow = 0;                          ///< rad/s
  double from = 0, to = 0;                  ///< motor range, rad
  std::string load_unit = "N";
  int first_run = 1;  ///< number of the first run's file
};

/// Plans the runs. The joint's law must exist over its range. If no run fits into the minutes, `steps` is empty.
Plan plan_runs(const DeclaredMechanism& declared, const PlanOptions& options = {}, const RunContext& context = {});

}  // namespace fusee
