/// \file
/// What is cut out of the body for a tie-off. mm, not yet scaled.
#pragma once

#include "fusee/solid/mesh.h"
#include "solid/plan.h"

namespace fusee {

/// Channel and knot pocket, the pocket open to the nearest face. Another `variant` has other facets.
TriangleMesh tie_off_tool(const BodyPlan& plan, const PlannedAnchor& anchor, int variant);

}  // namespace fusee
