/// \file
#pragma once

#include <cstdint>
#include <vector>

#include "fusee/base/plane.h"

namespace fusee {

/// Distances from points to closed loops, by a grid of cells: about constant time a question.
class NearestSegment {
 public:
  explicit NearestSegment(std::vector<Polygon> loops);
  double distance(const Vec2& point) const;

 private:
  struct Cell {
    long column, row;
  };
  Cell cell_of(const Vec2& point) const;
  double nearest_in(long column, long row, const Vec2& point) const;

  std::vector<Polygon> loops_;
  std::vector<std::pair<Vec2, Vec2>> segments_;
  Vec2 low_ = Vec2::Zero();
  double side_ = 1;
  long columns_ = 1, rows_ = 1;
  std::vector<std::vector<std::uint32_t>> cells_;
};

}  // namespace fusee
