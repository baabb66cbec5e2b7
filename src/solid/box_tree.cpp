#include "solid/box_tree.h"

#include <algorithm>
#include <numeric>

namespace fusee {
namespace {

constexpr std::uint32_t k_leaf = 4;

double twice_middle(const Box3& box, std::size_t axis) { return box.low[axis] + box.high[axis]; }

}  // namespace

bool overlap(const Box3& a, const Box3& b) {
  return a.low[0] <= b.high[0] && b.low[0] <= a.high[0] && a.low[1] <= b.high[1] && b.low[1] <= a.high[1] &&
         a.low[2] <= b.high[2] && b.low[2] <= a.high[2];
}

BoxTree::BoxTree(const std::vector<Box3>& boxes) : boxes_(boxes), items_(boxes.size()) {
  std::iota(items_.begin(), items_.end(), 0u);
  nodes_.reserve(boxes.size());
  if (!boxes.empty()) add_node(0, static_cast<std::uint32_t>(boxes.size()));
}

void BoxTree::add_node(std::uint32_t first, std::uint32_t last) {
  Node node{boxes_[items_[first]], first, last, 0};
  Box3 middles{};
  for (std::size_t axis = 0; axis < 3; ++axis) middles.low[axis] = middles.high[axis] = twice_middle(node.box, axis);
  for (std::uint32_t i = first + 1; i < last; ++i) {
    const Box3& box = boxes_[items_[i]];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      node.box.low[axis] = std::min(node.box.low[axis], box.low[axis]);
      node.box.high[axis] = std::max(node.box.high[axis], box.high[axis]);
      middles.low[axis] = std::min(middles.low[axis], twice_middle(box, axis));
      middles.high[axis] = std::max(middles.high[axis], twice_middle(box, axis));
    }
  }
  const std::size_t place = nodes_.size();
  nodes_.push_back(node);
  if (last - first <= k_leaf) return;
  std::size_t widest = 0;
  for (std::size_t axis = 1; axis < 3; ++axis) {
    if (middles.high[axis] - middles.low[axis] > middles.high[widest] - middles.low[widest]) widest = axis;
  }
  const std::uint32_t half = first + (last - first) / 2;
  std::nth_element(items_.begin() + first, items_.begin() + half, items_.begin() + last,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double p = twice_middle(boxes_[a], widest), q = twice_middle(boxes_[b], widest);
                     return p < q || (p == q && a < b);
                   });
  add_node(first, half);
  nodes_[place].right = static_cast<std::uint32_t>(nodes_.size());
  add_node(half, last);
}

bool BoxTree::within(std::uint32_t node, const Look& look) const {
  const Node& here = nodes_[node];
  if (here.right != 0) return within(node + 1, look) || within(here.right, look) || between(node + 1, here.right, look);
  for (std::uint32_t i = here.first; i < here.last; ++i) {
    for (std::uint32_t j = i + 1; j < here.last; ++j) {
      if (overlap(boxes_[items_[i]], boxes_[items_[j]]) && look(items_[i], items_[j])) return true;
    }
  }
  return false;
}

bool BoxTree::between(std::uint32_t a, std::uint32_t b, const Look& look) const {
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

bool BoxTree::any_pair(const Look& look) const { return !nodes_.empty() && within(0, look); }

}  // namespace fusee
