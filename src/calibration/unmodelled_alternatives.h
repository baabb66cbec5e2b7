/// \file
/// Unmodelled alternatives to reported effects: localised shapes of few parameters. Smooth ones are in the discrepancy.
#pragma once

#include <string>
#include <vector>

#include "calibration/fit.h"
#include "calibration/selection.h"

namespace fusee::calibration {

/// Best unmodelled alternative to every accepted effect, in their order.
std::vector<UnmodelledAlternative> find_unmodelled_alternatives(const Evidence& evidence, FitterPool& pool,
                                                                const Selection& selection);

/// Adds k_unmodelled to each group whose cause may be unmodelled. `effects`: in the order of the best set.
/// `beside_unmodelled`: an unmodelled cause remains beside all effects, and may be the cause of any of them.
void add_unmodelled(bool beside_unmodelled, const Selection& selection, std::vector<FoundEffect>& effects);

}  // namespace fusee::calibration
