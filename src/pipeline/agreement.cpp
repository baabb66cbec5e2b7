#include "pipeline/agreement.h"

#include <algorithm>
#include <limits>

namespace fusee::pipeline {
namespace {

constexpr double k_infinite = std::numeric_limits<double>::infinity();

Check same_count(const solid::TriangleMesh& reference, const solid::TriangleMesh& other) {
  return exactly("triangles", static_cast<double>(other.triangles.size()),
                 static_cast<double>(reference.triangles.size()), "1");
}

double largest_distance(const solid::TriangleMesh& a, const solid::TriangleMesh& b) {
  if (a.triangles.size() != b.triangles.size()) return k_infinite;
  double largest = 0;
  for (std::size_t i = 0; i < a.triangles.size(); ++i) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vec3& p = a.vertices[a.triangles[i][corner]];
      const Vec3& q = b.vertices[b.triangles[i][corner]];
      largest = std::max(largest, (p - q).norm());
    }
  }
  return largest;
}

/// Largest distance from a vertex of `from` to the nearest of `to`; infinite beyond `reach`. Vertices are sorted along
/// x, so that only those within reach are compared.
double farthest_from(const solid::TriangleMesh& to, const solid::TriangleMesh& from, double reach) {
  std::vector<Vec3> sorted = to.vertices;
  std::sort(sorted.begin(), sorted.end(), [](const Vec3& a, const Vec3& b) { return a.x() < b.x(); });
  double farthest = 0;
  for (const Vec3& vertex : from.vertices) {
    auto near = std::lower_bound(sorted.begin(), sorted.end(), vertex.x() - reach,
                                 [](const Vec3& v, double x) { return v.x() < x; });
    double nearest = k_infinite;
    for (; near != sorted.end() && near->x() <= vertex.x() + reach; ++near)
      nearest = std::min(nearest, (*near - vertex).norm());
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

}  // namespace

std::vector<Check> same_mesh(const solid::TriangleMesh& reference, const solid::TriangleMesh& other) {
  // Text formats hold the shortest decimal that gives the same float; as a double it differs.
  return {same_count(reference, other),
          at_most("deviation", largest_distance(reference, solid::rounded_to_float(other)), 0.0, "mm")};
}

std::vector<Check> near_mesh(const solid::TriangleMesh& reference, const solid::TriangleMesh& other, double tolerance) {
  const double deviation =
      std::max(farthest_from(reference, other, tolerance), farthest_from(other, reference, tolerance));
  return {same_count(reference, other), at_most("deviation", deviation, tolerance, "mm")};
}

}  // namespace fusee::pipeline
