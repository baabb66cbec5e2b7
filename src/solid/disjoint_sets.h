/// \file
/// Internal: union-find. The root of a set is its member of the lowest number.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

namespace fusee::solid {

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t root(std::size_t item) {
    // Path halving: each visited item is linked to its grandparent.
    while (parent_[item] != item) item = parent_[item] = parent_[parent_[item]];
    return item;
  }
  void unite(std::size_t a, std::size_t b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace fusee::solid
