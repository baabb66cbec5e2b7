/// \file
/// Two measured states of one joint: what changed between them, by the catalogue of effects.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fusee/calibration/calibration.h"

namespace fusee {

enum class ComparisonVerdict { not_testable, not_comparable, no_change, changed };
/// "not_testable", as the JSON has it.
std::string_view word(ComparisonVerdict verdict);

/// A number of the joint in both states, in the unit that ends its name.
struct ChangedParameter {
  std::string name;
  double before = 0;
  double after = 0;
  double low = 0;  ///< 95 % interval of `after` − `before`
  double high = 0;

  double change() const { return after - before; }
};

/// A change that the runs show, with every change that would explain them as well.
struct StateChange {
  std::string name;
  std::vector<std::string> group;  ///< `name` first; k_unmodelled where it may be none of the catalogue
  ChainPlace place = ChainPlace::joint;
  std::vector<ChangedParameter> parameters;
  double rms_drop = 0;  ///< of the held-out residual, rad
  double by_runs = 0;   ///< its size by the standard error that the scatter from run to run gives it
};

struct Comparison {
  ComparisonVerdict verdict = ComparisonVerdict::not_testable;
  std::string why;      ///< of not_testable and not_comparable: what is wrong, where, what to do
  Calibration before;   ///< of the earlier runs alone
  Calibration changes;  ///< of all runs about the earlier state
  std::vector<StateChange> found;
  StateDifference difference;
};

struct ComparisonOptions {
  RunContext context = {};
};

/// Runs of two states, read for the declared joint.
struct ComparedRuns {
  Measurement before;
  Measurement after;
  Measurement both;  ///< those before, then those after
};

Comparison compare_states(const DeclaredMechanism& declared, const ComparedRuns& runs,
                          const ComparisonOptions& options = {});

}  // namespace fusee
