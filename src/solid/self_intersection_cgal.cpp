#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "fusee/base/units.h"
#include "solid/box_tree.h"
#include "solid/self_intersection.h"

namespace fusee {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangle = std::array<std::uint32_t, 3>;

Point point(const TriangleMesh& mesh, std::uint32_t index) {
  const Vec3& vertex = mesh.vertices[index];
  return {vertex.x(), vertex.y(), vertex.z()};
}

// Shared corners of two triangles come first in both.
int put_shared_first(Triangle& a, Triangle& b) {
  int shared = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = shared; j < 3; ++j) {
      if (a[i] != b[j]) continue;
      std::swap(a[i], a[shared]);
      std::swap(b[j], b[shared]);
      ++shared;
      break;
    }
  }
  return shared;
}

// A facet's plane, and planes through its edges upright on it: most pairs are told apart by one of them in plain
// arithmetic, whose margin is far above its rounding.
class FacetPlanes {
 public:
  FacetPlanes(const TriangleMesh& mesh, const Triangle& facet)
      : corners_{mesh.vertices[facet[0]], mesh.vertices[facet[1]], mesh.vertices[facet[2]]} {
    const Vec3 along = corners_[1] - corners_[0], across = corners_[2] - corners_[0];
    normal_ = along.cross(across);
    reach_ = along.cwiseAbs().maxCoeff() * across.cwiseAbs().maxCoeff();
  }

  const Vec3& corner(std::size_t k) const { return corners_[k]; }

  // +1, −1: surely on that side of the plane; 0: who knows.
  int side_of(const Vec3& point) const {
    const Vec3 offset = point - corners_[0];
    const double height = normal_.dot(offset);
    const double margin = k_margin * reach_ * offset.cwiseAbs().maxCoeff();
    return height > margin ? 1 : height < -margin ? -1 : 0;
  }

  // Surely beyond the edge from corner k to the next.
  bool is_beyond(std::size_t k, const Vec3& point) const {
    const Vec3 outward = (corners_[(k + 1) % 3] - corners_[k]).cross(normal_);
    const Vec3 offset = point - corners_[k];
    return outward.dot(offset) > k_edge_margin * outward.cwiseAbs().maxCoeff() * offset.cwiseAbs().maxCoeff();
  }

 private:
  // The products' rounding is less than a hundredth of these.
  static constexpr double k_margin = 1e-13, k_edge_margin = 1e-9;

  std::array<Vec3, 3> corners_;
  Vec3 normal_;
  double reach_ = 0;
};

class CrossingTest {
 public:
  explicit CrossingTest(const TriangleMesh& mesh) : mesh_(mesh) {}

  bool operator()(std::size_t f, std::size_t g) const {
    Triangle a = mesh_.triangles[f], b = mesh_.triangles[g];
    const int shared = put_shared_first(a, b);
    if (shared == 3) return false;
    const FacetPlanes first(mesh_, a);
    if (shared == 2) return !clearly_unfolded(first, mesh_.vertices[b[2]]) && folded_flat(points(a), points(b));
    const FacetPlanes second(mesh_, b);
    if (clearly_apart(first, second, shared) || clearly_apart(second, first, shared)) return false;
    const std::array<Point, 3> p = points(a), q = points(b);
    const Kernel::Triangle_3 one(p[0], p[1], p[2]), other(q[0], q[1], q[2]);
    if (shared == 0) return CGAL::do_intersect(one, other);
    return CGAL::do_intersect(one, Kernel::Segment_3(q[1], q[2])) ||
           CGAL::do_intersect(other, Kernel::Segment_3(p[1], p[2]));
  }

 private:
  std::array<Point, 3> points(const Triangle& facet) const {
    return {point(mesh_, facet[0]), point(mesh_, facet[1]), point(mesh_, facet[2])};
  }

  // Facets that share an edge overlap only when both lie on one side of it in one plane.
  static bool folded_flat(const std::array<Point, 3>& p, const std::array<Point, 3>& q) {
    return CGAL::coplanar(p[0], p[1], p[2], q[2]) &&
           CGAL::coplanar_orientation(p[0], p[1], p[2], q[2]) == CGAL::POSITIVE;
  }
  static bool clearly_unfolded(const FacetPlanes& a, const Vec3& beside) {
    return a.side_of(beside) != 0 || a.is_beyond(0, beside);
  }

  // b's corners, but for a shared one, lie on one side of a's plane, or beyond one of a's edges; where a corner is
  // shared, of an edge at that corner. Long thin facets side by side have overlapping boxes, thousands of them in a
  // fine part.
  static bool clearly_apart(const FacetPlanes& a, const FacetPlanes& b, int shared) {
    const auto all_of_b = [&](const auto& holds) {
      for (auto k = static_cast<std::size_t>(shared); k < 3; ++k) {
        if (!holds(b.corner(k))) return false;
      }
      return true;
    };
    const int side = a.side_of(b.corner(2));
    if (side != 0 && all_of_b([&](const Vec3& corner) { return a.side_of(corner) == side; })) return true;
    for (const std::size_t edge : {std::size_t{0}, std::size_t{2}, std::size_t{1}}) {
      if (edge == 1 && shared == 1) continue;
      if (all_of_b([&](const Vec3& corner) { return a.is_beyond(edge, corner); })) return true;
    }
    return false;
  }

  const TriangleMesh& mesh_;
};

// How much room a box takes of the first two coordinates.
double area_of(const Box3& box) { return (box.high[0] - box.low[0]) * (box.high[1] - box.low[1]); }

Box3 cartesian_box(const std::array<Vec3, 3>& corners) {
  const Vec3 low = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]);
  const Vec3 high = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]);
  return {{low.x(), low.y(), low.z()}, {high.x(), high.y(), high.z()}};
}

double distance_from_axis(const Vec3& a, const Vec3& b) {
  const Vec2 from = a.head<2>(), along = b.head<2>() - from;
  const double length = along.squaredNorm();
  const double place = length > 0 ? std::clamp(-from.dot(along) / length, 0.0, 1.0) : 0.0;
  return (from + place * along).norm();
}

/// Angle about the z axis, distance from it, height: the strips of a fine turned part consist of needles that point at the axis, whose
/// boxes in x and y overlap by the thousand. The margins are far above the rounding.
Box3 polar_box(const std::array<Vec3, 3>& corners) {
  constexpr double margin = 1e-9;
  Box3 box = cartesian_box(corners);
  const double start = std::atan2(corners[0].y(), corners[0].x());
  double before = 0, after = 0, farthest = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const double turn = std::remainder(std::atan2(corners[k].y(), corners[k].x()) - start, k_two_pi);
    before = std::min(before, turn);
    after = std::max(after, turn);
    nearest = std::min(nearest, distance_from_axis(corners[k], corners[(k + 1) % 3]));
    farthest = std::max(farthest, corners[k].head<2>().norm());
  }
  const bool round_axis = after - before > k_pi - margin;
  const bool over_cut = start + before < -k_pi || start + after > k_pi;
  box.low[0] = round_axis || over_cut ? -4.0 : start + before - margin;
  box.high[0] = round_axis || over_cut ? 4.0 : start + after + margin;
  box.low[1] = round_axis ? 0.0 : nearest * (1.0 - margin);
  box.high[1] = farthest * (1.0 + margin);
  return box;
}

/// What facets take up: those whose boxes are apart do not meet.
struct FacetBoxes {
  std::vector<std::size_t> facets;  ///< that have an area
  std::vector<Box3> boxes;
};

/// In the coordinates in which the facets crowd each other less.
FacetBoxes boxes_of(const TriangleMesh& mesh) {
  std::vector<std::size_t> facets;
  std::vector<Box3> cartesian, polar;
  double cartesian_crowd = 0, polar_crowd = 0, reach = 0;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    if (is_degenerate(mesh, f)) continue;
    const auto& [a, b, c] = mesh.triangles[f];
    const std::array<Vec3, 3> corners{mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
    facets.push_back(f);
    cartesian.push_back(cartesian_box(corners));
    polar.push_back(polar_box(corners));
    cartesian_crowd += area_of(cartesian.back());
    polar_crowd += area_of(polar.back());
    reach = std::max(reach, polar.back().high[1]);
  }
  // Shares of a square about the disc that the mesh fills, and of that disc unrolled.
  const bool unrolled = polar_crowd / (k_two_pi * reach) < cartesian_crowd / (4.0 * reach * reach);
  return {std::move(facets), unrolled ? std::move(polar) : std::move(cartesian)};
}

}  // namespace

bool is_degenerate(const TriangleMesh& mesh, std::size_t facet) {
  const auto& [a, b, c] = mesh.triangles[facet];
  return a == b || b == c || c == a || CGAL::collinear(point(mesh, a), point(mesh, b), point(mesh, c));
}

CrossingSearch find_crossing(const TriangleMesh& welded) {
  const FacetBoxes facets = boxes_of(welded);
  const CrossingTest cross(welded);
  // A part whose facets all lie in one heap would take hours; no real one comes near this.
  std::size_t pairs_left = 100'000'000 + 2000 * facets.boxes.size();
  CrossingSearch search;
  BoxTree(facets.boxes).any_pair([&](std::size_t i, std::size_t j) {
    search.gave_up = pairs_left-- == 0;
    if (search.gave_up) return true;
    const std::size_t f = facets.facets[i], g = facets.facets[j];
    if (cross(f, g)) search.facets = std::minmax(f, g);
    return search.facets.has_value();
  });
  return search;
}

}  // namespace fusee
