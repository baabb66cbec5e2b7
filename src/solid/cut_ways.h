/// \file
/// Internal: in how many ways a body is cut. Where rounding a cut to floats left a fault, it is tried again with other
/// facets on the tools.
#pragma once

#include <algorithm>
#include <cstddef>

namespace fusee {

inline constexpr int k_cut_ways = 8;
inline constexpr int k_brief_cut_ways = 2;  ///< while advice is searched for

/// Of as many as are wanted. So many facets are cut in all: a large part is tried in fewer ways, and no less than two.
/// One of 110 000 took ten seconds for eight ways that are all as good (campaign of seed 310001, design 171).
inline int cut_ways(std::size_t facets, int wanted) {
  constexpr std::size_t k_most_facets = 300'000;
  const std::size_t ways = k_most_facets / std::max(facets, std::size_t{1});
  return static_cast<int>(std::clamp(ways, std::size_t{k_brief_cut_ways}, static_cast<std::size_t>(wanted)));
}

}  // namespace fusee
