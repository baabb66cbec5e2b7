/// \file
/// Booleans of closed meshes, by CGAL's corefinement. Exact inside; results are rounded to float.
#pragma once

#include <optional>
#include <vector>

#include "fusee/solid/mesh.h"

namespace fusee {

struct BooleanResult {
  TriangleMesh mesh;         ///< rounded to float
  double common_volume = 0;  ///< of what both had in common, before rounding, mm³
};

/// `body` without `tool`. Null when the surfaces meet in a way that leaves no manifold.
std::optional<BooleanResult> subtract(const TriangleMesh& body, const TriangleMesh& tool);
/// `a` and `b` as one.
std::optional<BooleanResult> unite(const TriangleMesh& a, const TriangleMesh& b);

/// Several disjoint meshes as one.
TriangleMesh together(const std::vector<TriangleMesh>& meshes);

}  // namespace fusee
