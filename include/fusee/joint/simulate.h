/// \file
/// A joint moved through logged motor angles: what its sensor would have shown.
#pragma once

#include <vector>

#include "fusee/measurement/measurement.h"
#include "fusee/mechanism/imperfections.h"
#include "fusee/mechanism/mechanism.h"

namespace fusee {

/// θ as the joint's sensor would have logged it, rad, run by run, sample by sample. NaN where the joint has no
/// equilibrium.
std::vector<std::vector<double>> predict(const Mechanism& declared, const Imperfections& imperfections,
                                         const Measurement& measurement);

}  // namespace fusee
