/// \file
/// Internal: the clock of a log.
#pragma once

#include "fusee/measurement/measurement.h"
#include "measurement/repair.h"

namespace fusee {

/// Afterwards time grows from row to row, or the run has none. Rows stay in the order of the file: a counter that runs
/// over goes on, and where the clock goes back otherwise the log began again (Sample::after_break). Only a row that was
/// delivered late, into a gap between the rows before it, is put back there. Rows of one time become one, their mean,
/// or are spread over the tick of a clock coarser than the log.
void order_time(Run& run, const Say& say);

}  // namespace fusee
