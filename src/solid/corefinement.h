/// \file
#pragma once

#include <optional>
#include <vector>

#include "fusee/solid.h"

namespace fusee::solid {

/// Two surfaces cut along their intersection line: patches that it does not cross. Facets do not share vertices.
struct Corefined {
  std::vector<TriangleMesh> first, second;
};

/// By CGAL's corefinement, with exact predicates. Both surfaces must not intersect themselves and may have borders.
/// Empty where one is no manifold.
std::optional<Corefined> corefined(const TriangleMesh& a, const TriangleMesh& b);

}  // namespace fusee::solid
