/// \file
/// Whether a wider fit is to be believed.
#pragma once

#include "calibration/statistics.h"
#include "fusee/calibration/calibration.h"

namespace fusee {

/// Whether `after` is worth its numbers; the evidence and the reason stand in `candidate`.
bool accepted(const Evidence& evidence, const Fit& before, const Fit& after, Candidate& candidate);

/// Held-out mean square error, a caliper's reading counted as a row. rad²
double score(const Evidence& evidence, const Fit& fit);

}  // namespace fusee
