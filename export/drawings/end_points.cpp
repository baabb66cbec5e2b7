#include "export/drawings/end_points.h"

#include <cmath>

namespace fusee {

std::size_t EndPoints::CellHash::operator()(const Cell& cell) const {
  const auto x = static_cast<std::uint64_t>(cell.x) * 0x9E3779B97F4A7C15u;
  const auto y = static_cast<std::uint64_t>(cell.y) * 0xC2B2AE3D27D4EB4Fu;
  return static_cast<std::size_t>((x ^ (x >> 31)) + (y ^ (y >> 29)));
}

std::size_t EndPoints::number(const Vec2& point) {
  const Cell home{static_cast<std::int64_t>(std::floor(point.x() / k_joined)),
                  static_cast<std::int64_t>(std::floor(point.y() / k_joined))};
  for (std::int64_t dx = -1; dx <= 1; ++dx) {
    for (std::int64_t dy = -1; dy <= 1; ++dy) {
      const auto [first, last] = cells_.equal_range({home.x + dx, home.y + dy});
      for (auto it = first; it != last; ++it) {
        if ((points_[it->second] - point).norm() <= k_joined) return it->second;
      }
    }
  }
  cells_.emplace(home, points_.size());
  points_.push_back(point);
  return points_.size() - 1;
}

}  // namespace fusee
