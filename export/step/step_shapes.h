/// \file
/// What is cut out of a pulley, as exact shapes: the holes of solid/tools.h and solid/tie_off_tools.h, round where
/// those have facets. mm, not yet scaled.
#pragma once

#include <vector>

#include "export/step/step_part.h"
#include "fusee/solid/pulley.h"

namespace fusee {

std::vector<StepTool> step_cuts(const Mechanism& mechanism, const Pulley& pulley);
std::vector<StepTool> step_raised(const Mechanism& mechanism, const Pulley& pulley);

/// What round holes leave of the part that the mesh's facets, which stand around them, take. mm³
double round_holes_leave(const Pulley& pulley);

}  // namespace fusee
