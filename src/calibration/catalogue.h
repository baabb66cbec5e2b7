/// \file
/// Which effects a joint can have and its data can show.
#pragma once

#include <span>
#include <vector>

#include "fusee/measurement/measurement.h"
#include "fusee/mechanism/effect.h"

namespace fusee {

/// Of effects() and of `more`, in the order of the chain. The effects stay where they are: pointers to them hold.
std::vector<const Effect*> catalogue(const Mechanism& declared, const Measurement& measurement,
                                     std::span<const Effect* const> more = {});

}  // namespace fusee
