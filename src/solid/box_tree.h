/// \file
/// Internal: finds overlapping boxes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace fusee::solid {

/// A box in any three coordinates, including its faces.
struct Box3 {
  std::array<double, 3> low, high;
};

inline bool overlap(const Box3& a, const Box3& b) {
  return a.low[0] <= b.high[0] && b.low[0] <= a.high[0] && a.low[1] <= b.high[1] && b.low[1] <= a.high[1] &&
         a.low[2] <= b.high[2] && b.low[2] <= a.high[2];
}

/// A tree of boxes, halved at the median of the coordinate in which they spread furthest. Equal boxes give equal trees.
/// Keeps a reference to the boxes.
class BoxTree {
 public:
  explicit BoxTree(const std::vector<Box3>& boxes);

  /// Calls `visit`, (size_t, size_t) → bool, for each pair of overlapping boxes until it returns true. Returns true if
  /// it did.
  template <typename Visitor>
  bool any_pair(const Visitor& visit) const {
    return any_pair_in_first_half(visit) || any_pair_in_second_half(visit);
  }
  /// Like any_pair, split in two halves that may run in parallel: the pairs within the root's left child, and the
  /// others.
  template <typename Visitor>
  bool any_pair_in_first_half(const Visitor& visit) const {
    return !nodes_.empty() && within(nodes_.front().right == 0 ? 0 : 1, visit);
  }
  template <typename Visitor>
  bool any_pair_in_second_half(const Visitor& visit) const {
    if (nodes_.empty() || nodes_.front().right == 0) return false;
    const std::uint32_t right = nodes_.front().right;
    return within(right, visit) || between(1, right, visit);
  }

 private:
  struct Node {
    Box3 box;
    std::uint32_t first = 0, last = 0;  ///< range of its boxes in items_, without `last`
    std::uint32_t right = 0;            ///< index of the right child, 0: a leaf; the left child is the next node
  };
  /// A box during sorting.
  struct SortedBox {
    std::array<double, 3> twice_centre;
    std::uint32_t box;  ///< its index
  };

  static std::size_t widest_axis(const SortedBox* first, const SortedBox* last);
  void add_node(std::vector<SortedBox>& sorted, std::uint32_t first, std::uint32_t last);

  template <typename Visitor>
  bool within(std::uint32_t node, const Visitor& visit) const {
    const Node& here = nodes_[node];
    if (here.right != 0)
      return within(node + 1, visit) || within(here.right, visit) || between(node + 1, here.right, visit);
    for (std::uint32_t i = here.first; i < here.last; ++i) {
      for (std::uint32_t j = i + 1; j < here.last; ++j) {
        if (overlap(boxes_[items_[i]], boxes_[items_[j]]) && visit(items_[i], items_[j])) return true;
      }
    }
    return false;
  }

  template <typename Visitor>
  bool between(std::uint32_t a, std::uint32_t b, const Visitor& visit) const {
    const Node &p = nodes_[a], &q = nodes_[b];
    if (!overlap(p.box, q.box)) return false;
    if (p.right != 0 && (q.right == 0 || p.last - p.first >= q.last - q.first))
      return between(a + 1, b, visit) || between(p.right, b, visit);
    if (q.right != 0) return between(a, b + 1, visit) || between(a, q.right, visit);
    for (std::uint32_t i = p.first; i < p.last; ++i) {
      if (!overlap(boxes_[items_[i]], q.box)) continue;
      for (std::uint32_t j = q.first; j < q.last; ++j) {
        if (overlap(boxes_[items_[i]], boxes_[items_[j]]) && visit(items_[i], items_[j])) return true;
      }
    }
    return false;
  }

  const std::vector<Box3>& boxes_;
  std::vector<std::uint32_t> items_;  ///< indices of boxes, in the order of the leaves
  std::vector<Node> nodes_;
};

}  // namespace fusee::solid
