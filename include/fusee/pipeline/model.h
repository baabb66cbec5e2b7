/// \file
/// The joint for other programs: simulators (MuJoCo), descriptions of robots (URDF, ros2_control), firmware (tables).
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fusee/base/units.h"
#include "fusee/export/model.h"
#include "fusee/profile/synthesis.h"

namespace fusee {

/// Of what may be asked for, deg.
constexpr double k_largest_limit_deg = 45;

struct ModelOptions {
  /// Of θ in joint.xml, rad. 0.1°: the paper's mechanism leaves 0.064°, and a printed pulley is checked to 0.05°; what
  /// is coarser is no model of this joint.
  double most_error = radians(0.1);
  /// Of θ in the tables, both ways round, rad. A twentieth of a step of a 14-bit encoder.
  double most_table_error = radians(0.001);
  MotorUnit unit;
  bool declared = false;        ///< whatever was identified
  bool with_polynomial = true;  ///< false: no joint.xml
  /// compensation.csv; none: the one that lies beside the file and was left with it. Empty: none at all.
  std::optional<std::filesystem::path> compensation;
  std::string prefix;  ///< of the names in joint_table.h; empty: from the joint's name
  std::filesystem::path folder;
  bool force = false;
  bool dry_run = false;  ///< everything but publishing
  /// Called before each step with what it does. What it throws stops the work, and nothing is left behind.
  std::function<void(std::string_view step)> before_step;
  /// Called once, before anything stands on the disk.
  std::function<void()> before_writing;
};

enum class ModelEnding {
  done,
  no_law,          ///< θ(α) does not exist or does not grow: `without_law` says why
  no_equilibrium,  ///< the identified joint holds its declared load nowhere
  polynomial_off,  ///< joint.xml would miss more than most_error
  table_off,       ///< k_most_pieces pieces miss more than most_table_error
  check_failed,
};

/// A change with which a refused model would do.
struct ModelChange {
  std::string words;       ///< "--max-error-deg 0.13"
  std::string key = {};    ///< of the mechanism file; empty: an option
  std::string value = {};  ///< of that key, as TOML
};

struct ModelResult {
  ModelEnding ending = ModelEnding::done;
  ModelProduct product;
  std::optional<SynthesisResult> without_law;
  std::vector<ModelChange> changes;  ///< tried
  std::vector<OutputFile> outputs;   ///< manifest.json last; none where refused
  bool published = false;
};

/// A joint without a law, one that no polynomial or table comes near enough to, and failed checks are values;
/// InputError and OutputError as their names say.
ModelResult model(const MechanismFile& file, const ModelOptions& options);

}  // namespace fusee
