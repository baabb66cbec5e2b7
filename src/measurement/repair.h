/// \file
/// Internal: repairs defects of a log. Each repair adds a note.
#pragma once

#include <functional>
#include <string>

#include "fusee/measurement.h"

namespace fusee::measurement {

using NoteSink = std::function<void(const std::string&)>;

/// Unwraps an encoder that jumps by a turn, within 80°. A jump of the motor's encoder is kept if θ moves by a quarter
/// of its span at the same time: in a point-to-point log a motor may turn as far between two rows.
void unwrap(std::vector<Sample>& samples, double Sample::*angle, const std::string& name, const NoteSink& add_note);

/// Drops single rows far from their neighbours: sensor spikes. A lasting step is not an outlier.
void drop_outliers(Run& run, const NoteSink& add_note);

/// Replaces missing loads or temperatures by the last logged value; at the beginning by the first. False if there is no
/// value at all.
bool fill_gaps(std::vector<Sample>& samples, double Sample::*value, const std::string& name, const NoteSink& add_note);

/// Step of a quantised sensor; 0 if it is too fine to be detected.
double quantum_of(const std::vector<Sample>& samples, double Sample::*angle);

}  // namespace fusee::measurement
