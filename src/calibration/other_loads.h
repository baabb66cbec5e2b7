/// \file
/// Loads that are not as logged, all by the same share: a cell out of calibration, a lever of another length. They act
/// through the joint's own elasticity and are the log's fault, not the joint's: no effect has their name.
#pragma once

#include <vector>

#include "calibration/selection.h"
#include "calibration/workers.h"

namespace fusee {

/// The best set without an effect, on runs whose loads are so many times what was logged.
struct UnderOtherLoads {
  double times = 1;
  double score = 0;  ///< the price of one more number in it; −infinity: not to be had, or the effect in other words
};

/// Of every accepted effect, in their order.
std::vector<UnderOtherLoads> under_other_loads(const Evidence& evidence, Workers& workers, const Selection& selection);

}  // namespace fusee
