/// \file
/// Experiment design: plan.json, a page for the bench and empty run files.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "fusee/export/plan.h"
#include "fusee/profile/synthesis.h"

namespace fusee {

struct PlanFilesOptions {
  PlanOptions plan;
  std::filesystem::path folder;  ///< folder of the output files
  bool force = false;
  bool dry_run = false;  ///< everything except writing
};

struct PlanResult {
  /// Reason why there is nothing to plan: the law does not exist over the range. Empty if it does.
  std::optional<SynthesisResult> without_law;
  PlanProduct product;
  std::vector<OutputFile> outputs;  ///< manifest.json last; empty if no run fits into the minutes
  bool published = false;
};

/// Plans the shortest set of runs for the joint of `file`, given the values in [prior]: plan.json, plan.html, and
/// run_1.csv … in the format of `fusee calibrate`, without θ. If no run fits into the minutes, the plan has no steps
/// and lists what more minutes would add. Throws InputError and OutputError.
PlanResult plan(const MechanismFile& file, const PlanFilesOptions& options, const RunContext& context = {});

}  // namespace fusee
