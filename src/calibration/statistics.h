/// \file
/// What is said of fits: which of two is better and how surely, how much a rest repeats.
#pragma once

#include "calibration/fit.h"

namespace fusee {

/// Whether the evidence of two sets is the same as far as the data can tell.
bool as_good(const Evidence& evidence, const Fit& rival, const Fit& best);

/// Root of the mean square; 0 of none.
double rms_of(const Eigen::VectorXd& values);

/// α of all rows, as Block::rows counts them.
Eigen::VectorXd alphas(const Measurement& measurement);

/// Of the residual from row to row within blocks, −1 … 1.
double lag_one_correlation(const Evidence& evidence, const Fit& fit);

/// The ratio of two mean squares of the same noise, of so many degrees of freedom, that chance exceeds as seldom as a
/// normal number exceeds three standard deviations (Paulson 1942: the cube root of a mean square is nearly normal).
/// Infinite where the lower one is known too badly to say.
double rarest_ratio(double upper_freedom, double lower_freedom);

/// Of the residual: rms of the means of strokes about their run and direction, beyond what noise does to means, and rms
/// within strokes; the same of their tilts over α, by what these do to the rows, and rms about both. rad
struct StrokeScatter {
  double between = 0;
  double within = 0;
  double tilts = 0;
  double about_tilts = 0;
};
StrokeScatter stroke_scatter(const Evidence& evidence, const Fit& fit);

/// Repeats differ by many times what a stroke scatters by within itself: no noise of a sensor does that.
bool is_scattering(const NoiseFloor& noise);

/// Whether strokes of one run and direction differ by more than noise lets them.
bool is_walking(const StrokeScatter& scatter);

}  // namespace fusee
