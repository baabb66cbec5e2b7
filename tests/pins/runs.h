/// \file
/// Every file that fusee leaves behind for what lies in profiles/ and tests/data/rig, as bytes, through the library.
#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "fusee/base/files.h"

namespace fusee::pins {

/// One run of a verb. "build/forearm": what stands before the first slash names the file of hashes, too.
struct PinnedRun {
  std::string name;
  std::function<std::vector<OutputFile>()> outputs;
};
/// Runs whose names begin so need OpenCASCADE: nothing is asked of them where step_missing().
inline constexpr const char* k_step_runs = "step/";
/// For the names of tests.
inline void PrintTo(const PinnedRun& run, std::ostream* stream) { *stream << run.name; }

/// build/NAME and build_r12/NAME for each of profiles/*.toml, step/NAME for some, calibrate/NAME for each folder of
/// tests/data/rig and for the forearm's measured runs, build_corrected/NAME for the corrected.toml of some of these,
/// reproduce/paper, optimize/paper_optimum.
std::vector<PinnedRun> runs();

}  // namespace fusee::pins
