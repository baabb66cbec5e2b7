/// \file
/// How large a number is expected to be, by what these data show: no number moves the reading by much more than what is
/// seen, unless another cancels it.
#pragma once

#include <map>

#include "calibration/workers.h"

namespace fusee {

/// Of the numbers whose size in practice would move the reading by more than that, the size that would not, in steps of
/// the parameter (Evidence::sizes).
std::map<const EffectParameter*, double> expected_sizes(const EffectSet& catalogue, const Evidence& evidence,
                                                        Workers& workers);

}  // namespace fusee
