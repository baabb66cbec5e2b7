/// \file
/// What a session at the bench can be like.
#pragma once

#include <vector>

#include "rig/random.h"
#include "rig/rig.h"

namespace fusee::rig {

/// Runs, how they are made, and what reads them.
struct Programme {
  std::vector<RunPlan> runs;
  MotionPlan motion;
  SensorPlan sensors;  ///< its seed is for the caller to set
};

/// As people measure, well or badly: 2 … 7 runs with their own loads, speeds, cycles and dwells, strokes or point to
/// point, some with loads that change within a run; noise 0.005 … 0.05°, coloured or coarse or neither.
Programme random_programme(Random& random, const MadeJoint& joint);

}  // namespace fusee::rig
