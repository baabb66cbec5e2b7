/// \file
/// The rest of the test model → parts to print and to cut, and a page that says how they go together.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "fusee/export/kit.h"
#include "fusee/profile/advice.h"

namespace fusee {

struct KitOptions {
  double tolerance = 0.01;  ///< sagitta of the pulley's curves, mm
  DxfVersion dxf = DxfVersion::ac1015;
  std::filesystem::path folder;  ///< where the files go
  bool force = false;
  bool dry_run = false;  ///< everything but publishing
  /// Called once, before anything stands on the disk.
  std::function<void()> before_writing;
  /// Called before each step with what it does. What it throws stops the work, and nothing is left behind.
  std::function<void(std::string_view step)> before_step;
};

enum class KitEnding { done, no_pulley, no_kit, check_failed };

struct KitResult {
  KitEnding ending = KitEnding::done;
  KitProduct product;
  Advice advice;                    ///< where parts would meet: what was seen to make room
  std::vector<OutputFile> outputs;  ///< manifest.json last; none where there is no pulley or no kit
  bool published = false;
};

/// A pulley that cannot be made, a model whose parts would meet, and failed checks are values; InputError and
/// OutputError as their names say. Every mesh and drawing is checked as it was written. Failed checks are published
/// only where there is no earlier run to lose, or with `force`.
KitResult kit(const MechanismFile& file, const KitOptions& options);

/// Distances as checks: what the assembled parts, as meshes, keep from each other over the range.
std::vector<Check> kit_fit_checks(const KitPlan& plan);

}  // namespace fusee
