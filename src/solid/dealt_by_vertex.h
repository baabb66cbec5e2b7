/// \file
/// Internal: sorting what belongs to the vertices of a mesh.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace fusee {

/// Sorted by a vertex, and by `before` those of the same one: a handful, so that dealing them out takes a fraction of
/// the time of sorting all.
template <typename Item, typename VertexOf, typename Before>
std::vector<Item> dealt_by_vertex(const std::vector<Item>& items, std::size_t vertices, const VertexOf& vertex_of,
                                  const Before& before) {
  std::vector<std::size_t> first(vertices + 1, 0);
  for (const Item& item : items) ++first[vertex_of(item) + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<std::size_t> next(first.begin(), first.end() - 1);
  std::vector<Item> dealt(items.size());
  for (const Item& item : items) dealt[next[vertex_of(item)]++] = item;
  for (std::size_t vertex = 0; vertex < vertices; ++vertex) {
    std::sort(dealt.begin() + static_cast<std::ptrdiff_t>(first[vertex]),
              dealt.begin() + static_cast<std::ptrdiff_t>(first[vertex + 1]), before);
  }
  return dealt;
}

}  // namespace fusee
