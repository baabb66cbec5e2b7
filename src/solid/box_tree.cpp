#include "solid/box_tree.h"

#include <algorithm>

namespace fusee::solid {
namespace {

// Largest number of boxes in a leaf.
constexpr std::uint32_t k_leaf_size = 4;

Box3 around(const Box3& a, const Box3& b) {
  Box3 both;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    both.low[axis] = std::min(a.low[axis], b.low[axis]);
    both.high[axis] = std::max(a.high[axis], b.high[axis]);
  }
  return both;
}

}  // namespace

BoxTree::BoxTree(const std::vector<Box3>& boxes) : boxes_(boxes) {
  if (boxes.empty()) return;
  nodes_.reserve(boxes.size());
  std::vector<SortedBox> sorted;
  sorted.reserve(boxes.size());
  for (const Box3& box : boxes) {
    sorted.push_back({{box.low[0] + box.high[0], box.low[1] + box.high[1], box.low[2] + box.high[2]},
                      static_cast<std::uint32_t>(sorted.size())});
  }
  add_node(sorted, 0, static_cast<std::uint32_t>(boxes.size()));
  items_.reserve(boxes.size());
  for (const SortedBox& item : sorted) items_.push_back(item.box);
}

std::size_t BoxTree::widest_axis(const SortedBox* first, const SortedBox* last) {
  std::array<double, 3> low = first->twice_centre, high = low;
  for (const SortedBox* item = first + 1; item != last; ++item) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], item->twice_centre[axis]);
      high[axis] = std::max(high[axis], item->twice_centre[axis]);
    }
  }
  std::size_t widest = 0;
  for (std::size_t axis = 1; axis < 3; ++axis) {
    if (high[axis] - low[axis] > high[widest] - low[widest]) widest = axis;
  }
  return widest;
}

void BoxTree::add_node(std::vector<SortedBox>& sorted, std::uint32_t first, std::uint32_t last) {
  const std::size_t node = nodes_.size();
  nodes_.push_back({boxes_[sorted[first].box], first, last, 0});
  if (last - first <= k_leaf_size) {
    for (std::uint32_t i = first + 1; i < last; ++i) nodes_[node].box = around(nodes_[node].box, boxes_[sorted[i].box]);
    return;
  }
  const std::size_t axis = widest_axis(sorted.data() + first, sorted.data() + last);
  const std::uint32_t half = first + (last - first) / 2;
  std::nth_element(sorted.begin() + first, sorted.begin() + half, sorted.begin() + last,
                   [axis](const SortedBox& a, const SortedBox& b) {
                     const double p = a.twice_centre[axis], q = b.twice_centre[axis];
                     return p < q || (p == q && a.box < b.box);
                   });
  add_node(sorted, first, half);
  const auto right = static_cast<std::uint32_t>(nodes_.size());
  add_node(sorted, half, last);
  nodes_[node].right = right;
  nodes_[node].box = around(nodes_[node + 1].box, nodes_[right].box);
}

}  // namespace fusee::solid
