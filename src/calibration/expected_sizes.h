/// \file
/// Prior sizes of parameters, narrowed by the data: no number moves the reading much more than the observed error,
/// unless another one cancels it.
#pragma once

#include <map>

#include "calibration/fitter_pool.h"

namespace fusee::calibration {

/// For numbers whose known size would move the reading by more than that, the size that would not, in steps of the
/// parameter (Evidence::sizes).
std::map<const EffectParameter*, double> expected_sizes(const EffectSet& catalogue, const Evidence& evidence,
                                                        FitterPool& pool);

}  // namespace fusee::calibration
