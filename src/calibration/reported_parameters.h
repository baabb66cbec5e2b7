/// \file
/// Choice of the reported parameters and the empirical curve: those that predict held-out rows best, and never worse
/// than the declared joint.
#pragma once

#include <string>
#include <vector>

#include "calibration/empirical_curve.h"
#include "calibration/validation.h"

namespace fusee::calibration {

struct ReportedParameters {
  /// The found set, perhaps with another member of a group; without effects the declared joint.
  Estimate estimate;
  /// Parameters in the report. If the estimate contains a curve of the ratio, they are fitted without it, since the
  /// curve is collinear with gain and compliance.
  Fit reported;
  EmpiricalCurve curve;  ///< curve of the remaining discrepancy
};

/// `unmodelled`: description of the discrepancy beside selection.best.
ReportedParameters choose_reported_parameters(const Evidence& evidence, FitterPool& pool, const Selection& selection,
                                              const DiscrepancyFit& unmodelled);

/// Answer that is reported.
struct ValidatedAnswer {
  Estimate declared;  ///< declared joint
  ReportedParameters reported;
  DiscrepancyFit unmodelled;  ///< discrepancy beside selection.best: decides whether the effects explain the data
  DiscrepancyFit residual;    ///< discrepancy beside the reported estimate: is described
  /// effects that fit the runs and do not predict held-out rows, in the order of their removal
  std::vector<std::string> dropped;
};

/// Removes effects from `selection`, the least predictive first, until held-out rows are predicted no worse than by the
/// declared joint, over all and at each level of load and speed. `kept`: runs for validation.
ValidatedAnswer validate_answer(const Evidence& evidence, FitterPool& pool, const measurement::Measurement& kept,
                                Selection& selection);

/// Changes between two states, as selected, beside the discrepancy that both states share. They are not validated by
/// prediction: every run has the discrepancy of the earlier state.
ValidatedAnswer changes_beside(const Evidence& evidence, const Selection& selection);

}  // namespace fusee::calibration
