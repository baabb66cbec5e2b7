#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>

#include "fusee/base/diagnostics.h"
#include "fusee/base/text.h"
#include "fusee/solid/mesh.h"

namespace fusee {
namespace {

// A cut triangle: the section enters it over one directed edge and leaves it over another, the solid on its left.
struct Cut {
  std::uint64_t from = 0;  // undirected edge
  std::uint64_t to = 0;
  Vec2 start;
  bool used = false;
};

std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
  return (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
}

// The same two numbers give the same place from both sides of an edge.
Vec2 crossing(const TriangleMesh& mesh, std::uint32_t a, std::uint32_t b, double z) {
  const Vec3& low = mesh.vertices[std::min(a, b)];
  const Vec3& high = mesh.vertices[std::max(a, b)];
  const double share = (z - low.z()) / (high.z() - low.z());
  return (low + share * (high - low)).head<2>();
}

// A vertex exactly at z counts as above, so that no case is special.
std::vector<Cut> cuts_at(const TriangleMesh& mesh, double z) {
  std::vector<Cut> cuts;
  const std::size_t count = mesh.vertices.size();
  for (const auto& triangle : mesh.triangles) {
    const auto [a, b, c] = triangle;
    if (a >= count || b >= count || c >= count) continue;
    const std::array<bool, 3> above{mesh.vertices[a].z() >= z, mesh.vertices[b].z() >= z, mesh.vertices[c].z() >= z};
    if (above[0] == above[1] && above[1] == above[2]) continue;
    Cut cut;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      if (above[k] == above[next]) continue;
      if (above[k]) {
        cut.from = edge_key(triangle[k], triangle[next]);
        cut.start = crossing(mesh, triangle[k], triangle[next], z);
      } else {
        cut.to = edge_key(triangle[k], triangle[next]);
      }
    }
    cuts.push_back(cut);
  }
  return cuts;
}

// Consecutive equal points come from vertices that lie in the plane.
Polygon without_repeats(const Polygon& points) {
  Polygon distinct;
  for (const Vec2& point : points) {
    if (distinct.empty() || point != distinct.back()) distinct.push_back(point);
  }
  while (distinct.size() > 1 && distinct.front() == distinct.back()) distinct.pop_back();
  return distinct;
}

}  // namespace

std::vector<Polygon> section(const TriangleMesh& mesh, double z) {
  std::vector<Cut> cuts = cuts_at(mesh, z);
  std::unordered_multimap<std::uint64_t, std::size_t> starts;
  starts.reserve(cuts.size());
  for (std::size_t k = cuts.size(); k-- > 0;) starts.emplace(cuts[k].from, k);
  const auto take_next = [&](std::uint64_t edge) {
    const auto found = starts.find(edge);
    if (found == starts.end()) return cuts.size();
    const std::size_t next = found->second;
    starts.erase(found);
    return next;
  };
  std::vector<Polygon> loops;
  for (std::size_t first = 0; first < cuts.size(); ++first) {
    if (cuts[first].used) continue;
    Polygon points;
    std::size_t at = first;
    while (at < cuts.size() && !cuts[at].used) {
      cuts[at].used = true;
      points.push_back(cuts[at].start);
      at = take_next(cuts[at].to);
    }
    // An open mesh leaves chains that end nowhere: no loop.
    if (at != first) continue;
    points = without_repeats(points);
    if (points.size() >= 3) loops.push_back(std::move(points));
  }
  return loops;
}

Polygon outer_loop(const std::vector<Polygon>& loops) {
  const auto larger = [](const Polygon& a, const Polygon& b) { return signed_area(a) < signed_area(b); };
  const auto found = std::max_element(loops.begin(), loops.end(), larger);
  if (found == loops.end() || !(signed_area(*found) > 0)) {
    throw InputError("", "no closed outline in the section", "is the part closed, and does it reach this height?");
  }
  return *found;
}

}  // namespace fusee
