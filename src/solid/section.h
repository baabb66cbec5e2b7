/// \file
/// Internal: horizontal sections of a welded mesh.
#pragma once

#include <vector>

#include "fusee/solid.h"

namespace fusee::solid {

using Triangles = decltype(TriangleMesh::triangles);

/// Like section(), for a welded mesh. `triangles`: all triangles of the mesh that the plane may cut.
std::vector<Polygon> section_of_welded(const TriangleMesh& mesh, const Triangles& triangles, double z);

}  // namespace fusee::solid
