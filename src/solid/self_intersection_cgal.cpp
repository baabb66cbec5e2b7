#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "fusee/base/units.h"
#include "solid/self_intersection.h"

namespace fusee {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t, CGAL::Box_intersection_d::ID_EXPLICIT>;
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

class CrossingTest {
 public:
  explicit CrossingTest(const TriangleMesh& mesh) : mesh_(mesh) {}

  bool operator()(std::size_t f, std::size_t g) const {
    Triangle a = mesh_.triangles[f], b = mesh_.triangles[g];
    const int shared = put_shared_first(a, b);
    if (shared == 3) return false;
    if (shared == 0 && clearly_apart(a, b)) return false;
    const std::array<Point, 3> p{point(mesh_, a[0]), point(mesh_, a[1]), point(mesh_, a[2])};
    const std::array<Point, 3> q{point(mesh_, b[0]), point(mesh_, b[1]), point(mesh_, b[2])};
    if (shared == 2) return folded_flat(p, q);
    const Kernel::Triangle_3 first(p[0], p[1], p[2]), second(q[0], q[1], q[2]);
    if (shared == 0) return CGAL::do_intersect(first, second);
    return CGAL::do_intersect(first, Kernel::Segment_3(q[1], q[2])) ||
           CGAL::do_intersect(second, Kernel::Segment_3(p[1], p[2]));
  }

 private:
  // Facets that share an edge overlap only when both lie on one side of it in one plane.
  static bool folded_flat(const std::array<Point, 3>& p, const std::array<Point, 3>& q) {
    return CGAL::coplanar(p[0], p[1], p[2], q[2]) &&
           CGAL::coplanar_orientation(p[0], p[1], p[2], q[2]) == CGAL::POSITIVE;
  }

  // Long thin facets side by side have overlapping boxes, thousands of them in a fine part. A plane through an edge,
  // upright on the facet, tells most of them apart in plain arithmetic; the margin is far above its rounding.
  bool clearly_apart(const Triangle& a, const Triangle& b) const {
    return separated_by_edges(a, b) || separated_by_edges(b, a);
  }

  bool separated_by_edges(const Triangle& a, const Triangle& b) const {
    const Vec3 &p0 = mesh_.vertices[a[0]], &p1 = mesh_.vertices[a[1]], &p2 = mesh_.vertices[a[2]];
    const Vec3 normal = (p1 - p0).cross(p2 - p0);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& from = mesh_.vertices[a[k]];
      const Vec3 outward = (mesh_.vertices[a[(k + 1) % 3]] - from).cross(normal);
      double nearest = std::numeric_limits<double>::infinity(), reach = 0;
      for (const std::uint32_t index : b) {
        const Vec3 offset = mesh_.vertices[index] - from;
        nearest = std::min(nearest, outward.dot(offset));
        reach = std::max(reach, offset.cwiseAbs().maxCoeff());
      }
      if (nearest > 1e-9 * outward.cwiseAbs().maxCoeff() * reach && nearest > 0) return true;
    }
    return false;
  }

  const TriangleMesh& mesh_;
};

using Extent = std::array<double, 3>;

/// What a facet takes up in some coordinates: facets whose boxes are apart in one of them do not meet.
struct FacetBox {
  Extent low, high;

  double area() const { return (high[0] - low[0]) * (high[1] - low[1]); }
};

FacetBox cartesian_box(const std::array<Vec3, 3>& corners) {
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
FacetBox polar_box(const std::array<Vec3, 3>& corners) {
  constexpr double margin = 1e-9;
  FacetBox box = cartesian_box(corners);
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

/// In the coordinates in which the facets crowd each other less.
std::vector<Box> boxes_of(const TriangleMesh& mesh) {
  std::vector<std::size_t> facets;
  std::vector<FacetBox> cartesian, polar;
  double cartesian_crowd = 0, polar_crowd = 0, reach = 0;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    if (is_degenerate(mesh, f)) continue;
    const auto& [a, b, c] = mesh.triangles[f];
    const std::array<Vec3, 3> corners{mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
    facets.push_back(f);
    cartesian.push_back(cartesian_box(corners));
    polar.push_back(polar_box(corners));
    cartesian_crowd += cartesian.back().area();
    polar_crowd += polar.back().area();
    reach = std::max(reach, polar.back().high[1]);
  }
  // Shares of a square about the disc that the mesh fills, and of that disc unrolled.
  const bool unrolled = polar_crowd / (k_two_pi * reach) < cartesian_crowd / (4.0 * reach * reach);
  std::vector<Box> boxes;
  boxes.reserve(facets.size());
  for (std::size_t i = 0; i < facets.size(); ++i) {
    FacetBox& box = unrolled ? polar[i] : cartesian[i];
    boxes.emplace_back(box.low.data(), box.high.data(), facets[i]);
  }
  return boxes;
}

struct Found {
  std::pair<std::size_t, std::size_t> facets;
};
struct TooMany {};

}  // namespace

bool is_degenerate(const TriangleMesh& mesh, std::size_t facet) {
  const auto& [a, b, c] = mesh.triangles[facet];
  return a == b || b == c || c == a || CGAL::collinear(point(mesh, a), point(mesh, b), point(mesh, c));
}

// The search is left by exceptions: CGAL's box intersection has no other early end.
CrossingSearch find_crossing(const TriangleMesh& welded) {
  std::vector<Box> boxes = boxes_of(welded);
  std::vector<const Box*> pointers;
  pointers.reserve(boxes.size());
  for (const Box& box : boxes) pointers.push_back(&box);
  const CrossingTest cross(welded);
  // A part whose facets all lie in one heap would take hours; no real one comes near this.
  std::size_t pairs_left = 100'000'000 + 2000 * boxes.size();
  const auto look = [&](const Box* a, const Box* b) {
    if (pairs_left-- == 0) throw TooMany{};
    if (cross(a->info(), b->info())) throw Found{std::minmax(a->info(), b->info())};
  };
  try {
    CGAL::box_self_intersection_d(pointers.begin(), pointers.end(), look, std::ptrdiff_t{500});
  } catch (const Found& found) {
    return {found.facets, false};
  } catch (const TooMany&) {
    return {std::nullopt, true};
  }
  return {};
}

}  // namespace fusee
