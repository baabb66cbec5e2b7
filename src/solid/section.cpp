#include "solid/section.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "base/text.h"
#include "fusee/base.h"
#include "fusee/solid.h"

namespace fusee::solid {
namespace {

// A cut triangle: the section enters it across the descending edge and leaves it across the rising one, with the solid
// on its left.
struct FacetCut {
  std::uint64_t from = 0;  // undirected edge
  std::uint64_t to = 0;
  Vec2 start;
  bool used = false;
};

std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
  return (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
}

// A vertex exactly at z counts as above, so that there are no special cases.
bool above(const Vec3& vertex, double z) { return vertex.z() >= z; }

bool is_cut(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& triangle, double z) {
  const bool first = above(mesh.vertices[triangle[0]], z);
  return above(mesh.vertices[triangle[1]], z) != first || above(mesh.vertices[triangle[2]], z) != first;
}

// The triangles that the plane cuts, welded: neighbours are found by position, independent of a file's numbering.
TriangleMesh cut_triangles(const TriangleMesh& mesh, double z) {
  TriangleMesh cut;
  const std::size_t count = mesh.vertices.size();
  for (const auto& [a, b, c] : mesh.triangles) {
    if (a >= count || b >= count || c >= count) continue;
    if (!is_cut(mesh, {a, b, c}, z)) continue;
    const auto first = static_cast<std::uint32_t>(cut.vertices.size());
    cut.vertices.insert(cut.vertices.end(), {mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
    cut.triangles.push_back({first, first + 1, first + 2});
  }
  return weld(cut);
}

// Both sides of an edge compute the crossing from the same two numbers in the same order, so the places are equal.
Vec2 crossing(const TriangleMesh& mesh, std::uint32_t a, std::uint32_t b, double z) {
  const Vec3& first = mesh.vertices[std::min(a, b)];
  const Vec3& second = mesh.vertices[std::max(a, b)];
  const double share = (z - first.z()) / (second.z() - first.z());
  return (first + share * (second - first)).head<2>();
}

std::vector<FacetCut> cuts_at(const TriangleMesh& mesh, const Triangles& triangles, double z) {
  std::vector<FacetCut> cuts;
  cuts.reserve(triangles.size());
  for (const auto& triangle : triangles) {
    if (!is_cut(mesh, triangle, z)) continue;
    FacetCut cut;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = triangle[k], to = triangle[(k + 1) % 3];
      const bool from_above = above(mesh.vertices[from], z);
      if (from_above == above(mesh.vertices[to], z)) continue;
      if (from_above) {
        cut.from = edge_key(from, to);
        cut.start = crossing(mesh, from, to, z);
      } else {
        cut.to = edge_key(from, to);
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

// The starts of cuts, sorted by edge.
class CutStarts {
 public:
  explicit CutStarts(const std::vector<FacetCut>& cuts) {
    starts_.reserve(cuts.size());
    for (std::size_t k = 0; k < cuts.size(); ++k) starts_.emplace_back(cuts[k].from, k);
    std::sort(starts_.begin(), starts_.end());
  }

  // The first unused cut that begins at this edge; the number of cuts if there is none.
  std::size_t next(const std::vector<FacetCut>& cuts, std::uint64_t edge) const {
    auto found = std::lower_bound(starts_.begin(), starts_.end(), std::pair(edge, std::size_t{0}));
    while (found != starts_.end() && found->first == edge && cuts[found->second].used) ++found;
    return found != starts_.end() && found->first == edge ? found->second : cuts.size();
  }

 private:
  std::vector<std::pair<std::uint64_t, std::size_t>> starts_;
};

}  // namespace

std::vector<Polygon> section_of_welded(const TriangleMesh& mesh, const Triangles& triangles, double z) {
  std::vector<FacetCut> cuts = cuts_at(mesh, triangles, z);
  const CutStarts starts(cuts);
  std::vector<Polygon> loops;
  for (std::size_t first = 0; first < cuts.size(); ++first) {
    if (cuts[first].used) continue;
    Polygon points;
    std::size_t at = first;
    bool is_closed = false;
    while (at < cuts.size() && !cuts[at].used) {
      cuts[at].used = true;
      points.push_back(cuts[at].start);
      if (cuts[at].to == cuts[first].from) {
        is_closed = true;
        break;
      }
      at = starts.next(cuts, cuts[at].to);
    }
    // An open mesh leaves open chains, which are not loops.
    if (!is_closed) continue;
    points = without_repeats(points);
    if (points.size() >= 3) loops.push_back(std::move(points));
  }
  return loops;
}

std::vector<Polygon> section(const TriangleMesh& mesh, double z) {
  const TriangleMesh cut = cut_triangles(mesh, z);
  return section_of_welded(cut, cut.triangles, z);
}

Polygon outer_loop(const std::vector<Polygon>& loops) {
  const auto larger = [](const Polygon& a, const Polygon& b) { return signed_area(a) < signed_area(b); };
  const auto found = std::max_element(loops.begin(), loops.end(), larger);
  if (found == loops.end() || !(signed_area(*found) > 0)) {
    throw InputError("", "no closed outline in the section", "is the part closed, and does it reach this height?");
  }
  return *found;
}

}  // namespace fusee::solid
