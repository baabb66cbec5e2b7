/// \file
/// What could be measured of a joint, before anything is chosen.
#pragma once

#include <vector>

#include "fusee/plan/plan.h"

namespace fusee {

/// The range, paces and loads of a bench, where the options leave them open.
struct Bench {
  double from = 0, to = 0;      ///< motor, rad
  std::vector<double> speeds;   ///< rad/s, the slowest first
  std::vector<double> loads;    ///< the first is the one to begin with: none, where there is none
  double largest_load() const;  ///< size
};
Bench bench_of(const DeclaredMechanism& declared, const PlanOptions& options);

/// The first is the one that every plan begins with: slow, at the first load.
std::vector<PlannedRun> candidate_runs(const Bench& bench);
}  // namespace fusee
