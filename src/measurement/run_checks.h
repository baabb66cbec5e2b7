/// \file
/// Internal: checks whether the runs can be evaluated at all, before any model is involved.
#pragma once

#include "fusee/measurement.h"
#include "measurement/repair.h"

namespace fusee::measurement {

/// Checks one run: enough rows, motion, live sensors. Reasons go to `into.not_testable`, remarks to `add_note`.
void check_run(const Run& run, Measurement& into, const NoteSink& add_note);

/// Checks all runs together: α must move in both directions.
void check_all_runs(Measurement& measurement);

}  // namespace fusee::measurement
