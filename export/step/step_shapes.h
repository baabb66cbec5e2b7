/// \file
/// Internal: the cut features of a pulley as exact shapes: the holes of solid/tools.h and solid/tie_off_tools.h with
/// circles instead of facets. mm, not yet scaled.
#pragma once

#include <vector>

#include "export/step/step_part.h"
#include "fusee/solid.h"

namespace fusee::formats {

std::vector<StepTool> step_cuts(const Mechanism& mechanism, const solid::Pulley& pulley);
std::vector<StepTool> step_raised(const Mechanism& mechanism, const solid::Pulley& pulley);

/// Volume between the round holes and the mesh's facets, which are outside them. mm³
double round_hole_excess(const solid::Pulley& pulley);

}  // namespace fusee::formats
