/// \file
/// Pairs of sessions with one joint, between which one cause changed, or none.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "fusee/calibration.h"
#include "rig/truths.h"

namespace fusee::rig {

struct StatePair {
  std::string change;  ///< a fault's name, "pretension" or "nothing"
  std::string effect;  ///< its name in the catalogue
  std::string common;  ///< a fault of both states; "": none
  MadeJoint joint;
  calibration::ComparedRuns runs;
  double seen = 0;  ///< movement of the reading by the change, rms per noise rms
};

/// Causes of the drawn changes: retensioned, reprinted, reassembled, warm, worn.
std::vector<std::string> changes_to_draw();

/// Draws joint, five runs, common fault, size and direction of the change by the seed. The runs are written to `folder`
/// and read again.
StatePair make_pair(const std::string& change, std::uint64_t seed, const std::filesystem::path& folder);

}  // namespace fusee::rig
