/// \file
/// Starts of the fit of an effect.
#pragma once

#include <vector>

#include "calibration/fit.h"

namespace fusee::calibration {

/// Zero, and the effect's own starts, one value for each parameter. For effects that begin at an unknown time, the
/// times at which a step reduces the residual of `base` most, with several sizes each.
std::vector<std::vector<double>> starts_of(const Evidence& evidence, const Fit& base, const fusee::Effect& effect);

/// The starts that a linearization distinguishes: one size for each time.
std::vector<std::vector<double>> starts_that_differ(const Evidence& evidence, const Fit& base,
                                                    const fusee::Effect& effect);

}  // namespace fusee::calibration
