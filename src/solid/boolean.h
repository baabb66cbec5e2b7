/// \file
/// Internal: boolean operations on closed meshes, by CGAL's corefinement. Computed exactly; results are rounded to
/// float.
#pragma once

#include <optional>
#include <vector>

#include "fusee/solid.h"

namespace fusee::solid {

struct BooleanResult {
  TriangleMesh mesh;         ///< rounded to float
  double common_volume = 0;  ///< volume of the intersection, before rounding, mm³
};

/// `body` minus `tool`. Empty when the surfaces meet in a way that leaves no manifold.
std::optional<BooleanResult> subtract(const TriangleMesh& body, const TriangleMesh& tool);

struct CutBody {
  TriangleMesh mesh;                   ///< rounded to float
  std::vector<double> common_volumes;  ///< volume of the intersection with each tool, in order, before rounding, mm³
};
/// Subtracts one tool after the other, with the same result as subtract(). Tools that share no touched facets are cut
/// in parallel.
std::optional<CutBody> subtract_each(const TriangleMesh& body, const std::vector<TriangleMesh>& tools);
/// The union of `a` and `b`.
std::optional<BooleanResult> unite(const TriangleMesh& a, const TriangleMesh& b);

/// Several disjoint meshes in one.
TriangleMesh together(const std::vector<TriangleMesh>& meshes);

}  // namespace fusee::solid
