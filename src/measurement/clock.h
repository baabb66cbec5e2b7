/// \file
/// Internal: repairs the clock of a log.
#pragma once

#include "fusee/measurement.h"
#include "measurement/repair.h"

namespace fusee::measurement {

/// Makes the time of a run increase from row to row, or drops it. Rows keep their order: an overflowing counter is
/// continued, and a clock that is set back marks a restart (Sample::after_break). Only late rows that fit into an
/// earlier gap are moved into it. Rows with equal times are averaged, or spread over the tick if the clock is coarser
/// than the log.
void order_time(Run& run, const NoteSink& add_note);

}  // namespace fusee::measurement
