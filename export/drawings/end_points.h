/// \file
/// Internal: gives one number to points of a drawing within k_joined of each other. mm.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "fusee/base.h"

namespace fusee::formats {

/// Largest distance of ends that meet. A reader of drawings may merge them without changing a part.
inline constexpr double k_joined = 1e-4;

/// Numbers points in order. A point within k_joined of earlier ones gets the number of the earliest. Each point takes
/// constant time, because only grid cells within k_joined of it are searched.
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

}  // namespace fusee::formats
