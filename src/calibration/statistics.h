/// \file
/// Comparison of fits, and statistics of residuals.
#pragma once

#include "calibration/fit.h"

namespace fusee::calibration {

/// Nats up to which two sets are equally likely: odds of 1 / most_false_positives.
double equally_likely();
/// True if the evidence of the rival is at most equally_likely() below.
bool is_as_good(const Fit& rival, const Fit& best);

/// Root mean square; 0 without values.
double rms_of(const Eigen::VectorXd& values);

/// α of all rows, in the order of Block::rows.
Eigen::VectorXd alphas(const measurement::Measurement& measurement);

/// Lag-1 autocorrelation within blocks, −1 … 1, of a residual at the rows in use.
double lag_one_correlation(const Evidence& evidence, const Eigen::VectorXd& residual);

/// Ratio of two mean squares of the same noise, with these degrees of freedom, that chance exceeds as seldom as a
/// normal variable exceeds three standard deviations (Paulson 1942: the cube root of a mean square is nearly normal).
/// Infinite if the lower one has too few degrees of freedom.
double rarest_ratio(double upper_freedom, double lower_freedom);

/// Scatter of the residual, rad: rms of stroke means about their run and direction beyond noise, and rms within
/// strokes; the same for the tilts over α.
struct StrokeScatter {
  double between = 0;
  double within = 0;
  double tilts = 0;
  double about_tilts = 0;
};
StrokeScatter stroke_scatter(const Evidence& evidence, const Fit& fit);

/// True if repeats differ by many times the scatter within a stroke, which no noise of a sensor does.
bool is_scattering(const measurement::NoiseFloor& noise);

/// True if strokes of one run and direction differ by more than noise.
bool is_walking(const StrokeScatter& scatter);

}  // namespace fusee::calibration
