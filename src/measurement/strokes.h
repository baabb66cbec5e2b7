/// \file
/// Internal: cuts a run at the reversals of α.
#pragma once

#include <vector>

#include "fusee/measurement.h"
#include "measurement/segments.h"

namespace fusee::measurement {

/// Strokes by direction of α. A reversal counts once α has returned from its extreme by more than noise, quantisation
/// and 1 % of the run's span. A stroke is `partial`, with an unknown state of play, after a gap over which α moved. So
/// is a first stroke that departs from its repeats only at its beginning. Between the dwells of a point-to-point log
/// there are no gaps. Empty if α only jitters.
std::vector<Stroke> split_strokes(const std::vector<Sample>& samples, const std::vector<RowRange>& dwells,
                                  double alpha_quantum, bool has_time);

/// Rows before which α moved without being logged: after a pause, after a step larger than the speeds in the log
/// explain, or at a restart of the log.
std::vector<std::size_t> gaps_in(const std::vector<Sample>& samples, bool has_time);

/// Median; 0 for an empty list.
double median_of(std::vector<double> values);

/// Standard deviation of white noise, from the magnitudes of second differences of a smooth curve plus noise.
double white_noise_of(std::vector<double> second_differences);
/// Noise of a logged number that changes steadily between dwells.
double noise_of(const std::vector<Sample>& samples, double Sample::*value);
/// Noise of a logged number that is constant in most rows. With three rows per dwell, two of three second differences
/// contain a step.
double noise_of_dwells(const std::vector<Sample>& samples, double Sample::*value);

}  // namespace fusee::measurement
