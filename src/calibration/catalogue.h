/// \file
/// Effects that these data can show, with their starts and expected sizes.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "calibration/fit.h"
#include "fusee/measurement.h"
#include "mechanism/effect.h"

namespace fusee::calibration {

/// Effects of effects() and `more` except those named in `without`, in the order of the chain. Pointers refer to the
/// originals.
std::vector<const fusee::Effect*> catalogue(const Mechanism& declared, const measurement::Measurement& measurement,
                                            std::span<const fusee::Effect* const> more = {},
                                            std::span<const std::string> without = {});

/// Zero, and the effect's own starts, one value for each parameter. For effects that begin at an unknown time, the
/// times at which a step reduces the residual of `base` most, with several sizes each.
std::vector<std::vector<double>> starts_of(const Evidence& evidence, const Fit& base, const fusee::Effect& effect);

/// The starts that a linearization distinguishes: one size for each time.
std::vector<std::vector<double>> starts_that_differ(const Evidence& evidence, const Fit& base,
                                                    const fusee::Effect& effect);

/// Prior sizes, in steps of the parameter (Evidence::sizes), of the numbers whose known size would move the reading by
/// more than k_thresholds.most_expected and least_expected permit.
std::map<const EffectParameter*, double> expected_sizes(const EffectSet& catalogue, const Evidence& evidence,
                                                        FitterPool& pool);

}  // namespace fusee::calibration
