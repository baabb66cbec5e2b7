/// \file
/// Internal: the demand that a mesh is a closed 2-manifold.
#pragma once

#include "fusee/solid.h"

namespace fusee::solid {

/// Throws Bug unless `mesh` is a closed 2-manifold, on which later cuts rely. `what`: name of the mesh in the message.
void demand_solid(const TriangleMesh& mesh, const char* what);

}  // namespace fusee::solid
