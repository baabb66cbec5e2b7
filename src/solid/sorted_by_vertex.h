/// \file
/// Internal: sorting of items by mesh vertex.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace fusee::solid {

/// Sorts items by vertex (counting sort), and items of one vertex by `before`. Few items share a vertex, so this takes
/// a fraction of the time of a full sort.
template <typename Item, typename VertexOf, typename Before>
std::vector<Item> sorted_by_vertex(const std::vector<Item>& items, std::size_t vertices, const VertexOf& vertex_of,
                                   const Before& before) {
  std::vector<std::size_t> first(vertices + 1, 0);
  for (const Item& item : items) ++first[vertex_of(item) + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<std::size_t> next(first.begin(), first.end() - 1);
  std::vector<Item> sorted(items.size());
  for (const Item& item : items) sorted[next[vertex_of(item)]++] = item;
  for (std::size_t vertex = 0; vertex < vertices; ++vertex) {
    std::sort(sorted.begin() + static_cast<std::ptrdiff_t>(first[vertex]),
              sorted.begin() + static_cast<std::ptrdiff_t>(first[vertex + 1]), before);
  }
  return sorted;
}

}  // namespace fusee::solid
