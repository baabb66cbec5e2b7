/// \file
/// The candidate runs of a joint.
#pragma once

#include <vector>

#include "fusee/plan.h"

namespace fusee::plan {

/// Range, speeds and loads of the bench; options that are not given are chosen here.
struct Bench {
  double from = 0, to = 0;      ///< motor, rad
  std::vector<double> speeds;   ///< rad/s, ascending
  std::vector<double> loads;    ///< unloaded first, if 0 is among them
  double largest_load() const;  ///< largest magnitude
};
Bench bench_of(const DeclaredMechanism& declared, const PlanOptions& options);

/// All candidate runs. The first one is slow and at the first load: every plan begins with it.
std::vector<PlannedRun> candidate_runs(const Bench& bench);
}  // namespace fusee::plan
