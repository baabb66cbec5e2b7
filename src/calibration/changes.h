/// \file
/// Effects of the catalogue as changes of a joint whose earlier state is known.
#pragma once

#include <vector>

#include "calibration/fit.h"
#include "fusee/calibration.h"
#include "mechanism/effect.h"

namespace fusee::calibration {

/// Every effect of the kind, with bounds and starts shifted so that a number is the change from `before`: play may
/// shrink to zero. For a joint declared by a ratio the joint sensor's zero is one of them.
std::vector<fusee::Effect> changes_from(const Imperfections& before, JointKind kind);

/// 1 / s for each effect of `fit`, in order. s is the standard error of a factor on the effect's contribution (1 as
/// fitted), from the scatter between runs as clusters (Liang and Zeger 1986). The clusters of a state of one run are
/// its blocks. A contribution that does not repeat from run to run is no change, however small the noise within a run.
std::vector<double> sizes_by_scatter(const Evidence& evidence, const Fit& fit);

/// `none`: fit of the earlier joint, or with fewer changes. `changed`: fit with the changes.
StateDifference state_difference(const Evidence& evidence, const Fit& none, const Fit& changed);

}  // namespace fusee::calibration
