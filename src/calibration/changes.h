/// \file
/// The catalogue of effects as changes of a joint whose state before is known.
#pragma once

#include <vector>

#include "calibration/fit.h"
#include "fusee/calibration/calibration.h"
#include "fusee/mechanism/effect.h"

namespace fusee {

/// Every effect of the kind, its bounds and starts shifted so that a number is what was added to `before`: play may
/// shrink by as much as there was. Of a joint declared by a ratio the joint sensor's zero is one of them.
std::vector<Effect> changes_from(const Imperfections& before, JointKind kind);

/// One number for each effect of `fit`, in their order: 1 / s, where s is the standard error of the size of what it does,
/// 1 as fitted, with runs as clusters (Liang & Zeger 1986); of a state of one run its blocks. What a joint does in one
/// run and not in the next is no change, however small the noise within a run.
std::vector<double> sizes_by_scatter(const Evidence& evidence, const Fit& fit);

/// `none`: with the joint as it was, `changed`: with the changes.
StateDifference state_difference(const Evidence& evidence, const Fit& none, const Fit& changed);

}  // namespace fusee
