/// \file
/// How often the same runs would have named an effect that is not there: counted on simulated joints.
#pragma once

#include <vector>

#include "calibration/selection.h"

namespace fusee {

/// What simulated joints without an effect say of its name.
struct Audited {
  Audit counts;
  EffectSet mistaken;  ///< effects that were there and were read as this one, as many as it takes to be sure
  int beyond = 0;      ///< joints that bore the name and had none of these
  bool given_up = false;
};

/// Of each effect of selection.best, in their order.
std::vector<Audited> audit(const Evidence& evidence, Workers& workers, const Selection& selection);

}  // namespace fusee
