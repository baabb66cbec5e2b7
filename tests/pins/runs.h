/// \file
/// All output files for the inputs in profiles/ and tests/data/rig, as bytes, through the library.
#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "fusee/base.h"

namespace fusee::pins {

/// One run of a command, such as "build/forearm". The part before the slash also names the file of hashes.
struct PinnedRun {
  std::string name;
  std::function<std::vector<OutputFile>()> outputs;
};
/// Prefix of runs that require OpenCASCADE; they are skipped if step_missing().
inline constexpr const char* k_step_runs = "step/";
/// A run's name as the name of a test.
inline void PrintTo(const PinnedRun& run, std::ostream* stream) { *stream << run.name; }

/// build/NAME, build_r12/NAME, plan/NAME, kit/NAME and model/NAME for each of profiles/*.toml; step/NAME and analyze/NAME
/// for some of them; calibrate/NAME for each folder of tests/data/rig and for the forearm's measured runs;
/// build_corrected/NAME for the corrected.toml of some of these; model/identified, simulate/forearm, reproduce/paper,
/// optimize/paper_optimum.
std::vector<PinnedRun> runs();

}  // namespace fusee::pins
