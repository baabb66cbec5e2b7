/// \file
/// Logged motor angles, loads and times → the joint's angle, its tendons' tensions and the motor's torque.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "fusee/export/simulation.h"
#include "fusee/profile/synthesis.h"

namespace fusee {

struct SimulateOptions {
  MeasurementOptions columns;
  /// With the pulley that build() makes of this file, which undoes what a pulley can; else with that of the declared
  /// mechanism, the one on which [identified] was found.
  bool corrected = false;
  double noise = 0;        ///< added to what the joint's sensor shows, standard deviation, rad
  std::uint64_t seed = 1;  ///< of that noise
};

struct SimulateResult {
  /// Why there is nothing to simulate: the law does not exist over the range; null when it does.
  std::optional<SynthesisResult> without_law;
  Simulation simulation;
};

/// The joint of `file`, with what was identified, at its bench: a log, or a run of plan(), row by row. Rows where
/// nothing holds the joint say so. InputError for what cannot be read.
SimulateResult simulate(const MechanismFile& file, const std::filesystem::path& log,
                        const SimulateOptions& options = {});

}  // namespace fusee
