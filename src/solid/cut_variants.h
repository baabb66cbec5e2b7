/// \file
/// Internal: number of cut variants. If rounding a cut to floats leaves a fault, the cut is repeated as another
/// variant, with other facets on the tools.
#pragma once

#include <algorithm>
#include <cstddef>

namespace fusee::solid {

inline constexpr int k_cut_variants = 8;
inline constexpr int k_brief_cut_variants = 2;  ///< variants of a brief search, used for advice

/// Number of variants out of `wanted` that keeps the total facet count bounded, at least two. A part of 110 000 facets
/// took ten seconds for eight equally good variants (campaign of seed 310001, design 171).
inline int cut_variants(std::size_t facets, int wanted) {
  constexpr std::size_t k_most_facets = 300'000;
  const std::size_t affordable = k_most_facets / std::max(facets, std::size_t{1});
  return static_cast<int>(std::clamp(affordable, std::size_t{k_brief_cut_variants}, static_cast<std::size_t>(wanted)));
}

}  // namespace fusee::solid
