/// \file
/// How often the same runs would have named an effect that is not there: counted on simulated joints.
#pragma once

#include <vector>

#include "calibration/selection.h"

namespace fusee {

/// What simulated joints without an effect say of its name.
struct Audited {
  Audit counts;
  /// Effects that were there and were read as this one, the most often first, as many as it takes to be sure.
  EffectSet mistaken;
};

/// Of each effect of selection.best, in their order.
std::vector<Audited> audit(const Evidence& evidence, Workers& workers, const Selection& selection);

}  // namespace fusee
