/// \file
/// Comparison of two measured states of one joint, by changes of the effects of the catalogue.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fusee/calibration/calibration.h"

namespace fusee {

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
};

struct Comparison {
  ComparisonVerdict verdict = ComparisonVerdict::not_testable;
  std::string why;      ///< reason of not_testable and not_comparable: the fault, its place, the remedy
  Calibration before;   ///< calibration of the earlier runs alone
  Calibration changes;  ///< calibration of all runs, relative to the earlier state
  std::vector<StateChange> found;
  StateDifference difference;
};

struct ComparisonOptions {
  RunContext context = {};
};

/// Runs of two states, compared with the declared joint.
struct ComparedRuns {
  Measurement before;
  Measurement after;
  Measurement both;  ///< earlier runs, then later runs
};

Comparison compare_states(const DeclaredMechanism& declared, const ComparedRuns& runs,
                          const ComparisonOptions& options = {});

}  // namespace fusee
