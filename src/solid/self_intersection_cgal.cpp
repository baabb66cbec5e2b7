#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <vector>

#include "base/thread_pool.h"
#include "fusee/base.h"
#include "solid/box_tree.h"
#include "solid/self_intersection.h"

namespace fusee::solid {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangle = std::array<std::uint32_t, 3>;

Point point(const TriangleMesh& mesh, std::uint32_t index) {
  const Vec3& vertex = mesh.vertices[index];
  return {vertex.x(), vertex.y(), vertex.z()};
}

// The corners of two facets that are the same vertex.
struct SharedCorners {
  int count = 0;
  std::array<bool, 3> of_first{}, of_second{};
};

// Requires facets with an area and three distinct corners. Written without branches, because they would be
// unpredictable.
SharedCorners shared_corners(const Triangle& a, const Triangle& b) {
  SharedCorners shared;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const bool is_shared = a[i] == b[j];
      shared.of_first[i] |= is_shared;
      shared.of_second[j] |= is_shared;
      shared.count += is_shared;
    }
  }
  return shared;
}

constexpr std::size_t after(std::size_t corner) { return corner == 2 ? 0 : corner + 1; }

// A facet's plane, and the planes through its edges perpendicular to it. One of them separates most pairs in plain
// floating-point arithmetic, with a margin far above its rounding.
class FacetPlanes {
 public:
  // `extent`: largest extent of the queried points along any axis.
  FacetPlanes(const std::array<Vec3, 3>& corners, double extent) : corners_(corners), extent_(extent) {
    const Vec3 along = corners_[1] - corners_[0], across = corners_[2] - corners_[0];
    normal_ = along.cross(across);
    normal_scale_ = along.cwiseAbs().maxCoeff() * across.cwiseAbs().maxCoeff();
    margin_ = k_margin * normal_scale_ * extent;
  }

  const Vec3& corner(std::size_t k) const { return corners_[k]; }

  // True if the three corners are certainly not collinear.
  bool has_area() const { return normal_.cwiseAbs().maxCoeff() > k_margin * normal_scale_; }

  // +1 or −1: certainly on that side of the plane; 0: undecided.
  int side_of(const Vec3& point) const {
    const double height = normal_.dot(point - corners_[0]);
    if (height > margin_) return 1;
    return height < -margin_ ? -1 : 0;
  }

  // True if all other corners of the other facet are certainly beyond the edge from corner k to the next.
  bool are_beyond(std::size_t k, const FacetPlanes& other, const std::array<bool, 3>& left_out) const {
    const Vec3 outward = (corners_[after(k)] - corners_[k]).cross(normal_);
    const double margin = k_edge_margin * extent_ * outward.cwiseAbs().maxCoeff();
    for (std::size_t j = 0; j < 3; ++j) {
      if (!left_out[j] && !(outward.dot(other.corners_[j] - corners_[k]) > margin)) return false;
    }
    return true;
  }

 private:
  // Relative margins. The rounding of the products is less than a hundredth of these.
  static constexpr double k_margin = 1e-13, k_edge_margin = 1e-9;

  std::array<Vec3, 3> corners_;
  Vec3 normal_;
  double extent_ = 0;
  double normal_scale_ = 0;  ///< size of the products that the normal is computed from
  double margin_ = 0;        ///< of a point's distance from the plane, times the normal's length
};

// Exact test, used when plain arithmetic has not separated two facets.
class CrossingTest {
 public:
  CrossingTest(const TriangleMesh& mesh, const std::vector<std::size_t>& facets, const std::vector<FacetPlanes>& planes)
      : mesh_(mesh), facets_(facets), planes_(planes) {}

  /// Takes indices in the list of facets.
  bool operator()(std::size_t i, std::size_t j) const {
    const Triangle &a = mesh_.triangles[facets_[i]], &b = mesh_.triangles[facets_[j]];
    const SharedCorners shared = shared_corners(a, b);
    if (shared.count == 3) return false;
    const FacetPlanes &first = planes_[i], &second = planes_[j];
    if (shared.count == 2) {
      return !clearly_unfolded(first, shared.of_first, second, shared.of_second) &&
             folded_flat(with_last(a, shared.of_first), with_last(b, shared.of_second));
    }
    if (on_one_side(first, second, shared.of_second) || on_one_side(second, first, shared.of_first)) return false;
    if (beyond_an_edge(first, shared.of_first, second, shared.of_second) ||
        beyond_an_edge(second, shared.of_second, first, shared.of_first))
      return false;
    const std::array<Point, 3> p = with_first(a, shared.of_first), q = with_first(b, shared.of_second);
    const Kernel::Triangle_3 one(p[0], p[1], p[2]), other(q[0], q[1], q[2]);
    if (shared.count == 0) return CGAL::do_intersect(one, other);
    return CGAL::do_intersect(one, Kernel::Segment_3(q[1], q[2])) ||
           CGAL::do_intersect(other, Kernel::Segment_3(p[1], p[2]));
  }

 private:
  std::array<Point, 3> from_corner(const Triangle& facet, std::size_t k) const {
    return {point(mesh_, facet[k]), point(mesh_, facet[after(k)]), point(mesh_, facet[after(after(k))])};
  }
  // The facet's corners, with the one shared corner first if there is one.
  std::array<Point, 3> with_first(const Triangle& facet, const std::array<bool, 3>& shared) const {
    if (shared[1]) return from_corner(facet, 1);
    return from_corner(facet, shared[2] ? 2 : 0);
  }
  // The facet's corners, with the one unshared corner last and the shared ones in the order of their vertices.
  std::array<Point, 3> with_last(const Triangle& facet, const std::array<bool, 3>& shared) const {
    const std::size_t last = unshared(shared);
    const auto [low, high] = std::minmax(facet[after(last)], facet[after(after(last))]);
    return {point(mesh_, low), point(mesh_, high), point(mesh_, facet[last])};
  }
  // The one corner that is not shared.
  static std::size_t unshared(const std::array<bool, 3>& shared) {
    if (!shared[0]) return 0;
    return !shared[1] ? 1 : 2;
  }

  // Facets that share an edge overlap only if both lie on one side of it in one plane.
  static bool folded_flat(const std::array<Point, 3>& p, const std::array<Point, 3>& q) {
    return CGAL::coplanar(p[0], p[1], p[2], q[2]) &&
           CGAL::coplanar_orientation(p[0], p[1], p[2], q[2]) == CGAL::POSITIVE;
  }
  // True if facets that share an edge certainly do not overlap.
  static bool clearly_unfolded(const FacetPlanes& a, const std::array<bool, 3>& of_a, const FacetPlanes& b,
                               const std::array<bool, 3>& of_b) {
    const std::size_t unshared_a = unshared(of_a), unshared_b = unshared(of_b);
    return a.side_of(b.corner(unshared_b)) != 0 || a.are_beyond(after(unshared_a), b, of_b);
  }

  // True if b's unshared corners are certainly beyond one of a's edges; with a shared corner, beyond an edge at that
  // corner. Long thin adjacent facets have overlapping boxes, thousands of them in a fine part.
  static bool beyond_an_edge(const FacetPlanes& a, const std::array<bool, 3>& of_a, const FacetPlanes& b,
                             const std::array<bool, 3>& of_b) {
    const bool shares_none = !of_a[0] && !of_a[1] && !of_a[2];
    for (std::size_t k = 0; k < 3; ++k) {
      if ((shares_none || of_a[k] || of_a[after(k)]) && a.are_beyond(k, b, of_b)) return true;
    }
    return false;
  }
  // True if b's corners are certainly on one side of a's plane.
  static bool on_one_side(const FacetPlanes& a, const FacetPlanes& b, const std::array<bool, 3>& left_out) {
    int side = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      if (left_out[j]) continue;
      const int here = a.side_of(b.corner(j));
      if (here == 0 || here == -side) return false;
      side = here;
    }
    return true;
  }

  const TriangleMesh& mesh_;
  const std::vector<std::size_t>& facets_;
  const std::vector<FacetPlanes>& planes_;
};

// Area of a box in the first two coordinates.
double area_of(const Box3& box) { return (box.high[0] - box.low[0]) * (box.high[1] - box.low[1]); }

Box3 cartesian_box(const std::array<Vec3, 3>& corners) {
  const Vec3 low = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]);
  const Vec3 high = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]);
  return {{low.x(), low.y(), low.z()}, {high.x(), high.y(), high.z()}};
}

// Distance of the segment a b from the z axis.
double distance_from_axis(const Vec3& a, const Vec3& b) {
  const Vec2 from = a.head<2>(), along = b.head<2>() - from;
  const double length_squared = along.squaredNorm();
  const double share = length_squared > 0 ? std::clamp(-from.dot(along) / length_squared, 0.0, 1.0) : 0.0;
  return (from + share * along).norm();
}

/// A box in angle about the z axis, distance from it, and height. The strips of a fine turned part consist of needles
/// that point at the axis, whose boxes in x and y overlap by the thousand. The margins are far above the rounding.
Box3 polar_box(const std::array<Vec3, 3>& corners, const std::array<double, 3>& angles) {
  constexpr double margin = 1e-9;
  Box3 box = cartesian_box(corners);
  const double start = angles[0];
  double before_start = 0, after_start = 0, farthest_squared = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    double turn = angles[k] - start;  // reduced to a half turn to either side
    if (turn > k_pi) turn -= k_two_pi;
    if (turn < -k_pi) turn += k_two_pi;
    before_start = std::min(before_start, turn);
    after_start = std::max(after_start, turn);
    nearest = std::min(nearest, distance_from_axis(corners[k], corners[after(k)]));
    farthest_squared = std::max(farthest_squared, corners[k].head<2>().squaredNorm());
  }
  const bool surrounds_axis = after_start - before_start > k_pi - margin;
  const bool passes_half_turn = start + before_start < -k_pi || start + after_start > k_pi;
  constexpr double k_beyond_all_angles = 4.0;  // > π
  const bool spans_all_angles = surrounds_axis || passes_half_turn;
  box.low[0] = spans_all_angles ? -k_beyond_all_angles : start + before_start - margin;
  box.high[0] = spans_all_angles ? k_beyond_all_angles : start + after_start + margin;
  box.low[1] = surrounds_axis ? 0.0 : nearest * (1.0 - margin);
  box.high[1] = std::sqrt(farthest_squared) * (1.0 + margin);
  return box;
}

// With fewer facets the search ends before a thread would have started.
constexpr std::size_t k_worth_halving = 2000;

/// Bounding boxes of facets. Facets with disjoint boxes do not meet.
struct FacetBoxes {
  std::vector<std::size_t> facets;  ///< facets with an area
  std::vector<FacetPlanes> planes;
  std::vector<Box3> boxes;
};

/// Uses those coordinates, Cartesian or polar, in which the boxes overlap less.
FacetBoxes boxes_of(const TriangleMesh& mesh) {
  std::vector<double> angles;
  angles.reserve(mesh.vertices.size());
  for (const Vec3& vertex : mesh.vertices) angles.push_back(elementary::atan2(vertex.y(), vertex.x()));
  FacetBoxes result;
  std::vector<Box3> polar;
  result.facets.reserve(mesh.triangles.size());
  result.planes.reserve(mesh.triangles.size());
  result.boxes.reserve(mesh.triangles.size());
  polar.reserve(mesh.triangles.size());
  double cartesian_area = 0, polar_area = 0, reach = 0;
  const Bounds box = bounds(mesh);
  const double extent = (box.high - box.low).maxCoeff();
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const auto& [a, b, c] = mesh.triangles[f];
    const std::array<Vec3, 3> corners{mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
    const FacetPlanes planes(corners, extent);
    if (!planes.has_area() && is_degenerate(mesh, f)) continue;
    result.facets.push_back(f);
    result.planes.push_back(planes);
    result.boxes.push_back(cartesian_box(corners));
    polar.push_back(polar_box(corners, {angles[a], angles[b], angles[c]}));
    cartesian_area += area_of(result.boxes.back());
    polar_area += area_of(polar.back());
    reach = std::max(reach, polar.back().high[1]);
  }
  // Density of the boxes: their total area per area of the unrolled disc, and per area of the square around it.
  const double polar_density = polar_area / (k_two_pi * reach),
               cartesian_density = cartesian_area / (4.0 * reach * reach);
  if (polar_density < cartesian_density) result.boxes = std::move(polar);
  return result;
}

}  // namespace

bool is_degenerate(const TriangleMesh& mesh, std::size_t facet) {
  const auto& [a, b, c] = mesh.triangles[facet];
  return a == b || b == c || c == a || CGAL::collinear(point(mesh, a), point(mesh, b), point(mesh, c));
}

CrossingSearch find_crossing(const TriangleMesh& welded) {
  const FacetBoxes facets = boxes_of(welded);
  const CrossingTest cross(welded, facets.facets, facets.planes);
  const BoxTree tree(facets.boxes);
  std::atomic<bool> is_over = false;
  const auto search_in = [&](const auto& any_pair) {
    // Limit for parts with all facets in one place, which would take hours. Pulleys have up to 25 pairs per facet.
    std::size_t pairs_left = 50'000'000 + 50 * facets.boxes.size();
    CrossingSearch search;
    any_pair([&](std::size_t i, std::size_t j) {
      search.gave_up = pairs_left-- == 0;
      if (search.gave_up || is_over) return true;
      if (cross(i, j)) search.facets = std::minmax(facets.facets[i], facets.facets[j]);
      return search.facets.has_value();
    });
    return search;
  };
  auto in_rest =
      run_async([&] { return search_in([&](const auto& visit) { return tree.any_pair_in_second_half(visit); }); },
                facets.boxes.size() > k_worth_halving);
  const CrossingSearch first = search_in([&](const auto& visit) { return tree.any_pair_in_first_half(visit); });
  is_over = first.facets || first.gave_up;
  const CrossingSearch rest = in_rest.get();
  return first.facets || first.gave_up ? first : rest;
}

}  // namespace fusee::solid
