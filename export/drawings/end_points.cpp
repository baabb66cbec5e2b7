#include "export/drawings/end_points.h"

#include <algorithm>
#include <cmath>

namespace fusee::formats {

std::size_t EndPoints::CellHash::operator()(const Cell& cell) const {
  // Odd multipliers with mixed bits spread adjacent cells: 2⁶⁴ divided by the golden ratio, and a prime of xxHash64.
  const auto x = static_cast<std::uint64_t>(cell.x) * 0x9E3779B97F4A7C15u;
  const auto y = static_cast<std::uint64_t>(cell.y) * 0xC2B2AE3D27D4EB4Fu;
  return static_cast<std::size_t>((x ^ (x >> 31)) + (y ^ (y >> 29)));
}

// Cells are much wider than k_joined, so that for most points only their own cell is searched. They are narrow enough
// to hold about one point each.
std::size_t EndPoints::number(const Vec2& point) {
  constexpr double k_cell = 500 * k_joined;  // width, 0.05 mm
  const auto cell_of = [](double along) { return static_cast<std::int64_t>(std::floor(along / k_cell)); };
  std::size_t earliest = points_.size();
  for (std::int64_t x = cell_of(point.x() - k_joined); x <= cell_of(point.x() + k_joined); ++x) {
    for (std::int64_t y = cell_of(point.y() - k_joined); y <= cell_of(point.y() + k_joined); ++y) {
      const auto [first, last] = cells_.equal_range({x, y});
      for (auto it = first; it != last; ++it) {
        if ((points_[it->second] - point).norm() <= k_joined) earliest = std::min(earliest, it->second);
      }
    }
  }
  if (earliest < points_.size()) return earliest;
  cells_.emplace(Cell{cell_of(point.x()), cell_of(point.y())}, points_.size());
  points_.push_back(point);
  return points_.size() - 1;
}

}  // namespace fusee::formats
