/// \file
#pragma once

#include <cstddef>
#include <optional>
#include <utility>

#include "fusee/solid/mesh.h"

namespace fusee {

struct CrossingSearch {
  std::optional<std::pair<std::size_t, std::size_t>> facets;  ///< two facets that meet in more than what they share
  bool gave_up = false;  ///< more pairs of facets lie close together than any part has
};

/// The first two facets found that cross, touch or overlap beyond a shared corner or edge; exact. Any soup whose
/// indices are in range and whose coordinates are finite; facets without area and equal facets are passed over.
CrossingSearch find_crossing(const TriangleMesh& welded);

/// Three corners on a line, decided exactly.
bool is_degenerate(const TriangleMesh& mesh, std::size_t facet);

}  // namespace fusee
