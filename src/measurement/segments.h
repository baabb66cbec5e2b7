/// \file
/// Internal: dwells of the motor, and segments of strokes.
#pragma once

#include <vector>

#include "fusee/measurement.h"

namespace fusee::measurement {

/// Rows from `first` to `last`, both included: of a dwell, in which α is constant, or of a piece of a stroke.
struct RowRange {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// Dwells of a point-to-point log, in which the motor stands in most rows. Empty for a sweep: a pause in it is part of
/// a stroke. `alpha_quantum`: sensor step, rad.
std::vector<RowRange> dwells_in(const std::vector<Sample>& samples, double alpha_quantum);

/// Returns `quantum`, in rad, if it is the sensor's step; 0 if it is the step of a grid of dwell angles.
double sensor_quantum(const std::vector<RowRange>& dwells, const std::vector<Sample>& samples, double Sample::*angle,
                      double quantum);

/// Replaces α in each row of a dwell by the dwell's mean, so that the noise in a dwell is not taken for a reversal.
std::vector<Sample> with_mean_alpha_in_dwells(std::vector<Sample> samples, const std::vector<RowRange>& dwells);

/// True if the load changes within the run by more than its noise and a tenth of itself.
bool has_levels_of_load(const Run& run);

/// Cuts strokes at dwells and at changes of the load level. A load that repeats at the same α and direction is a
/// function of α, not a level.
std::vector<Segment> cut_segments(const Run& run, const std::vector<RowRange>& dwells);

}  // namespace fusee::measurement
