/// \file
/// Internal: self-intersections of a mesh.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>

#include "fusee/solid.h"

namespace fusee::solid {

struct CrossingSearch {
  /// Two facets that meet outside their shared corners and edges.
  std::optional<std::pair<std::size_t, std::size_t>> facets;
  bool gave_up = false;  ///< more pairs of facets lie close together than in any real part
};

/// The first pair of facets found that cross, touch or overlap beyond a shared corner or edge. Exact. Accepts any
/// triangles with indices in range and finite coordinates. Facets without area and equal facets are skipped.
CrossingSearch find_crossing(const TriangleMesh& welded);

/// True if the three corners are collinear, decided exactly.
bool is_degenerate(const TriangleMesh& mesh, std::size_t facet);

}  // namespace fusee::solid
