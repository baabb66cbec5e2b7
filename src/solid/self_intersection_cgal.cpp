#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <Eigen/Geometry>
#include <array>
#include <limits>
#include <vector>

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

std::vector<Box> boxes_of(const TriangleMesh& mesh) {
  std::vector<Box> boxes;
  boxes.reserve(mesh.triangles.size());
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    if (is_degenerate(mesh, f)) continue;
    const auto& [a, b, c] = mesh.triangles[f];
    boxes.emplace_back(point(mesh, a).bbox() + point(mesh, b).bbox() + point(mesh, c).bbox(), f);
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
