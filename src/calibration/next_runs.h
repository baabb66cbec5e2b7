/// \file
/// Which measurement would tell the members of a group apart, and by how much: every proposal is simulated with each
/// member as it was fitted.
#pragma once

#include <string>
#include <vector>

#include "calibration/selection.h"

namespace fusee {

/// One sentence each, the most telling first. Empty when no group has more than one member.
std::vector<std::string> next_runs(const Evidence& evidence, const Selection& selection);

/// Adds what held points ask for that were come to from one side only, and that no run sweeps over there and back.
void ask_for_both_sides(const Measurement& measurement, std::vector<std::string>& next);

}  // namespace fusee
