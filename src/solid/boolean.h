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

struct CutBody {
  TriangleMesh mesh;                   ///< rounded to float
  std::vector<double> common_volumes;  ///< with each tool, in order, before rounding, mm³
};
/// One tool after the other, as subtract() would: tools that touch no facet that an earlier one touches are cut beside
/// it.
std::optional<CutBody> subtract_each(const TriangleMesh& body, const std::vector<TriangleMesh>& tools);
/// `a` and `b` as one.
std::optional<BooleanResult> unite(const TriangleMesh& a, const TriangleMesh& b);

/// Several disjoint meshes as one.
TriangleMesh together(const std::vector<TriangleMesh>& meshes);

}  // namespace fusee
