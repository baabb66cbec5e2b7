/// \file
/// Internal: dwells of the motor, and segments of strokes.
#pragma once

#include <vector>

#include "fusee/measurement.h"

namespace fusee::measurement {

/// Rows from `first` to `last`, both included: mostly those of a dwell, in which α is constant.
struct RowRange {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// Dwells of a point-to-point log, in which the motor stands in most rows. Empty for a sweep; its dwells stay part of
/// its strokes.
std::vector<RowRange> dwells_in(const std::vector<Sample>& samples, double alpha_quantum);

/// `quantum` if it is the sensor's step; 0 if it is the step of a grid of dwell angles.
double sensor_quantum(const std::vector<RowRange>& dwells, const std::vector<Sample>& samples, double Sample::*angle,
                      double quantum);

/// Replaces each row of a dwell by the dwell's mean, so that the next direction is the motor's, not the noise's.
std::vector<Sample> settled(std::vector<Sample> samples, const std::vector<RowRange>& dwells);

/// True if the load changes within the run by more than its noise and a tenth of itself.
bool has_levels_of_load(const Run& run);

/// Cuts strokes at dwells and at changes of the load level. A load that repeats at the same place and direction is a
/// function of place, not a level.
std::vector<Segment> cut_segments(const Run& run, const std::vector<RowRange>& dwells);

}  // namespace fusee::measurement
