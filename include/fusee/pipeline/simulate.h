/// \file
/// Simulation: logged motor angles, loads and times → joint angle, tendon tensions and motor torque.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "fusee/export/simulation.h"
#include "fusee/profile/synthesis.h"

namespace fusee {

struct SimulateOptions {
  MeasurementOptions columns;
  /// true: simulates the corrected pulley that build() makes of this file; false: the pulley of the declared mechanism,
  /// on which [identified] was measured.
  bool corrected = false;
  double noise = 0;        ///< standard deviation of noise added to the joint sensor, rad
  std::uint64_t seed = 1;  ///< of that noise
};

struct SimulateResult {
  /// Reason why there is nothing to simulate: the law does not exist over the range. Empty if it does.
  std::optional<SynthesisResult> without_law;
  Simulation simulation;
};

/// Simulates the identified joint of `file` row by row, for a log or a run of plan(). Rows without an equilibrium are
/// marked. Throws InputError for unreadable input.
SimulateResult simulate(const MechanismFile& file, const std::filesystem::path& log,
                        const SimulateOptions& options = {}, const RunContext& context = {});

}  // namespace fusee
