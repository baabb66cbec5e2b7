/// \file
/// Internal: what may have been written wrongly, and the joint and data that were meant.
#pragma once

#include <vector>

#include "fusee/calibration/slips.h"

namespace fusee {

/// A slip undone, before it was held against data.
struct Suspect {
  UndoneSlip slip;          ///< without its rms
  DeclaredMechanism joint;  ///< as meant
  DeclaredMechanism drawn;  ///< what its pulley was made for
  double alpha = 1;         ///< the logged angles times this
  double theta = 1;
};

/// The likeliest slips that `declared` and its data can have, one at a time.
std::vector<Suspect> suspects(const DeclaredMechanism& declared);

}  // namespace fusee
