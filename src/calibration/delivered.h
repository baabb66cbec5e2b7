/// \file
/// Which numbers of the set that was found are handed over, and whether a curve goes with them.
#pragma once

#include "calibration/empirical.h"
#include "calibration/selection.h"

namespace fusee {

struct Delivered {
  Fit fit;  ///< the set that was found, perhaps with a member of a group more, with the numbers of the joint's file
  EmpiricalCurve curve;  ///< as the verdict unexplained has it
};

/// `unnamed`: beside selection.best.
Delivered delivered(const Evidence& evidence, Workers& workers, const Selection& selection, const Unnamed& unnamed);

}  // namespace fusee
