// The tree finds each overlapping pair once, compared with a search over all pairs.
#include "solid/box_tree.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace fusee::solid {
namespace {

using Pairs = std::multiset<std::pair<std::size_t, std::size_t>>;

Pairs pairs_of_tree(const std::vector<Box3>& boxes) {
  Pairs pairs;
  BoxTree(boxes).any_pair([&](std::size_t a, std::size_t b) {
    pairs.insert(std::minmax({a, b}));
    return false;
  });
  return pairs;
}

Pairs pairs_by_comparison(const std::vector<Box3>& boxes) {
  Pairs pairs;
  for (std::size_t a = 0; a < boxes.size(); ++a) {
    for (std::size_t b = a + 1; b < boxes.size(); ++b) {
      if (overlap(boxes[a], boxes[b])) pairs.insert({a, b});
    }
  }
  return pairs;
}

// Boxes on a coarse grid: many touch or coincide, and some are needles.
std::vector<Box3> random_boxes(std::size_t count, std::mt19937& draw) {
  std::uniform_int_distribution<int> place(0, 12), size(0, 2), chance(0, 9);
  std::vector<Box3> boxes(count);
  for (Box3& box : boxes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.low[axis] = place(draw);
      box.high[axis] = box.low[axis] + (chance(draw) == 0 ? 12 : size(draw));
    }
  }
  return boxes;
}

TEST(BoxTree, FindsEveryPairOnce) {
  std::mt19937 draw(3);
  for (const std::size_t count : {0u, 1u, 2u, 4u, 5u, 9u, 40u, 300u}) {
    const std::vector<Box3> boxes = random_boxes(count, draw);
    EXPECT_EQ(pairs_of_tree(boxes), pairs_by_comparison(boxes)) << count << " boxes";
  }
}

TEST(BoxTree, StopsOnRequest) {
  std::mt19937 draw(4);
  const std::vector<Box3> boxes = random_boxes(100, draw);
  int calls = 0;
  EXPECT_TRUE(BoxTree(boxes).any_pair([&](std::size_t, std::size_t) { return ++calls == 3; }));
  EXPECT_EQ(calls, 3);
}

}  // namespace
}  // namespace fusee::solid
