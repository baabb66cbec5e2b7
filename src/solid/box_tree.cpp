#include "solid/box_tree.h"

#include <algorithm>
#include <numeric>

namespace fusee {
namespace {

constexpr std::uint32_t k_leaf = 4;

Box3 around(const Box3& a, const Box3& b) {
  Box3 both;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    both.low[axis] = std::min(a.low[axis], b.low[axis]);
    both.high[axis] = std::max(a.high[axis], b.high[axis]);
  }
  return both;
}

}  // namespace

BoxTree::BoxTree(const std::vector<Box3>& boxes) : boxes_(boxes), items_(boxes.size()) {
  std::iota(items_.begin(), items_.end(), 0u);
  nodes_.reserve(boxes.size());
  if (boxes.empty()) return;
  Middles middles;
  middles.reserve(boxes.size());
  for (const Box3& box : boxes)
    middles.push_back({box.low[0] + box.high[0], box.low[1] + box.high[1], box.low[2] + box.high[2]});
  add_node(middles, 0, static_cast<std::uint32_t>(boxes.size()));
}

std::size_t BoxTree::widest_axis(const Middles& middles, std::uint32_t first, std::uint32_t last) const {
  std::array<double, 3> low = middles[items_[first]], high = low;
  for (std::uint32_t i = first + 1; i < last; ++i) {
    const auto& middle = middles[items_[i]];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], middle[axis]);
      high[axis] = std::max(high[axis], middle[axis]);
    }
  }
  std::size_t widest = 0;
  for (std::size_t axis = 1; axis < 3; ++axis) {
    if (high[axis] - low[axis] > high[widest] - low[widest]) widest = axis;
  }
  return widest;
}

void BoxTree::add_node(const Middles& middles, std::uint32_t first, std::uint32_t last) {
  const std::size_t place = nodes_.size();
  nodes_.push_back({boxes_[items_[first]], first, last, 0});
  if (last - first <= k_leaf) {
    for (std::uint32_t i = first + 1; i < last; ++i)
      nodes_[place].box = around(nodes_[place].box, boxes_[items_[i]]);
    return;
  }
  const std::size_t axis = widest_axis(middles, first, last);
  const std::uint32_t half = first + (last - first) / 2;
  std::nth_element(items_.begin() + first, items_.begin() + half, items_.begin() + last,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double p = middles[a][axis], q = middles[b][axis];
                     return p < q || (p == q && a < b);
                   });
  add_node(middles, first, half);
  const auto right = static_cast<std::uint32_t>(nodes_.size());
  add_node(middles, half, last);
  nodes_[place].right = right;
  nodes_[place].box = around(nodes_[place + 1].box, nodes_[right].box);
}

}  // namespace fusee
