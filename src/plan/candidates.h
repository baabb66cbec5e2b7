/// \file
/// The candidate runs of a joint.
#pragma once

#include <optional>
#include <vector>

#include "fusee/plan.h"

namespace fusee::plan {

/// Range, speeds and loads of the bench.
struct Bench {
  double from = 0, to = 0;      ///< motor angles, rad
  std::vector<double> speeds;   ///< rad/s, ascending
  std::vector<double> loads;    ///< as in PlannedRun; unloaded first, if 0 is among them
  double largest_load() const;  ///< largest magnitude
};
/// Takes the conditions from the options, and chooses those that are not given.
Bench bench_of(const DeclaredMechanism& declared, const PlanOptions& options);

/// Largest magnitude of the bench's loads, all scaled alike, at which both tendons stay taut over the range, N. Empty if
/// they do at all of its loads.
std::optional<double> taut_load_of(const DeclaredMechanism& declared, const Bench& bench);

/// All candidate runs. The first one is slow and at the first load: every plan begins with it.
std::vector<PlannedRun> candidate_runs(const Bench& bench);
}  // namespace fusee::plan
