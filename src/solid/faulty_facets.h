/// \file
/// Internal: facets that are faulty in themselves, and the surface without them. One such facet would reappear as open
/// edges, crowded edges and crossings, so the other checks of a mesh exclude it.
#pragma once

#include <cstdint>
#include <vector>

#include "fusee/solid.h"

namespace fusee::solid {

/// Facet numbers in increasing order.
struct FaultyFacets {
  std::vector<std::uint32_t> degenerate;  ///< corners on a line, or two equal
  std::vector<std::uint32_t> duplicate;   ///< the same three corners as an earlier facet that is not degenerate

  bool none() const { return degenerate.empty() && duplicate.empty(); }
};

/// A subset of the facets of a mesh.
struct ExaminedSurface {
  TriangleMesh mesh;
  std::vector<std::uint32_t> numbers;  ///< facet numbers in the whole mesh; empty: identical

  std::size_t number_of(std::size_t facet) const { return numbers.empty() ? facet : numbers[facet]; }
};

/// Requires indices in range and finite coordinates.
FaultyFacets find_faulty_facets(const TriangleMesh& welded);

/// The surface after each degenerate facet has collapsed and each duplicate is removed. A needle, with one corner
/// inside its longest edge, closes the surface between its neighbours. The neighbour across that edge is split there.
ExaminedSurface without_faulty_facets(const TriangleMesh& welded, const FaultyFacets& faulty);

}  // namespace fusee::solid
