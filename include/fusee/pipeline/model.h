/// \file
/// The joint for other programs: simulators (MuJoCo), descriptions of robots (URDF, ros2_control), firmware (tables).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fusee/base/run_context.h"
#include "fusee/base/units.h"
#include "fusee/export/model.h"
#include "fusee/profile/synthesis.h"

namespace fusee {

/// Largest accepted --max-error-deg, deg.
constexpr double k_largest_limit_deg = 45;

struct ModelOptions {
  /// Largest error of θ in joint.xml, rad. The paper's mechanism leaves 0.064° and a printed pulley is checked to
  /// 0.05°, so a coarser polynomial does not describe the joint.
  double most_error = radians(0.1);
  /// Largest error of θ in the tables, in both directions, rad: 1/20 of a step of a 14-bit encoder.
  double most_table_error = radians(0.001);
  MotorUnit unit;
  bool declared = false;        ///< ignore identified effects
  bool with_polynomial = true;  ///< false: no joint.xml
  /// compensation.csv. Not set: the file next to the mechanism that calibrate() wrote with it. Empty: none.
  std::optional<std::filesystem::path> compensation;
  std::string prefix;  ///< of the names in joint_table.h; empty: derived from the joint's name
  std::filesystem::path folder;
  bool force = false;
  bool dry_run = false;  ///< everything except publishing
};

enum class ModelEnding {
  done,
  no_law,          ///< θ(α) does not exist or does not grow; see `without_law`
  no_equilibrium,  ///< the identified joint has no equilibrium under its declared load
  polynomial_off,  ///< the error of joint.xml would exceed most_error
  table_off,       ///< the error of k_most_pieces pieces exceeds most_table_error
  check_failed,
};

/// A change that makes a refused model possible.
struct ModelChange {
  std::string words;       ///< "--max-error-deg 0.13"
  std::string key = {};    ///< of the mechanism file; empty for an option
  std::string value = {};  ///< value of that key, as TOML
};

struct ModelResult {
  ModelEnding ending = ModelEnding::done;
  ModelProduct product;
  std::optional<SynthesisResult> without_law;
  std::vector<ModelChange> changes;  ///< tested changes
  std::vector<OutputFile> outputs;   ///< manifest.json last; empty if refused
  bool published = false;
};

/// Writes the models. A missing law, an insufficient polynomial or table, and failed checks are values; throws
/// InputError and OutputError.
ModelResult model(const MechanismFile& file, const ModelOptions& options, const RunContext& context = {});

}  // namespace fusee
