/// \file
/// Empirical curve of the discrepancy that depends on place and direction alone, and its validation on held-out data.
#pragma once

#include "calibration/discrepancy_fit.h"

namespace fusee::calibration {

/// Amplitudes of the discrepancy beside `fit`; the error of the model itself grows with the deflection of the fitted
/// joint.
Amplitudes amplitudes_beside(const Evidence& evidence, const Fit& fit, const DiscrepancyFit& unmodelled);

EmpiricalCurve empirical_curve(const Evidence& evidence, const Fit& fit, const DiscrepancyFit& unmodelled);

/// Validates a curve on all logged rows, since the fit used only a few of them, and on runs kept for validation. With
/// such runs, the held-out figures are theirs. `residuals`: measured − model, rad, run by run.
void validate_curve(const measurement::Measurement& measurement, const std::vector<std::vector<double>>& residuals,
                    const std::vector<std::string>& kept, EmpiricalCurve& curve);

/// Curve at each sample of a run, rad. Zero beyond the curve's ends and where the motor stands.
std::vector<double> curve_at_samples(const measurement::Run& run, const EmpiricalCurve& curve);

}  // namespace fusee::calibration
