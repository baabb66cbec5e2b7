/// \file
/// False-positive rate of each reported effect, counted on synthetic data sets.
#pragma once

#include <vector>

#include "calibration/selection.h"

namespace fusee::calibration {

/// False positives of an effect on synthetic data sets without it.
struct AuditResult {
  Audit counts;
  /// True causes of the false positives, most frequent first, until the rate without them is acceptable.
  EffectSet true_causes;
};

/// Audit of each effect of selection.best, in their order.
std::vector<AuditResult> audit(const Evidence& evidence, FitterPool& pool, const Selection& selection);

}  // namespace fusee::calibration
