#include "solid/faulty_facets.h"

#include <algorithm>
#include <array>
#include <functional>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "solid/self_intersection.h"
#include "solid/sorted_by_vertex.h"

namespace fusee::solid {
namespace {

using VertexTriple = std::array<std::uint32_t, 3>;

bool is_collapsed(const VertexTriple& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

std::vector<std::uint32_t> duplicates_among(const TriangleMesh& mesh, const std::vector<bool>& left_out) {
  using NumberedFacet = std::pair<VertexTriple, std::uint32_t>;
  std::vector<NumberedFacet> facets;
  facets.reserve(mesh.triangles.size());
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    if (left_out[f]) continue;
    VertexTriple corners = mesh.triangles[f];
    std::sort(corners.begin(), corners.end());
    facets.emplace_back(corners, f);
  }
  const std::vector<NumberedFacet> sorted = sorted_by_vertex(
      facets, mesh.vertices.size(), [](const NumberedFacet& facet) { return facet.first[0]; }, std::less<>());
  std::vector<std::uint32_t> duplicates;
  for (std::size_t k = 1; k < sorted.size(); ++k) {
    if (sorted[k].first == sorted[k - 1].first) duplicates.push_back(sorted[k].second);
  }
  std::sort(duplicates.begin(), duplicates.end());
  return duplicates;
}

/// Collapses needles one by one. Splitting a neighbour that is itself a needle makes two shorter ones, so the number of
/// splits is bounded. Needles beyond the bound are removed without a split.
class NeedleCollapse {
 public:
  explicit NeedleCollapse(ExaminedSurface& surface)
      : surface_(surface), mesh_(surface.mesh), gone_(mesh_.triangles.size(), false) {
    for (std::uint32_t f = 0; f < mesh_.triangles.size(); ++f) enter(f);
  }

  void run() {
    std::size_t steps_left = 1000 + 16 * needles_.size();
    while (!needles_.empty()) {
      const std::uint32_t needle = needles_.back();
      needles_.pop_back();
      if (gone_[needle]) continue;
      if (steps_left > 0) {
        --steps_left;
        split_neighbour_of(needle);
      }
      gone_[needle] = true;
    }
    drop_removed_facets();
  }

 private:
  static std::uint64_t edge(std::uint32_t a, std::uint32_t b) {
    return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
  }

  void enter(std::uint32_t facet) {
    const VertexTriple& t = mesh_.triangles[facet];
    for (std::size_t k = 0; k < 3; ++k) facets_at_[edge(t[k], t[(k + 1) % 3])].push_back(facet);
    if (is_degenerate(mesh_, facet)) needles_.push_back(facet);
  }

  /// The corner between the two others. On a line, the order of coordinates is the order along it.
  std::uint32_t middle_of(VertexTriple t) const {
    std::sort(t.begin(), t.end(), [this](std::uint32_t a, std::uint32_t b) {
      const Vec3 &p = mesh_.vertices[a], &q = mesh_.vertices[b];
      return std::tie(p.x(), p.y(), p.z()) < std::tie(q.x(), q.y(), q.z());
    });
    return t[1];
  }

  void split_neighbour_of(std::uint32_t needle) {
    const VertexTriple corners = mesh_.triangles[needle];
    const std::uint32_t middle = middle_of(corners);
    const std::size_t at =
        static_cast<std::size_t>(std::find(corners.begin(), corners.end(), middle) - corners.begin());
    const std::uint32_t a = corners[(at + 1) % 3], b = corners[(at + 2) % 3];
    std::vector<std::uint32_t> across;
    for (const std::uint32_t facet : facets_at_[edge(a, b)]) {
      if (facet != needle && !gone_[facet]) across.push_back(facet);
    }
    if (across.size() != 1) return;  // no single neighbour across the edge
    gone_[across[0]] = true;
    for (const std::uint32_t end : {a, b}) {
      VertexTriple half = mesh_.triangles[across[0]];
      std::replace(half.begin(), half.end(), end, middle);
      if (is_collapsed(half)) continue;
      mesh_.triangles.push_back(half);
      surface_.numbers.push_back(surface_.numbers[across[0]]);
      gone_.push_back(false);
      enter(static_cast<std::uint32_t>(mesh_.triangles.size() - 1));
    }
  }

  void drop_removed_facets() {
    std::size_t kept = 0;
    for (std::size_t f = 0; f < gone_.size(); ++f) {
      if (gone_[f]) continue;
      mesh_.triangles[kept] = mesh_.triangles[f];
      surface_.numbers[kept++] = surface_.numbers[f];
    }
    mesh_.triangles.resize(kept);
    surface_.numbers.resize(kept);
  }

  ExaminedSurface& surface_;
  TriangleMesh& mesh_;
  std::vector<bool> gone_;
  std::vector<std::uint32_t> needles_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> facets_at_;
};

}  // namespace

FaultyFacets find_faulty_facets(const TriangleMesh& welded) {
  FaultyFacets faulty;
  std::vector<bool> is_faulty(welded.triangles.size(), false);
  for (std::uint32_t f = 0; f < welded.triangles.size(); ++f) {
    if (!is_degenerate(welded, f)) continue;
    is_faulty[f] = true;
    faulty.degenerate.push_back(f);
  }
  faulty.duplicate = duplicates_among(welded, is_faulty);
  return faulty;
}

ExaminedSurface without_faulty_facets(const TriangleMesh& welded, const FaultyFacets& faulty) {
  std::vector<bool> left_out(welded.triangles.size(), false);
  for (const std::uint32_t f : faulty.duplicate) left_out[f] = true;
  ExaminedSurface surface{{welded.vertices, {}}, {}};
  for (std::uint32_t f = 0; f < welded.triangles.size(); ++f) {
    if (left_out[f] || is_collapsed(welded.triangles[f])) continue;
    surface.mesh.triangles.push_back(welded.triangles[f]);
    surface.numbers.push_back(f);
  }
  if (!faulty.degenerate.empty()) NeedleCollapse(surface).run();
  return surface;
}

}  // namespace fusee::solid
