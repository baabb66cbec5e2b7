/// \file
/// Internal: where a motor was held, and what of a stroke stands or falls together.
#pragma once

#include <vector>

#include "fusee/measurement/measurement.h"

namespace fusee {

/// Rows over which α stands, both included.
struct Hold {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// Of a log from point to point: the motor stands in most of its rows. None of a sweep, whose dwells stay in its
/// strokes.
std::vector<Hold> holds_in(const std::vector<Sample>& samples, double alpha_quantum);

/// Of what looks like a sensor's step, what is one: held angles lie on a grid too, of steps that no sensor has.
double quantum_beside(const std::vector<Hold>& holds, const std::vector<Sample>& samples, double Sample::*angle,
                      double quantum);

/// Each row of a hold at the hold's mean: the direction of what follows is that of the motor and not of its noise.
std::vector<Sample> settled(std::vector<Sample> samples, const std::vector<Hold>& holds);

/// Whether the load of the run is put on and taken off: by more than its noise and a tenth of itself.
bool has_levels_of_load(const Run& run);

/// The run's strokes cut where the motor stood and where the load changed its level. A load that is always the same at
/// the same place and direction is no level: it belongs to the place.
std::vector<Stretch> cut_stretches(const Run& run, const std::vector<Hold>& holds);

}  // namespace fusee
