/// \file
/// Which points of a drawing are the same point: within k_joined of each other. mm.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "fusee/base/plane.h"

namespace fusee {

/// Ends nearer than this meet: what a reader of drawings may call the same point without changing a part.
inline constexpr double k_joined = 1e-4;

/// Numbers points in the order in which they come; a point within k_joined of an earlier one gets that one's number, of
/// several the earliest's. Constant time a point: cells of a grid, and neighbours of those that the point is next to.
class EndPoints {
 public:
  std::size_t number(const Vec2& point);
  std::size_t size() const { return points_.size(); }

 private:
  struct Cell {
    std::int64_t x, y;
    bool operator==(const Cell&) const = default;
  };
  struct CellHash {
    std::size_t operator()(const Cell& cell) const;
  };
  std::unordered_multimap<Cell, std::size_t, CellHash> cells_;
  std::vector<Vec2> points_;
};

}  // namespace fusee
