/// \file
/// What to measure before measuring: the shortest set of runs with which the causes that matter for this joint can be
/// told apart, what they can show, and how often they would blame falsely.
///
/// Every run that could be made is simulated with every cause of the catalogue at its usual size
/// (EffectParameter::prior); what two causes make of the same runs, beyond noise and beyond what the model itself is
/// trusted to, says whether these runs tell them apart. Runs are then chosen one by one: that which tells most for its
/// minutes. Linear in the causes: sizes are right to some tens of per cent.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fusee/plan/bench_run.h"

namespace fusee {

struct PlanOptions {
  double noise = radians(0.02);  ///< of the joint's sensor, standard deviation, rad
  double minutes = 15;           ///< at the bench
  std::vector<double> loads;     ///< tip forces that can be hung on, N; empty: chosen
  std::vector<double> speeds;    ///< of the motor, rad/s; empty: chosen. The slowest is "slow"
  /// Of the motor, rad; none: the range of the joint, or of a joint declared by a ratio one turn.
  std::optional<std::pair<double, double>> range;
  std::uint64_t seed = 1;                            ///< of the worlds in which blame is tried
  std::function<void(const std::string&)> progress;  ///< what is done now; what it throws stops the work
};

/// A run, or a number to read by hand.
struct PlanStep {
  std::optional<PlannedRun> run;
  const EffectParameter* reading = nullptr;
  std::string words;
  double minutes = 0;              ///< with what has to be changed on the bench for it
  double setup = 0;                ///< of these
  double by = 0;                   ///< minutes since the beginning, when it is done
  std::vector<std::string> sees;   ///< causes that the steps before it would not have shown
  std::vector<std::string> tells;  ///< what they did not tell apart: "backlash from capstan_friction, creep"
};

/// A cause, and what the planned runs can say of it.
struct PlannedCause {
  std::string name;
  double usual = 0;     ///< what it moves the joint by at its usual size, rms over these runs, rad
  double smallest = 0;  ///< the least of it that would be seen at all, the same
  /// The least of it that could be named alone; none where something else does the same whatever the size.
  std::optional<double> smallest_alone;
  /// That smallest in the unit of its key of [identified], of its first number: {"backlash_deg", 0.03}.
  std::string key;
  double smallest_key = 0;
  std::vector<std::string> rivals;  ///< that these runs do not tell from it at its usual size
};

/// How often a name would be false, of so many simulated joints.
struct FalseBlame {
  int worlds = 0;
  int blamed = 0;  ///< something was named that is not there
  int alone = 0;   ///< the cause was named, alone
  int group = 0;   ///< the cause was named, with others
};

struct Plan {
  std::vector<PlanStep>
      steps;  ///< in the order of what they buy for their minutes; empty where there is no time for any
  std::vector<PlanStep> beyond;                               ///< what more minutes would buy
  double minutes = 0;                                         ///< of all steps
  std::vector<PlannedCause> causes;                           ///< in the order of the chain
  std::vector<std::pair<std::string, std::string>> left_out;  ///< effects that were not planned for, and why
  std::vector<std::vector<std::string>> groups;               ///< causes that stay together
  FalseBlame nothing, one, unknown;  ///< joints as declared; with one cause; with one that the catalogue is without
  double slow = 0;                   ///< rad/s
  double from = 0, to = 0;           ///< of the motor, rad
  std::string load_unit = "N";
  int first_run = 1;  ///< number of the first run's file
};

/// The joint's law must exist over its range. What cannot be done in the minutes given is a plan without steps.
Plan plan_runs(const DeclaredMechanism& declared, const PlanOptions& options = {});

}  // namespace fusee
