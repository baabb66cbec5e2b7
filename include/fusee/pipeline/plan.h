/// \file
/// What to measure before measuring → plan.json, a page for the bench and empty run files.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "fusee/export/plan.h"
#include "fusee/profile/synthesis.h"

namespace fusee {

struct PlanFilesOptions {
  PlanOptions plan;
  std::filesystem::path folder;  ///< where the files go
  bool force = false;
  bool dry_run = false;  ///< everything but writing
};

struct PlanResult {
  /// Why there is nothing to plan: the law does not exist over the range; null when it does.
  std::optional<SynthesisResult> without_law;
  PlanProduct product;
  std::vector<OutputFile> outputs;  ///< manifest.json last; none where there is no time for any run
  bool published = false;
};

/// The shortest set of runs for the joint of `file`, beginning from what [prior] says of it: plan.json, plan.html,
/// run_1.csv … as `fusee calibrate` reads them, without θ. A plan that cannot be done in the minutes given is a value:
/// it has no steps, and says what minutes would buy. InputError and OutputError as their names say.
PlanResult plan(const MechanismFile& file, const PlanFilesOptions& options);

}  // namespace fusee
