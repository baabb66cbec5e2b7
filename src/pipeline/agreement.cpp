#include "pipeline/agreement.h"

#include <algorithm>
#include <limits>

namespace fusee {
namespace {

double largest_distance(const TriangleMesh& a, const TriangleMesh& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.triangles.size(); ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      const Vec3& p = a.vertices[a.triangles[i][corner]];
      const Vec3& q = b.vertices[b.triangles[i][corner]];
      largest = std::max(largest, (p - q).norm());
    }
  }
  return largest;
}

}  // namespace

std::vector<Check> agreement(const TriangleMesh& reference, const TriangleMesh& other, double tolerance) {
  const bool same_count = reference.triangles.size() == other.triangles.size();
  const double distance = same_count ? largest_distance(reference, other) : std::numeric_limits<double>::infinity();
  return {exactly("triangles", static_cast<double>(other.triangles.size()), static_cast<double>(reference.triangles.size()), "1"),
          at_most("deviation", distance, tolerance, "mm")};
}

}  // namespace fusee
