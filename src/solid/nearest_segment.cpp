#include "solid/nearest_segment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace fusee::solid {
namespace {

// True if the other line's ends lie on one side of this line, by more than rounding.
bool on_one_side(const Vec2& from, const Vec2& to, const Vec2& a, const Vec2& b) {
  constexpr double k_relative_margin = 1e-12;
  const Vec2 along = to - from, to_a = a - from, to_b = b - from;
  const double size = along.cwiseAbs().maxCoeff() * std::max(to_a.cwiseAbs().maxCoeff(), to_b.cwiseAbs().maxCoeff());
  const double side_of_a = cross(along, to_a), side_of_b = cross(along, to_b);
  return std::min(side_of_a, side_of_b) > k_relative_margin * size ||
         std::max(side_of_a, side_of_b) < -k_relative_margin * size;
}

}  // namespace

template <typename Visit>
void NearestSegment::for_cells_of(const std::pair<Vec2, Vec2>& segment, const Visit& visit) const {
  const auto& [a, b] = segment;
  const Cell from = cell_of(a.cwiseMin(b)), to = cell_of(a.cwiseMax(b));
  for (long row = from.row; row <= to.row; ++row) {
    for (long column = from.column; column <= to.column; ++column) visit(index_of(column, row));
  }
}

NearestSegment::NearestSegment(const std::vector<Polygon>& loops) {
  Vec2 high = Vec2::Constant(-std::numeric_limits<double>::infinity());
  low_ = -high;
  for (const Polygon& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      segments_.emplace_back(loop[i], loop[(i + 1) % loop.size()]);
      low_ = low_.cwiseMin(loop[i]);
      high = high.cwiseMax(loop[i]);
    }
  }
  if (segments_.empty()) return;
  const Vec2 size = high - low_;
  side_ = std::max(size.maxCoeff() / std::ceil(std::sqrt(static_cast<double>(segments_.size()))),
                   std::numeric_limits<double>::min());
  columns_ = static_cast<long>(size.x() / side_) + 1;
  rows_ = static_cast<long>(size.y() / side_) + 1;
  first_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
  for (const auto& segment : segments_) for_cells_of(segment, [this](std::size_t cell) { ++first_[cell + 1]; });
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  cells_.resize(first_.back());
  std::vector<std::uint32_t> end(first_.begin(), first_.end() - 1);
  for (std::uint32_t s = 0; s < segments_.size(); ++s)
    for_cells_of(segments_[s], [&](std::size_t cell) { cells_[end[cell]++] = s; });
}

NearestSegment::Cell NearestSegment::cell_of(const Vec2& point) const {
  const auto clamped = [this](double offset, long count) {
    return static_cast<long>(std::clamp(offset / side_, 0.0, static_cast<double>(count - 1)));
  };
  return {clamped(point.x() - low_.x(), columns_), clamped(point.y() - low_.y(), rows_)};
}

void NearestSegment::search_cell(Nearest& nearest, long column, long row, const Vec2& point) const {
  if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return;
  const std::size_t cell = index_of(column, row);
  for (std::uint32_t k = first_[cell]; k < first_[cell + 1]; ++k) {
    const std::uint32_t s = cells_[k];
    const double distance = distance_to_segment(point, segments_[s].first, segments_[s].second);
    if (distance < nearest.distance) nearest = {distance, s};
  }
}

// Searches rings of cells outward from the point's cell. A segment beyond ring k is at least k cells away from that
// cell's border.
NearestSegment::Nearest NearestSegment::nearest(const Vec2& point) const {
  Nearest nearest{std::numeric_limits<double>::infinity(), 0};
  if (segments_.empty()) return nearest;
  const auto [column, row] = cell_of(point);
  for (long k = 0; k <= std::max(columns_, rows_) && (k == 0 || nearest.distance > static_cast<double>(k - 1) * side_);
       ++k) {
    for (long i = -k; i <= k; ++i) {
      search_cell(nearest, column + i, row - k, point);
      if (k > 0) search_cell(nearest, column + i, row + k, point);
      if (std::abs(i) == k) continue;
      search_cell(nearest, column - k, row + i, point);
      search_cell(nearest, column + k, row + i, point);
    }
  }
  return nearest;
}

bool NearestSegment::is_clear(const Vec2& from, const Vec2& to) const {
  if (segments_.empty()) return true;
  // Cells are computed with rounding. The margin includes the next cell if the line runs along a border.
  const Vec2 margin = Vec2::Constant(1e-6 * side_);
  const Cell low = cell_of(from.cwiseMin(to) - margin), high = cell_of(from.cwiseMax(to) + margin);
  for (long row = low.row; row <= high.row; ++row) {
    for (long column = low.column; column <= high.column; ++column) {
      const std::size_t cell = index_of(column, row);
      for (std::uint32_t k = first_[cell]; k < first_[cell + 1]; ++k) {
        const auto& [a, b] = segments_[cells_[k]];
        if (!on_one_side(from, to, a, b) && !on_one_side(a, b, from, to)) return false;
      }
    }
  }
  return true;
}

}  // namespace fusee::solid
