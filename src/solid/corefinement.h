/// \file
/// Internal: cuts two surfaces along their intersection line.
#pragma once

#include <optional>
#include <vector>

#include "fusee/solid.h"

namespace fusee::solid {

/// Two surfaces cut along their intersection line: patches that it does not cross. Facets do not share vertices.
struct CorefinedPair {
  std::vector<TriangleMesh> first, second;
};

/// Cuts both surfaces by CGAL's corefinement, with exact predicates. They must not intersect themselves and may have
/// borders. Empty if one of them is not manifold.
std::optional<CorefinedPair> corefined(const TriangleMesh& a, const TriangleMesh& b);

}  // namespace fusee::solid
