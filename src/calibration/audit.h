/// \file
/// False-positive rate of each reported effect, counted on synthetic data sets.
#pragma once

#include <vector>

#include "calibration/selection.h"

namespace fusee {

/// False positives of an effect on synthetic data sets without it.
struct Audited {
  Audit counts;
  /// True causes of the false positives, most frequent first, until the rate without them is acceptable.
  EffectSet mistaken;
};

/// Audit of each effect of selection.best, in their order.
std::vector<Audited> audit(const Evidence& evidence, Workers& workers, const Selection& selection);

}  // namespace fusee
