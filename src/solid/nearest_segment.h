/// \file
/// Internal: distances from points to closed loops.
#pragma once

#include <cstdint>
#include <vector>

#include "fusee/base.h"

namespace fusee::solid {

/// Distances from points to closed loops, by a grid of cells. A query takes about constant time.
class NearestSegment {
 public:
  struct Nearest {
    double distance;
    std::size_t segment;  ///< its index in segments(); 0 without any
  };

  explicit NearestSegment(const std::vector<Polygon>& loops);
  double distance(const Vec2& point) const { return nearest(point).distance; }
  /// The distance is infinite without segments.
  Nearest nearest(const Vec2& point) const;
  /// True if the line certainly touches no segment.
  bool is_clear(const Vec2& from, const Vec2& to) const;
  /// The segments of all loops, in order.
  const std::vector<std::pair<Vec2, Vec2>>& segments() const { return segments_; }

 private:
  struct Cell {
    long column, row;
  };
  Cell cell_of(const Vec2& point) const;
  std::size_t index_of(long column, long row) const { return static_cast<std::size_t>(row * columns_ + column); }
  template <typename Visit>
  void for_cells_of(const std::pair<Vec2, Vec2>& segment, const Visit& visit) const;
  void search_cell(Nearest& nearest, long column, long row, const Vec2& point) const;

  std::vector<std::pair<Vec2, Vec2>> segments_;
  Vec2 low_ = Vec2::Zero();
  double side_ = 1;  // length of a cell's side
  long columns_ = 1, rows_ = 1;
  // Segments in cell k: cells_[first_[k]] up to, not including, cells_[first_[k + 1]].
  std::vector<std::uint32_t> first_, cells_;
};

}  // namespace fusee::solid
