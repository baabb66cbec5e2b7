#include "solid/downward_faces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace fusee::solid {
namespace {

// Margin for the rounding of sections and normals, in mm and relative. Much larger than that rounding, much smaller
// than any feature.
constexpr double k_rounding_margin = 1e-6;
// Relative margin on the steepness. Slivers have no slope of their own, so a path down across them may be longer by
// this fraction. A sliver is at most a quarter of this fraction of the reach wide.
constexpr double k_steepness_margin = 1e-2;
constexpr double k_narrow_sliver = 0.25 * k_steepness_margin;

// Vertical facets count too.
bool looks_down(const Vec3& normal) { return normal.z() < k_rounding_margin * normal.norm(); }

// The tangent of a plane's slope is |horizontal part of its normal| / |vertical part|.
bool is_flat(const Vec3& normal, double steepness) {
  return normal.head<2>().norm() <= steepness * (1 + k_steepness_margin) * std::abs(normal.z());
}

// The tangent of a line's slope is |height difference| / horizontal length.
bool is_flat_line(const Vec3& along, double steepness) {
  return std::abs(along.z()) <= steepness * (1 + k_steepness_margin) * along.head<2>().norm();
}

// True if a facet rises from its side `along` towards its third corner: the corner is higher than its foot on the
// side's line.
bool rises_from(const Vec3& along, const Vec3& to_corner) {
  // Height above the foot, times |along|².
  const double scaled_height = to_corner.z() * along.squaredNorm() - to_corner.dot(along) * along.z();
  return scaled_height >= -k_rounding_margin * to_corner.norm() * along.squaredNorm();
}

// A flat side of a facet that rises from it. Where two such facets meet, the side is a ridge that points down.
struct RisingSide {
  std::uint32_t low, high;  // vertices
  bool looks_down;
};

bool before(const RisingSide& a, const RisingSide& b) { return std::pair(a.low, a.high) < std::pair(b.low, b.high); }

class DownwardFaceFinder {
 public:
  DownwardFaceFinder(const TriangleMesh& mesh, const std::vector<double>& heights, double steepness)
      : mesh_(mesh), heights_(heights), steepness_(steepness) {
    // Horizontal length of a path that descends by one layer at the steepness.
    const double reach = heights.size() < 2 ? 0.0 : (heights[1] - heights[0]) / steepness;
    narrow_ = k_narrow_sliver * reach;
    places_.assign(heights.size(), PlacesInPlan(bounds(mesh), reach + k_rounding_margin));
  }

  std::vector<PlacesInPlan> places() && {
    add_faces();
    add_slivers();
    add_ridges();
    add_lowest_points();
    return std::move(places_);
  }

 private:
  const Vec3& corner(const std::array<std::uint32_t, 3>& triangle, std::size_t k) const {
    return mesh_.vertices[triangle[k % 3]];
  }

  void add_faces() {
    has_lower_neighbour_.assign(mesh_.vertices.size(), false);
    is_under_.assign(mesh_.vertices.size(), false);
    for (const auto& triangle : mesh_.triangles) {
      const Vec3 &a = corner(triangle, 0), &b = corner(triangle, 1), &c = corner(triangle, 2);
      const Vec3 normal = (b - a).cross(c - a);
      const bool down = looks_down(normal);
      if (down && is_flat(normal, steepness_)) {
        const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
        if (normal.norm() > narrow_ * longest)
          add_facet(triangle);
        else
          slivers_.push_back(triangle);
      }
      record_sides(triangle, down);
    }
  }

  // Two adjacent slivers count as flat, because their combined width is unknown.
  void add_slivers() {
    std::vector<std::pair<std::uint64_t, std::size_t>> sides;
    for (std::size_t s = 0; s < slivers_.size(); ++s) {
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax(slivers_[s][k], slivers_[s][(k + 1) % 3]);
        sides.emplace_back((std::uint64_t{low} << 32) | high, s);
      }
    }
    std::sort(sides.begin(), sides.end());
    for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
      if (sides[i].first != sides[i + 1].first) continue;
      add_facet(slivers_[sides[i].second]);
      add_facet(slivers_[sides[i + 1].second]);
    }
  }

  void add_facet(const std::array<std::uint32_t, 3>& triangle) {
    const Vec3 &a = corner(triangle, 0), &b = corner(triangle, 1), &c = corner(triangle, 2);
    add(a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c));
  }

  void record_sides(const std::array<std::uint32_t, 3>& triangle, bool down) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = triangle[k], to = triangle[(k + 1) % 3];
      const Vec3 along = corner(triangle, k + 1) - corner(triangle, k);
      if (along.z() < 0) has_lower_neighbour_[from] = true;
      if (along.z() > 0) has_lower_neighbour_[to] = true;
      if (down) is_under_[from] = true;
      if (is_flat_line(along, steepness_) && rises_from(along, corner(triangle, k + 2) - corner(triangle, k)))
        sides_.push_back({std::min(from, to), std::max(from, to), down});
    }
  }

  void add_ridges() {
    std::sort(sides_.begin(), sides_.end(), before);
    for (auto first = sides_.begin(); first != sides_.end();) {
      const auto end = std::upper_bound(first, sides_.end(), *first, before);
      const bool is_under = std::any_of(first, end, [](const RisingSide& side) { return side.looks_down; });
      const Vec3 &a = mesh_.vertices[first->low], &b = mesh_.vertices[first->high];
      if (is_under && end - first > 1) add(a.cwiseMin(b), a.cwiseMax(b));
      first = end;
    }
  }

  void add_lowest_points() {
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
      if (is_under_[v] && !has_lower_neighbour_[v]) add(mesh_.vertices[v], mesh_.vertices[v]);
    }
  }

  // Adds a box between two corners to each layer that it meets. Layer k lies between the heights k − 1 and k.
  void add(const Vec3& low, const Vec3& high) {
    const auto first =
        std::lower_bound(heights_.begin(), heights_.end(), low.z() - k_rounding_margin) - heights_.begin();
    for (auto k = static_cast<std::size_t>(std::max<std::ptrdiff_t>(first, 1));
         k < heights_.size() && heights_[k - 1] <= high.z() + k_rounding_margin; ++k)
      places_[k].add(low.head<2>(), high.head<2>());
  }

  const TriangleMesh& mesh_;
  const std::vector<double>& heights_;
  double steepness_;
  double narrow_ = 0;  ///< height of a facet above its longest side, up to which it is a sliver
  std::vector<PlacesInPlan> places_;
  std::vector<std::array<std::uint32_t, 3>> slivers_;  ///< slivers that face down and are flat
  std::vector<RisingSide> sides_;
  // For each vertex: whether a neighbour lies lower, and whether a facet at it looks down.
  std::vector<bool> has_lower_neighbour_, is_under_;
};

}  // namespace

PlacesInPlan::PlacesInPlan(const Bounds& part, double reach) : low_(part.low.head<2>()), reach_(reach) {
  const Vec2 size = (part.high - part.low).head<2>();
  per_cell_ = k_cells * size.cwiseMax(k_rounding_margin).cwiseInverse();
}

int PlacesInPlan::cell(double at, int axis) const {
  return static_cast<int>(std::clamp((at - low_[axis]) * per_cell_[axis], 0.0, k_cells - 1.0));
}

// The bits of all columns between two x coordinates.
std::uint64_t PlacesInPlan::columns(double from, double to) const {
  const std::uint64_t all = ~std::uint64_t{0};
  return (all << cell(from, 0)) & (all >> (k_cells - 1 - cell(to, 0)));
}

void PlacesInPlan::add(const Vec2& low, const Vec2& high) {
  const std::uint64_t mask = columns(low.x() - reach_, high.x() + reach_);
  const int last = cell(high.y() + reach_, 1);
  for (int row = cell(low.y() - reach_, 1); row <= last; ++row) rows_[static_cast<std::size_t>(row)] |= mask;
  none_ = false;
}

bool PlacesInPlan::may_meet(const Vec2& from, const Vec2& to) const {
  const std::uint64_t mask = columns(std::min(from.x(), to.x()), std::max(from.x(), to.x()));
  const int last = cell(std::max(from.y(), to.y()), 1);
  for (int row = cell(std::min(from.y(), to.y()), 1); row <= last; ++row) {
    if (rows_[static_cast<std::size_t>(row)] & mask) return true;
  }
  return false;
}

std::vector<PlacesInPlan> flat_downward_faces(const TriangleMesh& welded, const std::vector<double>& heights,
                                              double steepness) {
  return DownwardFaceFinder(welded, heights, steepness).places();
}

}  // namespace fusee::solid
