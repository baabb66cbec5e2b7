#include <algorithm>
#include <bit>
#include <limits>

#include "fusee/solid.h"
#include "solid/euler.h"
#include "solid/nearest_float.h"

namespace fusee::solid {
namespace {

// Vertices by position, in a hash table with open addressing, because a part is welded a dozen times. −0 and 0 are the
// same position; a NaN never equals itself.
class Places {
 public:
  explicit Places(std::size_t vertices) : slots_(std::bit_ceil(2 * vertices + 1), k_free), mask_(slots_.size() - 1) {}

  /// The number of the vertex at the position of `vertex`, which is appended if there is none.
  std::uint32_t number_of(const Vec3& vertex, std::vector<Vec3>& vertices) {
    std::size_t slot = hash_of(vertex) & mask_;
    while (slots_[slot] != k_free) {
      if (vertices[slots_[slot]] == vertex) return slots_[slot];
      slot = (slot + 1) & mask_;
    }
    slots_[slot] = static_cast<std::uint32_t>(vertices.size());
    vertices.push_back(vertex);
    return slots_[slot];
  }

 private:
  static constexpr std::uint32_t k_free = std::numeric_limits<std::uint32_t>::max();

  // Mixes with a multiplier of MurmurHash3. Adding 0 turns −0 into 0.
  static std::size_t hash_of(const Vec3& vertex) {
    std::uint64_t hash = 0x9E3779B97F4A7C15u;
    for (const double coordinate : vertex) {
      hash ^= std::bit_cast<std::uint64_t>(coordinate + 0.0);
      hash *= 0xFF51AFD7ED558CCDu;
      hash ^= hash >> 32;
    }
    return static_cast<std::size_t>(hash);
  }

  std::vector<std::uint32_t> slots_;
  std::size_t mask_;
};

}  // namespace

double enclosed_volume(const TriangleMesh& mesh) {
  if (mesh.vertices.empty()) return 0;
  // Computed about a vertex instead of the origin, to avoid cancellation for a small part far away.
  const Vec3 origin = mesh.vertices.front();
  double six_times = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 u = mesh.vertices[a] - origin, v = mesh.vertices[b] - origin, w = mesh.vertices[c] - origin;
    six_times += u.x() * (v.y() * w.z() - v.z() * w.y()) + u.y() * (v.z() * w.x() - v.x() * w.z()) +
                 u.z() * (v.x() * w.y() - v.y() * w.x());
  }
  return six_times / 6.0;
}

Bounds bounds(const TriangleMesh& mesh) {
  constexpr double far = std::numeric_limits<double>::infinity();
  Bounds box{Vec3::Constant(far), Vec3::Constant(-far)};
  for (const Vec3& vertex : mesh.vertices) {
    box.low = box.low.cwiseMin(vertex);
    box.high = box.high.cwiseMax(vertex);
  }
  return box;
}

TriangleMesh weld(const TriangleMesh& mesh) {
  TriangleMesh welded;
  Places places(mesh.vertices.size());
  std::vector<std::uint32_t> renumbered;
  renumbered.reserve(mesh.vertices.size());
  for (const Vec3& vertex : mesh.vertices) {
    // NaNs share one hash and equal none, so a file of them would take quadratic time.
    if (vertex.hasNaN()) {
      renumbered.push_back(static_cast<std::uint32_t>(welded.vertices.size()));
      welded.vertices.push_back(vertex);
    } else {
      renumbered.push_back(places.number_of(vertex, welded.vertices));
    }
  }
  const auto renumber = [&renumbered](std::uint32_t index) {
    return index < renumbered.size() ? renumbered[index] : std::numeric_limits<std::uint32_t>::max();
  };
  welded.triangles.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) welded.triangles.push_back({renumber(a), renumber(b), renumber(c)});
  return welded;
}

TriangleMesh without_collapsed_facets(const TriangleMesh& mesh) {
  TriangleMesh welded = weld(mesh);
  std::erase_if(welded.triangles, [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  return welded;
}

TriangleMesh rounded_to_float(TriangleMesh mesh) {
  for (Vec3& vertex : mesh.vertices) vertex = vertex.unaryExpr(&nearest_float);
  return mesh;
}

int euler_number(const TriangleMesh& mesh) {
  const TriangleMesh welded = weld(mesh);
  std::vector<std::uint64_t> edges;
  std::vector<bool> used(welded.vertices.size(), false);
  edges.reserve(3 * welded.triangles.size());
  for (const auto& triangle : welded.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = triangle[k], b = triangle[(k + 1) % 3];
      edges.push_back((std::uint64_t{std::min(a, b)} << 32) | std::max(a, b));
      used[a] = true;
    }
  }
  std::sort(edges.begin(), edges.end());
  const auto distinct = std::unique(edges.begin(), edges.end()) - edges.begin();
  return static_cast<int>(std::count(used.begin(), used.end(), true) - distinct +
                          static_cast<std::ptrdiff_t>(welded.triangles.size()));
}

}  // namespace fusee::solid
