/// \file
/// Which of many boxes overlap.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace fusee {

/// In three coordinates, whatever they are; its faces belong to it.
struct Box3 {
  std::array<double, 3> low, high;
};

inline bool overlap(const Box3& a, const Box3& b) {
  return a.low[0] <= b.high[0] && b.low[0] <= a.high[0] && a.low[1] <= b.high[1] && b.low[1] <= a.high[1] &&
         a.low[2] <= b.high[2] && b.low[2] <= a.high[2];
}

/// A tree of boxes, halved at the median of the coordinate in which they spread furthest. The same boxes give the same
/// tree.
class BoxTree {
 public:
  explicit BoxTree(const std::vector<Box3>& boxes);

  /// Calls `look`, (size_t, size_t) → bool, once for each two boxes that overlap, until it says true; whether it did.
  template <typename Look>
  bool any_pair(const Look& look) const {
    return any_pair_in_first_half(look) || any_pair_in_the_rest(look);
  }
  /// The same in two parts, which may be gone through at once.
  template <typename Look>
  bool any_pair_in_first_half(const Look& look) const {
    return !nodes_.empty() && within(nodes_.front().right == 0 ? 0 : 1, look);
  }
  template <typename Look>
  bool any_pair_in_the_rest(const Look& look) const {
    if (nodes_.empty() || nodes_.front().right == 0) return false;
    const std::uint32_t right = nodes_.front().right;
    return within(right, look) || between(1, right, look);
  }

 private:
  struct Node {
    Box3 box;
    std::uint32_t first = 0, last = 0;  ///< of items_, a leaf's
    std::uint32_t right = 0;            ///< the left child is the next node; 0: a leaf
  };
  /// A box that is being put into its place among the others.
  struct Sorted {
    std::array<double, 3> middle;  ///< twice
    std::uint32_t box;
  };

  static std::size_t widest_axis(const Sorted* first, const Sorted* last);
  void add_node(std::vector<Sorted>& sorted, std::uint32_t first, std::uint32_t last);

  template <typename Look>
  bool within(std::uint32_t node, const Look& look) const {
    const Node& here = nodes_[node];
    if (here.right != 0)
      return within(node + 1, look) || within(here.right, look) || between(node + 1, here.right, look);
    for (std::uint32_t i = here.first; i < here.last; ++i) {
      for (std::uint32_t j = i + 1; j < here.last; ++j) {
        if (overlap(boxes_[items_[i]], boxes_[items_[j]]) && look(items_[i], items_[j])) return true;
      }
    }
    return false;
  }

  template <typename Look>
  bool between(std::uint32_t a, std::uint32_t b, const Look& look) const {
    const Node &p = nodes_[a], &q = nodes_[b];
    if (!overlap(p.box, q.box)) return false;
    if (p.right != 0 && (q.right == 0 || p.last - p.first >= q.last - q.first))
      return between(a + 1, b, look) || between(p.right, b, look);
    if (q.right != 0) return between(a, b + 1, look) || between(a, q.right, look);
    for (std::uint32_t i = p.first; i < p.last; ++i) {
      if (!overlap(boxes_[items_[i]], q.box)) continue;
      for (std::uint32_t j = q.first; j < q.last; ++j) {
        if (overlap(boxes_[items_[i]], boxes_[items_[j]]) && look(items_[i], items_[j])) return true;
      }
    }
    return false;
  }

  const std::vector<Box3>& boxes_;
  std::vector<std::uint32_t> items_;
  std::vector<Node> nodes_;
};

}  // namespace fusee
