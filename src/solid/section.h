/// \file
#pragma once

#include <vector>

#include "fusee/solid/mesh.h"

namespace fusee {

using Triangles = decltype(TriangleMesh::triangles);

/// As section(), where it is known that one place is one vertex. `triangles`: of that mesh, all that the plane may cut.
std::vector<Polygon> section_of_welded(const TriangleMesh& mesh, const Triangles& triangles, double z);

}  // namespace fusee
