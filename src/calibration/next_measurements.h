/// \file
/// The measurements that would distinguish the members of a group, and by how much.
#pragma once

#include <vector>

#include "calibration/selection.h"

namespace fusee {

/// The most decisive first; of `calibration`, which has its groups and its verdict. Empty where no group has more than
/// one member and nothing stays unexplained.
std::vector<NextMeasurement> next_measurements(const Evidence& evidence, const Selection& selection,
                                               const Calibration& calibration);

/// For data that decide nothing: the plan of a joint that was not measured.
std::vector<NextMeasurement> planned_measurements(const DeclaredMechanism& declared);

/// Adds what held points ask for that were come to from one side only, and that no run sweeps over there and back.
void ask_for_both_sides(const Measurement& measurement, std::vector<NextMeasurement>& next);

}  // namespace fusee
