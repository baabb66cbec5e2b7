/// \file
/// Internal: a run cut at the reversals of α.
#pragma once

#include <vector>

#include "fusee/measurement/measurement.h"
#include "measurement/stretches.h"

namespace fusee {

/// By direction of α, robust to noise and to a quantum: a reversal counts once α has come back from its extreme by more
/// than both and by a hundredth of the run's span. A gap in time over which α moved begins a new stroke, whose play
/// state is unknown: `partial`. Between holds there are no gaps: α went from one to the next. None where α only
/// jitters.
std::vector<Stroke> split_strokes(const std::vector<Sample>& samples, const std::vector<Hold>& holds,
                                  double alpha_quantum, bool has_time);

/// Rows before which α moved without being logged: after a pause in time, faster than it ever does, or where the log
/// begins again.
std::vector<std::size_t> gaps_in(const std::vector<Sample>& samples, bool has_time);

/// The value in the middle; 0 for none. Reorders its copy.
double median_of(std::vector<double> values);

/// Spread of white noise, from the sizes of second differences of a smooth curve that it lies on.
double white_noise_of(std::vector<double> second_differences);
/// The same of a logged number that goes on steadily between its stands …
double noise_of(const std::vector<Sample>& samples, double Sample::*value);
/// … and of one that mostly stands: of three rows a stand two bends in three are those of a step.
double noise_of_stands(const std::vector<Sample>& samples, double Sample::*value);

}  // namespace fusee
