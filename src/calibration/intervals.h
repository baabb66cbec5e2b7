/// \file
/// How well the data know the numbers of a fit.
#pragma once

#include <vector>

#include "calibration/confidence_interval.h"
#include "calibration/selection.h"

namespace fusee {

/// Of every fitted x, in their order: beside a discrepancy that may take any shape, and what is known from practice and
/// from calipers.
/// `overstated`: by which evidence is, as Selection::temperature.
std::vector<ConfidenceInterval> intervals(const Fit& fit, double overstated = 1.0);
/// Of `selection.best`, wider by what is not known of the other effects, and by as much as evidence is overstated.
std::vector<ConfidenceInterval> intervals(const Selection& selection);
/// Intervals if the effects of `selection.best` are all there is: by as much wider as evidence is overstated.
std::vector<ConfidenceInterval> intervals_if_only(const Selection& selection);

}  // namespace fusee
