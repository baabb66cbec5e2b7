/// \file
#pragma once

#include <optional>
#include <vector>

#include "fusee/solid/mesh.h"

namespace fusee {

/// Two surfaces cut along the line in which they meet: patches without such a line inside. A facet's vertices are its
/// own.
struct Corefined {
  std::vector<TriangleMesh> first, second;
};

/// By CGAL's corefinement, exact inside. Neither may cross itself; both may have borders. Null where one is no
/// manifold.
std::optional<Corefined> corefined(const TriangleMesh& a, const TriangleMesh& b);

}  // namespace fusee
