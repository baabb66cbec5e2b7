/// \file
/// Facets that are faults in themselves, and the surface without them. Left in place, one such facet shows up again as
/// open edges, crowded edges and crossings, so the other checks of a mesh are made without it.
#pragma once

#include <cstdint>
#include <vector>

#include "fusee/solid/mesh.h"

namespace fusee {

/// Numbers of facets, rising.
struct FaultyFacets {
  std::vector<std::uint32_t> degenerate;  ///< corners on a line, or two equal
  std::vector<std::uint32_t> duplicate;   ///< the same three corners as an earlier facet that is not degenerate

  bool none() const { return degenerate.empty() && duplicate.empty(); }
};

/// Some facets of a mesh.
struct ExaminedSurface {
  TriangleMesh mesh;
  std::vector<std::uint32_t> numbers;  ///< of its facets in the whole mesh; empty: the same

  std::size_t number_of(std::size_t facet) const { return numbers.empty() ? facet : numbers[facet]; }
};

/// Indices in range, coordinates finite.
FaultyFacets find_faulty_facets(const TriangleMesh& welded);

/// The surface as it is once each degenerate facet has collapsed and each duplicate is gone. A needle, with one corner
/// inside its longest edge, closes the surface between its neighbours: the neighbour across that edge is split there.
ExaminedSurface without_faulty_facets(const TriangleMesh& welded, const FaultyFacets& faulty);

}  // namespace fusee
