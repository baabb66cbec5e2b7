#include "solid/overhangs.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "fusee/base.h"
#include "solid/nearest_float.h"

namespace fusee::solid {
namespace {

constexpr std::uint32_t k_none = std::numeric_limits<std::uint32_t>::max();
// Narrower facets have no reliable direction: floats of coordinates up to 128 mm are 8e-6 mm apart, which turns such a
// facet by 0.1° and more. Boolean operations cut planes into such facets.
constexpr double k_narrow = 5e-3;
// Largest number of narrow neighbours to cross in search of a wide facet of the same plane.
constexpr int k_narrow_neighbours = 8;

/// A part's surface, prepared for walks from facet to facet.
struct Surface {
  TriangleMesh mesh;                                 // welded
  std::vector<std::array<std::uint32_t, 3>> across;  // facet across side k
  std::vector<Vec3> normals;                         // reliable normals, see normal_of()
  double bed = 0;                                    // height of the lowest point

  const Vec3& corner(std::uint32_t facet, std::size_t k) const { return mesh.vertices[mesh.triangles[facet][k % 3]]; }
  Vec3 along(std::uint32_t facet, std::size_t k) const { return corner(facet, k + 1) - corner(facet, k); }
  Vec3 twice_area(std::uint32_t facet) const { return along(facet, 0).cross(corner(facet, 2) - corner(facet, 0)); }
};

// Pairs facets that run along a common side in opposite directions. A walk from facet to facet then stays on one
// side of the surface, even where four facets share an edge.
std::vector<std::array<std::uint32_t, 3>> neighbours_of(const TriangleMesh& mesh) {
  struct HalfEdge {
    std::uint64_t edge;
    std::uint32_t side;  // 3 · facet + k
    bool upward;         // runs from the vertex of the lower number
  };
  std::vector<HalfEdge> halves;
  halves.reserve(3 * mesh.triangles.size());
  for (std::uint32_t side = 0; side < 3 * mesh.triangles.size(); ++side) {
    const auto& triangle = mesh.triangles[side / 3];
    const std::uint32_t a = triangle[side % 3], b = triangle[(side % 3 + 1) % 3];
    halves.push_back({(std::uint64_t{std::min(a, b)} << 32) | std::max(a, b), side, a < b});
  }
  std::sort(halves.begin(), halves.end(),
            [](const HalfEdge& s, const HalfEdge& t) { return std::pair(s.edge, s.side) < std::pair(t.edge, t.side); });
  std::vector<std::array<std::uint32_t, 3>> across(mesh.triangles.size(), {k_none, k_none, k_none});
  for (std::size_t i = 0; i + 1 < halves.size(); ++i) {
    const HalfEdge &one = halves[i], &other = halves[i + 1];
    if (one.edge != other.edge || one.upward == other.upward) continue;
    across[one.side / 3][one.side % 3] = other.side / 3;
    across[other.side / 3][other.side % 3] = one.side / 3;
    ++i;
  }
  return across;
}

std::size_t longest_side(const Surface& surface, std::uint32_t facet) {
  std::size_t longest = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (surface.along(facet, k).squaredNorm() > surface.along(facet, longest).squaredNorm()) longest = k;
  }
  return longest;
}

// The normal of the facet, or of the first facet across the longest sides that is wide enough.
Vec3 normal_of(const Surface& surface, std::uint32_t facet) {
  std::uint32_t at = facet;
  for (int step = 0; step < k_narrow_neighbours && at != k_none; ++step) {
    const std::size_t side = longest_side(surface, at);
    const Vec3 normal = surface.twice_area(at);
    if (normal.norm() > k_narrow * surface.along(at, side).norm()) return normal.normalized();
    at = surface.across[at][side];
  }
  return surface.twice_area(facet).normalized();
}

Surface surface_of(const TriangleMesh& mesh) {
  Surface surface;
  surface.mesh = weld(mesh);
  surface.across = neighbours_of(surface.mesh);
  surface.bed = bounds(surface.mesh).low.z();
  surface.normals.reserve(surface.mesh.triangles.size());
  for (std::uint32_t f = 0; f < surface.mesh.triangles.size(); ++f) surface.normals.push_back(normal_of(surface, f));
  return surface;
}

Vec3 centre_of(const Surface& surface, std::uint32_t facet) {
  return (surface.corner(facet, 0) + surface.corner(facet, 1) + surface.corner(facet, 2)) / 3.0;
}

bool within_first_layer(const Surface& surface, std::uint32_t facet, double first_layer) {
  const double top =
      std::max({surface.corner(facet, 0).z(), surface.corner(facet, 1).z(), surface.corner(facet, 2).z()});
  return top <= surface.bed + first_layer + k_float_grain;
}

double slope_of(const Vec3& normal) { return elementary::acos(std::clamp(-normal.z(), -1.0, 1.0)); }

// Tests for material below side k of an overhanging facet, whose neighbour there does not overhang. A downward or
// vertical neighbour supports the edge if it goes down from it. An upward neighbour supports it at a re-entrant
// edge, where it rises on the facet's outer side, and not at a convex edge.
bool holds(const Surface& surface, std::uint32_t facet, std::size_t k, std::uint32_t neighbour) {
  const Vec3& normal = surface.normals[neighbour];
  const Vec3 into_neighbour = normal.cross(-surface.along(facet, k));
  constexpr double upright = 1e-9;
  return normal.z() <= upright ? into_neighbour.z() < 0 : into_neighbour.dot(surface.normals[facet]) > 0;
}

class PatchFinder {
 public:
  PatchFinder(const Surface& surface, std::vector<bool> hangs, double first_layer)
      : surface_(surface), hangs_(std::move(hangs)), first_layer_(first_layer), index_(hangs_.size(), k_none) {}

  std::vector<OverhangPatch> patches() {
    std::vector<OverhangPatch> found;
    for (std::uint32_t f = 0; f < hangs_.size(); ++f) {
      if (hangs_[f] && index_[f] == k_none) found.push_back(patch_from(f));
    }
    return found;
  }

 private:
  OverhangPatch patch_from(std::uint32_t seed) {
    std::vector<std::uint32_t> members{seed};
    index_[seed] = 0;
    for (std::size_t i = 0; i < members.size(); ++i) {
      for (const std::uint32_t next : surface_.across[members[i]]) {
        if (next == k_none || !hangs_[next] || index_[next] != k_none) continue;
        index_[next] = static_cast<std::uint32_t>(members.size());
        members.push_back(next);
      }
    }
    OverhangPatch patch;
    patch.flattest = k_pi;
    for (const std::uint32_t f : members) add(patch, f);
    return patch;
  }

  void add(OverhangPatch& patch, std::uint32_t f) const {
    OverhangFacet facet;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t next = surface_.across[f][k];
      facet.corners[k] = surface_.corner(f, k);
      facet.beyond[k] = beyond(f, k, next);
      if (facet.beyond[k] == EdgeSupport::patch) facet.neighbour[k] = index_[next];
    }
    patch.facets.push_back(facet);
    patch.area += 0.5 * std::abs(surface_.twice_area(f).z());
    const double slope = slope_of(surface_.normals[f]);
    if (slope < patch.flattest) {
      patch.flattest = slope;
      patch.flattest_at = centre_of(surface_, f);
    }
  }

  EdgeSupport beyond(std::uint32_t f, std::size_t k, std::uint32_t next) const {
    if (next == k_none) return EdgeSupport::free;
    if (hangs_[next]) return EdgeSupport::patch;
    const bool held = within_first_layer(surface_, next, first_layer_) || holds(surface_, f, k, next);
    return held ? EdgeSupport::held : EdgeSupport::free;
  }

  const Surface& surface_;
  std::vector<bool> hangs_;
  double first_layer_;
  std::vector<std::uint32_t> index_;  // index of a facet within its patch
};

// ---- unsupported regions --------------------------------------------------------------------------------------------

// Vertices connected by level edges.
struct Terrace {
  bool has_lower = false;                                 // a neighbour lies lower
  double top = -std::numeric_limits<double>::infinity();  // highest of its own vertices
  double next = std::numeric_limits<double>::infinity();  // height of the lowest neighbour above
  double twice_area = 0;  // twice the area of the section half-way up to `next`: positive around a solid

  bool is_lowest() const { return !has_lower && std::isfinite(next); }
  double half_way() const { return 0.5 * (top + next); }
};

class Terraces {
 public:
  explicit Terraces(const TriangleMesh& mesh) : mesh_(mesh), root_(mesh.vertices.size()), terraces_(root_.size()) {
    join_level_vertices();
    for (std::uint32_t v = 0; v < root_.size(); ++v) {
      terraces_[root_[v]].top = std::max(terraces_[root_[v]].top, mesh_.vertices[v].z());
    }
    for (const auto& triangle : mesh_.triangles) record_neighbours(triangle);
    for (const auto& triangle : mesh_.triangles) add_sections(triangle);
  }

  // One vertex of each lowest terrace at which a solid begins, not a pit.
  std::vector<Vec3> beginnings() const {
    std::vector<Vec3> found;
    for (std::uint32_t v = 0; v < terraces_.size(); ++v) {
      if (terraces_[v].is_lowest() && terraces_[v].twice_area > 0) found.push_back(mesh_.vertices[v]);
    }
    return found;
  }

 private:
  void join_level_vertices() {
    std::iota(root_.begin(), root_.end(), 0u);
    for (const auto& triangle : mesh_.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = triangle[k], b = triangle[(k + 1) % 3];
        if (std::abs(height(a) - height(b)) <= k_float_grain) root_[root(a)] = root(b);
      }
    }
    for (std::uint32_t v = 0; v < root_.size(); ++v) root_[v] = root(v);
  }

  std::uint32_t root(std::uint32_t v) {
    while (root_[v] != v) v = root_[v] = root_[root_[v]];
    return v;
  }

  double height(std::uint32_t v) const { return mesh_.vertices[v].z(); }

  void record_neighbours(const std::array<std::uint32_t, 3>& triangle) {
    for (const std::uint32_t v : triangle) {
      Terrace& terrace = terraces_[root_[v]];
      for (const std::uint32_t neighbour : triangle) {
        if (root_[neighbour] == root_[v]) continue;
        if (height(neighbour) < height(v)) terrace.has_lower = true;
        if (height(neighbour) > terrace.top) terrace.next = std::min(terrace.next, height(neighbour));
      }
    }
  }

  void add_sections(const std::array<std::uint32_t, 3>& triangle) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t own = root_[triangle[k]];
      // A facet with two corners on one terrace is added to it once.
      const auto is_on_terrace = [&](std::uint32_t v) { return root_[v] == own; };
      const bool is_added =
          std::any_of(triangle.begin(), triangle.begin() + static_cast<std::ptrdiff_t>(k), is_on_terrace);
      Terrace& terrace = terraces_[own];
      if (!is_added && terrace.is_lowest()) {
        terrace.twice_area += section_share(triangle, terrace.half_way(), mesh_.vertices[own].head<2>());
      }
    }
  }

  // Twice a facet's contribution to the area of the section at z, about `origin`. The solid is on the left of the cut.
  double section_share(const std::array<std::uint32_t, 3>& triangle, double z, const Vec2& origin) const {
    Vec2 from = origin, to = origin;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 &a = mesh_.vertices[triangle[k]], &b = mesh_.vertices[triangle[(k + 1) % 3]];
      if ((a.z() >= z) == (b.z() >= z)) continue;
      const Vec2 at = (a + (z - a.z()) / (b.z() - a.z()) * (b - a)).head<2>();
      (a.z() >= z ? from : to) = at;
    }
    return cross(from - origin, to - origin);
  }

  const TriangleMesh& mesh_;
  std::vector<std::uint32_t> root_;  // representative vertex of each vertex's terrace
  std::vector<Terrace> terraces_;    // stored at the representative vertex
};

}  // namespace

Overhangs find_overhangs(const TriangleMesh& mesh, double steep_enough, double first_layer) {
  const Surface surface = surface_of(mesh);
  Overhangs overhangs;
  overhangs.flattest_other = k_pi / 2;
  std::vector<bool> hangs(surface.mesh.triangles.size(), false);
  for (std::uint32_t f = 0; f < hangs.size(); ++f) {
    const double slope = slope_of(surface.normals[f]);
    if (!(slope < k_pi / 2) || within_first_layer(surface, f, first_layer)) continue;
    hangs[f] = slope < steep_enough;
    if (hangs[f] || slope >= overhangs.flattest_other) continue;
    overhangs.flattest_other = slope;
    overhangs.flattest_other_at = centre_of(surface, f);
  }
  overhangs.patches = PatchFinder(surface, std::move(hangs), first_layer).patches();
  return overhangs;
}

// Half-way from a terrace without lower neighbours to the next vertex above, the facets around it are cut along one
// loop. The loop surrounds a solid that begins there, or the bottom of a pit.
std::vector<Vec3> find_unsupported_regions(const TriangleMesh& mesh, double first_layer) {
  const TriangleMesh welded = weld(mesh);
  const double pressed_on = bounds(welded).low.z() + first_layer + k_float_grain;
  std::vector<Vec3> regions = Terraces(welded).beginnings();
  regions.erase(std::remove_if(regions.begin(), regions.end(),
                               [pressed_on](const Vec3& place) { return place.z() <= pressed_on; }),
                regions.end());
  return regions;
}

}  // namespace fusee::solid
