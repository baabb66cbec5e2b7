/// \file
/// Internal: the cut features of a pulley as exact shapes: the holes of solid/tools.h and solid/tie_off_tools.h with
/// circles instead of facets. mm, not yet scaled.
#pragma once

#include <vector>

#include "export/step/step_part.h"
#include "fusee/solid.h"

namespace fusee::formats {

/// Features to cut from the body, such as bore, channels and engraved marks.
std::vector<StepTool> step_cuts(const Mechanism& mechanism, const solid::Pulley& pulley);
/// Features to add to the body: raised marks on the upper face.
std::vector<StepTool> step_raised(const Mechanism& mechanism, const solid::Pulley& pulley);

/// Volume between the round holes and the mesh's holes, which are polygons around them. mm³
double round_hole_excess(const solid::Pulley& pulley);

}  // namespace fusee::formats
