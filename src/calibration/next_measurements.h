/// \file
/// Measurements that distinguish the members of a group, and their margins.
#pragma once

#include <vector>

#include "calibration/selection.h"

namespace fusee::calibration {

/// Most decisive first, for the groups and verdict of `calibration`. Empty if no group has several members and nothing
/// is unexplained.
std::vector<plan::NextMeasurement> next_measurements(const Evidence& evidence, const Selection& selection,
                                                     const Calibration& calibration);

/// Plan of an unmeasured joint, for data that cannot be tested.
std::vector<plan::NextMeasurement> planned_measurements(const DeclaredMechanism& declared);

/// Adds a request to approach dwells from both sides, unless they were or a run sweeps over them in both directions.
void ask_for_both_sides(const measurement::Measurement& measurement, std::vector<plan::NextMeasurement>& next);

}  // namespace fusee::calibration
