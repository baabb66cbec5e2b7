/// \file
/// Prior sizes of parameters, narrowed by the data: no number moves the reading much more than the observed error,
/// unless another one cancels it.
#pragma once

#include <map>

#include "calibration/fitter_pool.h"

namespace fusee::calibration {

/// Prior sizes, in steps of the parameter (Evidence::sizes), of the numbers whose known size would move the reading by
/// more than k_thresholds.most_expected and least_expected permit.
std::map<const EffectParameter*, double> expected_sizes(const EffectSet& catalogue, const Evidence& evidence,
                                                        FitterPool& pool);

}  // namespace fusee::calibration
