/// \file
/// What has no name and depends on place and direction alone, as a curve, and whether that curve holds on data that it
/// was not made from.
#pragma once

#include "calibration/unknown.h"

namespace fusee {

/// Of what stays without a name beside `fit`; what the model is trusted to grows with what the fitted joint gives.
Amplitudes amplitudes_beside(const Evidence& evidence, const Fit& fit, const Unnamed& unnamed);

EmpiricalCurve empirical_curve(const Evidence& evidence, const Fit& fit, const Unnamed& unnamed);

/// Holds a curve against every logged row, of which it was made from a few, and against runs that were kept for
/// validation, whose figures are then the held-out ones. `residuals`: measured − model, rad, run by run.
void hold_against(const Measurement& measurement, const std::vector<std::vector<double>>& residuals,
                  const std::vector<std::string>& kept, EmpiricalCurve& curve);

}  // namespace fusee
