/// \file
/// Internal: what a logger spoils and a reader can put right. Every repair is said.
#pragma once

#include <functional>
#include <string>

#include "fusee/measurement/measurement.h"

namespace fusee {

using Say = std::function<void(const std::string&)>;

/// An encoder that jumps by about a turn was wrapped around. Not the motor's where θ goes by a quarter of its span at
/// the same time: from point to point a motor may turn as far between two rows.
void unwrap(std::vector<Sample>& samples, double Sample::*angle, const std::string& name, const Say& say);

/// Single rows far off their neighbours are dropped: spikes of a sensor, not motion. A step that stays is no outlier.
void drop_outliers(Run& run, const Say& say);

/// A load or temperature that was not logged for a moment is the last one that was. False when it was never logged.
bool fill_gaps(std::vector<Sample>& samples, double Sample::*value, const std::string& name, const Say& say);

/// The step of a sensor that only knows multiples of it; 0 when its values are finer than can be told.
double quantum_of(const std::vector<Sample>& samples, double Sample::*angle);

}  // namespace fusee
