/// \file
#pragma once

#include "fusee/solid.h"

namespace fusee::solid {

/// Builds the half-edge mesh of `mesh` and demands (Bug) that it is a closed 2-manifold. Later cuts rely on it.
void demand_solid(const TriangleMesh& mesh, const char* what);

}  // namespace fusee::solid
