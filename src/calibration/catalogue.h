/// \file
/// Which effects a joint can have and its data can show.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "fusee/measurement/measurement.h"
#include "fusee/mechanism/effect.h"

namespace fusee {

/// Of effects() and of `more`, but for those named in `without`, in the order of the chain. The effects stay where they
/// are: pointers to them hold.
std::vector<const Effect*> catalogue(const Mechanism& declared, const Measurement& measurement,
                                     std::span<const Effect* const> more = {},
                                     std::span<const std::string> without = {});

}  // namespace fusee
