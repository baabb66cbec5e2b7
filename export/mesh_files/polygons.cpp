#include "export/mesh_files/polygons.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace fusee::formats {
namespace {

using Facet = std::array<std::uint32_t, 3>;

/// Bound on comparisons of an ear with a vertex, for all polygons of a file.
constexpr std::uint64_t k_most_comparisons = 100'000'000;
/// Height of a facet, relative to its longest edge, below which its corners lie on a line.
constexpr double k_on_a_line = 1e-7;

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Twice the area of a triangle, positive if its corners are counterclockwise.
double doubled_area(const Vec2& a, const Vec2& b, const Vec2& c) { return cross(b - a, c - a); }

bool is_counterclockwise(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return doubled_area(a, b, c) > k_on_a_line * longest;
}

/// One polygon in the coordinate plane in which its projection is largest, counterclockwise.
class FlatPolygon {
 public:
  FlatPolygon(const solid::TriangleMesh& mesh, std::vector<std::uint32_t> corners) : corners_(std::move(corners)) {
    // The vector area of the polygon (Newell's method).
    Vec3 normal = Vec3::Zero();
    const Vec3& origin = mesh.vertices[corners_.front()];
    for (std::size_t i = 0; i < corners_.size(); ++i)
      normal += (mesh.vertices[corners_[i]] - origin).cross(mesh.vertices[corners_[next(i)]] - origin);
    Eigen::Index axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    has_area_ = std::isfinite(normal.sum()) && normal[axis] != 0;
    const Eigen::Index x = (axis + 1) % 3, y = (axis + 2) % 3;
    const double mirror = normal[axis] < 0 ? -1 : 1;
    for (const std::uint32_t corner : corners_)
      points_.emplace_back(mesh.vertices[corner][x], mirror * mesh.vertices[corner][y]);
  }

  /// True if the fan about the first corner has facets of the polygon's direction only.
  bool is_covered_by_fan() const {
    for (std::size_t k = 2; k < points_.size(); ++k) {
      if (!is_counterclockwise(points_[0], points_[k - 1], points_[k])) return false;
    }
    return true;
  }

  /// Facets by clipping ears; empty if there are not enough ears, or `comparisons` are exhausted.
  std::vector<Facet> ears(std::uint64_t& comparisons) {
    std::vector<Facet> facets;
    if (!has_area_) return facets;
    unclipped_.resize(points_.size());
    for (std::size_t i = 0; i < unclipped_.size(); ++i) unclipped_[i] = i;
    std::size_t tip = 0, tried = 0;  // `tip`: index in unclipped_; `tried`: corners in succession that are no ears
    while (unclipped_.size() > 3) {
      if (tried++ == unclipped_.size()) return {};
      tip = tip >= unclipped_.size() ? 0 : tip;
      const std::size_t before = unclipped_[(tip + unclipped_.size() - 1) % unclipped_.size()],
                        after = unclipped_[(tip + 1) % unclipped_.size()];
      if (comparisons < unclipped_.size()) return {};
      comparisons -= unclipped_.size();
      if (!is_ear(before, unclipped_[tip], after)) {
        ++tip;
        continue;
      }
      facets.push_back({corners_[before], corners_[unclipped_[tip]], corners_[after]});
      unclipped_.erase(unclipped_.begin() + static_cast<std::ptrdiff_t>(tip));
      tried = 0;
      ++tip;  // the next ear is sought further on, because facets about one corner would be long and narrow
    }
    facets.push_back({corners_[unclipped_[0]], corners_[unclipped_[1]], corners_[unclipped_[2]]});
    return facets;
  }

 private:
  std::size_t next(std::size_t i) const { return i + 1 < corners_.size() ? i + 1 : 0; }

  /// True if the facet is counterclockwise and no other corner lies in it or on its edges. A corner of a bridge to a
  /// hole coincides with another one.
  bool is_ear(std::size_t before, std::size_t tip, std::size_t after) const {
    const Vec2 &a = points_[before], &b = points_[tip], &c = points_[after];
    if (!is_counterclockwise(a, b, c)) return false;
    return std::none_of(unclipped_.begin(), unclipped_.end(), [&](std::size_t other) {
      const Vec2& p = points_[other];
      if (p == a || p == b || p == c) return false;
      return doubled_area(a, b, p) >= 0 && doubled_area(b, c, p) >= 0 && doubled_area(c, a, p) >= 0;
    });
  }

  std::vector<std::uint32_t> corners_;
  std::vector<Vec2> points_;
  std::vector<std::size_t> unclipped_;  ///< corners not clipped yet
  bool has_area_ = false;
};

}  // namespace

std::optional<std::string> PolygonSplitter::add(std::span<const std::uint32_t> corners) {
  constexpr std::size_t k_always_allowed = 100'000, k_bytes_per_facet = 6;
  if (corners.empty()) return {};
  const std::uint64_t vertices = std::uint64_t{*std::max_element(corners.begin(), corners.end())} + 1;
  if (corners.size() > 2 * vertices) return "a face that has a vertex at most twice";
  const std::size_t most = k_always_allowed + source_.bytes.size() / k_bytes_per_facet;
  if (mesh_.triangles.size() + corners.size() > most + 2)
    return fmt::format("no more than {} facets in a file of {} bytes", most, source_.bytes.size());
  if (corners.size() > 3) fans_.push_back({mesh_.triangles.size(), corners.size() - 2});
  for (std::size_t k = 2; k < corners.size(); ++k) mesh_.triangles.push_back({corners[0], corners[k - 1], corners[k]});
  return {};
}

void PolygonSplitter::split_concave() {
  std::uint64_t comparisons = k_most_comparisons;
  for (const Fan& fan : fans_) {
    const auto first = mesh_.triangles.begin() + static_cast<std::ptrdiff_t>(fan.first);
    std::vector<std::uint32_t> corners = {(*first)[0], (*first)[1]};
    for (std::size_t k = 0; k < fan.facets; ++k) corners.push_back(first[static_cast<std::ptrdiff_t>(k)][2]);
    FlatPolygon polygon(mesh_, std::move(corners));
    if (polygon.is_covered_by_fan()) continue;
    const std::vector<Facet> facets = polygon.ears(comparisons);
    std::copy(facets.begin(), facets.end(), first);
  }
}

}  // namespace fusee::formats
