/// \file
/// Effects that a joint can have and its data can show.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "fusee/measurement.h"
#include "mechanism/effect.h"

namespace fusee::calibration {

/// Effects of effects() and `more` except those named in `without`, in the order of the chain. Pointers refer to the
/// originals.
std::vector<const fusee::Effect*> catalogue(const Mechanism& declared, const measurement::Measurement& measurement,
                                            std::span<const fusee::Effect* const> more = {},
                                            std::span<const std::string> without = {});

}  // namespace fusee::calibration
