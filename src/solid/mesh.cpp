#include "fusee/solid/mesh.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <unordered_map>

#include "solid/euler.h"
#include "solid/nearest_float.h"

namespace fusee {
namespace {

struct PositionHash {
  std::size_t operator()(const std::array<double, 3>& position) const {
    std::uint64_t hash = 0x9E3779B97F4A7C15u;
    for (const double coordinate : position) {
      hash ^= std::bit_cast<std::uint64_t>(coordinate);
      hash *= 0xFF51AFD7ED558CCDu;
      hash ^= hash >> 32;
    }
    return static_cast<std::size_t>(hash);
  }
};

// −0 and 0 are the same place; a NaN is never equal to itself and so keeps a vertex of its own.
std::array<double, 3> key_of(const Vec3& vertex) { return {vertex.x() + 0.0, vertex.y() + 0.0, vertex.z() + 0.0}; }

}  // namespace

double enclosed_volume(const TriangleMesh& mesh) {
  if (mesh.vertices.empty()) return 0;
  // About a vertex, not the origin: a small part far away would drown in rounding.
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
  std::unordered_map<std::array<double, 3>, std::uint32_t, PositionHash> places;
  places.reserve(mesh.vertices.size());
  std::vector<std::uint32_t> renumbered;
  renumbered.reserve(mesh.vertices.size());
  for (const Vec3& vertex : mesh.vertices) {
    // NaN equals nothing: in the map each would be a new entry under the same hash, and a file of them would take for
    // ever.
    if (vertex.hasNaN()) {
      renumbered.push_back(static_cast<std::uint32_t>(welded.vertices.size()));
      welded.vertices.push_back(vertex);
      continue;
    }
    const auto [place, fresh] = places.try_emplace(key_of(vertex), static_cast<std::uint32_t>(welded.vertices.size()));
    if (fresh) welded.vertices.push_back(vertex);
    renumbered.push_back(place->second);
  }
  const auto renumber = [&renumbered](std::uint32_t index) {
    return index < renumbered.size() ? renumbered[index] : std::numeric_limits<std::uint32_t>::max();
  };
  welded.triangles.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) welded.triangles.push_back({renumber(a), renumber(b), renumber(c)});
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

}  // namespace fusee
