/// \file
/// Test rig: parts to print and to cut, and a page with the assembly.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "fusee/base/run_context.h"
#include "fusee/export/kit.h"
#include "fusee/profile/advice.h"

namespace fusee {

struct KitOptions {
  double chord_error_mm = 0.01;  ///< largest distance of a facet of the pulley from its curve (sagitta)
  DxfVersion dxf = DxfVersion::ac1015;
  std::filesystem::path folder;  ///< folder of the output files
  bool force = false;
  bool dry_run = false;  ///< everything except publishing
};

enum class KitEnding { done, no_pulley, no_kit, check_failed };

struct KitResult {
  KitEnding ending = KitEnding::done;
  KitProduct product;
  Advice advice;                    ///< if parts would collide: changes that make room
  std::vector<OutputFile> outputs;  ///< manifest.json last; empty without a pulley or a rig
  bool published = false;
};

/// Designs the test rig. Every mesh and drawing is read back and checked. An infeasible pulley, colliding parts and
/// failed checks are values; throws InputError and OutputError. Failed checks are published only if they replace no
/// earlier run, or with `force`.
KitResult kit(const MechanismFile& file, const KitOptions& options, const RunContext& context = {});

/// Smallest distances between the assembled parts over the range, measured on their meshes, as checks.
std::vector<Check> kit_fit_checks(const KitPlan& plan);

}  // namespace fusee
