/// \file
/// Which of many boxes overlap.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace fusee {

/// In three coordinates, whatever they are; its faces belong to it.
struct Box3 {
  std::array<double, 3> low, high;
};

bool overlap(const Box3& a, const Box3& b);

/// A tree of boxes, halved at the median of the coordinate in which they spread furthest. The same boxes give the same
/// tree.
class BoxTree {
 public:
  explicit BoxTree(const std::vector<Box3>& boxes);

  /// Calls `look` once for each two boxes that overlap, until it says true; whether it did.
  bool any_pair(const std::function<bool(std::size_t, std::size_t)>& look) const;

 private:
  struct Node {
    Box3 box;
    std::uint32_t first = 0, last = 0;  ///< of items_, a leaf's
    std::uint32_t right = 0;            ///< the left child is the next node; 0: a leaf
  };
  using Look = std::function<bool(std::size_t, std::size_t)>;
  void add_node(std::uint32_t first, std::uint32_t last);
  bool within(std::uint32_t node, const Look& look) const;
  bool between(std::uint32_t a, std::uint32_t b, const Look& look) const;

  const std::vector<Box3>& boxes_;
  std::vector<std::uint32_t> items_;
  std::vector<Node> nodes_;
};

}  // namespace fusee
