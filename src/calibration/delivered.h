/// \file
/// The numbers that are handed over, and the empirical curve beside them: those that predict best what they were not
/// fitted to, and never worse than the declared joint.
#pragma once

#include <string>
#include <vector>

#include "calibration/empirical.h"
#include "calibration/validation.h"

namespace fusee {

struct Delivered {
  /// The set that was found, perhaps with a member of a group more; of no effect the declared joint.
  Estimate estimate;
  /// The reported numbers: those of the estimate. If it has a curve of the ratio, they are fitted without it, since the
  /// curve can trade any part of a gain or a compliance with them.
  Fit reported;
  EmpiricalCurve curve;  ///< as the verdict unexplained has it
};

/// `unnamed`: beside selection.best.
Delivered delivered(const Evidence& evidence, Workers& workers, const Selection& selection, const Unnamed& unnamed);

/// The answer that is reported.
struct Validated {
  Estimate declared;  ///< before
  Delivered made;
  Unnamed unnamed;                   ///< beside selection.best
  std::vector<std::string> dropped;  ///< effects that fit the runs and do not predict others, in the order they went
};

/// Removes effects from `selection`, the one that predicts least first, until the answer predicts rows that were not
/// fitted no worse than the declared joint, over all and at each level of load and speed. `kept`: runs for validation.
Validated validated(const Evidence& evidence, Workers& workers, const Measurement& kept, Selection& selection);

/// Changes between two states, as selected, beside the discrepancy that both states share. They predict nothing by
/// themselves: every run has the discrepancy of the earlier state.
Validated changes_beside(const Evidence& evidence, const Selection& selection);

}  // namespace fusee
