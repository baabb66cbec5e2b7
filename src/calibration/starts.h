/// \file
/// Where the fit of an effect begins.
#pragma once

#include <vector>

#include "calibration/fit.h"

namespace fusee {

/// As things are, and the effect's own starts: one value a parameter. Where it may have happened at any time, the
/// places at which a step would take most out of what `base` leaves, with several sizes each.
std::vector<std::vector<double>> starts_of(const Evidence& evidence, const Fit& base, const Effect& effect);

/// Of these, those that a linear look tells apart: of a time one size.
std::vector<std::vector<double>> starts_that_differ(const Evidence& evidence, const Fit& base, const Effect& effect);

}  // namespace fusee
