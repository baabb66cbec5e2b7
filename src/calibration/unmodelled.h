/// \file
/// What has no name and would do what a named effect does: a few sharp shapes of few numbers, as any fault that nobody
/// has a word for may have. Smooth ones are the discrepancy's.
#pragma once

#include <string>
#include <vector>

#include "calibration/selection.h"
#include "calibration/workers.h"

namespace fusee {

/// Of every accepted effect, in their order.
std::vector<Unmodelled> unmodelled_rivals(const Evidence& evidence, Workers& workers, const Selection& selection);

/// What stays beside all effects.
struct Left {
  bool anything = false;
  bool in_time = false;  ///< and it walks, or differs from run to run
};

/// Groups that may hold nothing with a name say so. `effects`: what was found of the selection's best, in its order.
void take_unmodelled(const Left& left, const Selection& selection, std::vector<FoundEffect>& effects);

}  // namespace fusee
