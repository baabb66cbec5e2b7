/// \file
/// A string in space by polygon geometry alone: wound on the rows of a spiral, over a pin, to a point of the joint.
/// Shares no equation with the synthesis: its length is summed from row to row.
#pragma once

#include "fusee/helix.h"
#include "fusee/mechanism.h"
#include "fusee/transmission.h"

namespace fusee::helix {

/// Length and slopes of a string at one place of the stroke.
struct StringLength {
  double total = 0;  ///< wound and free length together, up to a constant, mm
  double slope = 0;  ///< slope of the free path, rad
  double fleet = 0;  ///< angle between the last wound chord and the free path, rad
};

/// The string of one side at the pulley angle `alpha` and the joint angle `theta`, rad. The joint has no drum, and both
/// tendons end at C. `attachment_z`: height of that end in the spiral's frame, mm.
StringLength string_length(const Mechanism& mechanism, transmission::Side side, const Spiral& spiral,
                           double attachment_z, double alpha, double theta);

}  // namespace fusee::helix
