/// \file
/// Whether found effects are one thing each, and how large by what stays beside them.
#pragma once

#include <vector>

#include "calibration/selection.h"
#include "calibration/workers.h"

namespace fusee {

/// Of every accepted effect, in their order.
std::vector<Evenness> evenness(const Evidence& evidence, Workers& workers, const Selection& selection);

}  // namespace fusee
