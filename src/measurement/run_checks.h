/// \file
/// Internal: whether anything can be concluded from runs, before any model is held against them.
#pragma once

#include "fusee/measurement/measurement.h"
#include "measurement/repair.h"

namespace fusee {

/// Too few rows, no motion, sensors that stand still. Reasons go to `into.not_testable`, remarks to `say`.
void look_at_run(const Run& run, Measurement& into, const Say& say);

/// What only all runs together tell: whether α goes both ways at all.
void look_at_all(Measurement& measurement);

}  // namespace fusee
