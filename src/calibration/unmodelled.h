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

/// Adds k_unmodelled to each group whose cause may be unmodelled. `effects`: in the order of the best set.
/// `beside_unmodelled`: an unmodelled cause remains beside all effects. Then it may be the cause of any of them.
void take_unmodelled(bool beside_unmodelled, const Selection& selection, std::vector<FoundEffect>& effects);

}  // namespace fusee
