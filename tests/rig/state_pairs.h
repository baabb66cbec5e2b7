/// \file
/// Pairs of states of one joint: a session at the bench before and one after a single cause changed, or none did.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "fusee/calibration/comparison.h"
#include "rig/truths.h"

namespace fusee::rig {

struct StatePair {
  std::string change;  ///< a fault's name, "pretension" or "nothing"
  std::string effect;  ///< its name in the catalogue
  std::string common;  ///< a fault that both states have; "": none
  MadeJoint joint;
  ComparedRuns runs;
  double seen = 0;  ///< by how much the change moves the reading, rms in units of the sensor's noise
};

/// Causes that pairs are drawn from: what a joint does when it is retensioned, reprinted, reassembled, warm or worn.
std::vector<std::string> changes_drawn();

/// Drawn by the seed: joint, protocol of five runs, what both states have, size and direction of the change. The runs
/// are written to `folder` and read again.
StatePair make_pair(const std::string& change, std::uint64_t seed, const std::filesystem::path& folder);

}  // namespace fusee::rig
