#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "base/text.h"
#include "base/thread_pool.h"
#include "fusee/base.h"
#include "fusee/solid.h"
#include "solid/disjoint_sets.h"
#include "solid/faulty_facets.h"
#include "solid/place.h"
#include "solid/self_intersection.h"
#include "solid/solid_angle.h"
#include "solid/sorted_by_vertex.h"

namespace fusee::solid {
namespace {

std::string facet_at(const ExaminedSurface& surface, std::size_t facet) {
  const TriangleMesh& mesh = surface.mesh;
  const auto& [a, b, c] = mesh.triangles[facet];
  return "facet " + std::to_string(surface.number_of(facet)) + " at " +
         place_of((mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3.0);
}

// Number of faulty facets, and the first of them.
struct Tally {
  std::size_t count = 0;
  std::size_t first = 0;

  void add(std::size_t facet) {
    first = count == 0 ? facet : std::min(first, facet);
    ++count;
  }
};

Check none_of(const ExaminedSurface& surface, std::string name, const Tally& tally) {
  return exactly(std::move(name), static_cast<double>(tally.count), 0, "1",
                 tally.count > 0 ? facet_at(surface, tally.first) : std::string());
}

Check none_of(const ExaminedSurface& surface, std::string name, const std::vector<std::uint32_t>& facets) {
  return exactly(std::move(name), static_cast<double>(facets.size()), 0, "1",
                 facets.empty() ? std::string() : facet_at(surface, facets.front()));
}

Check not_checked(std::string name, const std::string& reason) {
  return {std::move(name), 0, 0, "1", false, "not checked: " + reason};
}

// The sides of all facets, sorted by edge.
struct EdgeSide {
  std::uint32_t low = 0, high = 0;
  std::uint32_t facet = 0;
  bool upward = false;  // the facet runs from low to high
};

std::vector<EdgeSide> edge_sides(const TriangleMesh& mesh) {
  std::vector<EdgeSide> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.triangles[f][k], b = mesh.triangles[f][k == 2 ? 0 : k + 1];
      sides.push_back({std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(f), a < b});
    }
  }
  return sorted_by_vertex(
      sides, mesh.vertices.size(), [](const EdgeSide& side) { return side.low; },
      [](const EdgeSide& s, const EdgeSide& t) {
        return std::tie(s.high, s.facet, s.upward) < std::tie(t.high, t.facet, t.upward);
      });
}

template <typename Visit>
void for_each_edge(const std::vector<EdgeSide>& sides, const Visit& visit) {
  for (std::size_t first = 0; first < sides.size();) {
    std::size_t last = first + 1;
    while (last < sides.size() && sides[last].low == sides[first].low && sides[last].high == sides[first].high) ++last;
    visit(first, last);
    first = last;
  }
}

struct Topology {
  Tally open, crowded, turned, pinched;
};

std::size_t corner_of(const TriangleMesh& mesh, std::size_t facet, std::uint32_t vertex) {
  const auto& triangle = mesh.triangles[facet];
  return 3 * facet + static_cast<std::size_t>(std::find(triangle.begin(), triangle.end(), vertex) - triangle.begin());
}

// A vertex is pinched if the facets around it form groups without a common edge there. The corners of a hole form such
// groups too, but the hole has its own check.
Tally pinched_vertices(const TriangleMesh& mesh, const std::vector<EdgeSide>& sides) {
  DisjointSets corners(3 * mesh.triangles.size());
  std::vector<bool> at_hole(mesh.vertices.size(), false);
  for_each_edge(sides, [&](std::size_t first, std::size_t last) {
    if (last - first == 1) at_hole[sides[first].low] = at_hole[sides[first].high] = true;
    for (std::size_t k = first + 1; k < last; ++k) {
      for (const std::uint32_t vertex : {sides[k].low, sides[k].high}) {
        corners.unite(corner_of(mesh, sides[first].facet, vertex), corner_of(mesh, sides[k].facet, vertex));
      }
    }
  });
  constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::vector<std::size_t> group(mesh.vertices.size(), none);
  Tally pinched;
  for (std::size_t corner = 0; corner < 3 * mesh.triangles.size(); ++corner) {
    const std::uint32_t vertex = mesh.triangles[corner / 3][corner % 3];
    std::size_t& known = group[vertex];
    const std::size_t here = corners.root(corner);
    if (known != none && known != here && here == corner && !at_hole[vertex]) pinched.add(corner / 3);
    known = known == none ? here : known;
  }
  return pinched;
}

Topology topology_of(const TriangleMesh& mesh, const std::vector<EdgeSide>& sides) {
  Topology topology;
  for_each_edge(sides, [&](std::size_t first, std::size_t last) {
    if (last - first == 1) topology.open.add(sides[first].facet);
    if (last - first > 2) topology.crowded.add(sides[first].facet);
    if (last - first == 2 && sides[first].upward == sides[first + 1].upward) topology.turned.add(sides[first].facet);
  });
  topology.pinched = pinched_vertices(mesh, sides);
  return topology;
}

// ---- outward --------------------------------------------------------------------------------------------------------

struct Part {
  std::vector<std::size_t> facets;
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = -low;
  Vec3 extreme = Vec3::Zero();  // its vertex of largest x, which cannot lie inside it
  double volume = 0;
};

std::vector<Part> parts_of(const TriangleMesh& mesh, const std::vector<EdgeSide>& sides) {
  DisjointSets facets(mesh.triangles.size());
  for_each_edge(sides, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first + 1; k < last; ++k) facets.unite(sides[first].facet, sides[k].facet);
  });
  std::vector<std::size_t> number(mesh.triangles.size());
  std::vector<Part> parts;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const std::size_t root = facets.root(f);
    if (root == f) {
      number[f] = parts.size();
      parts.emplace_back();
    }
    Part& part = parts[number[root]];
    part.facets.push_back(f);
    for (const std::uint32_t index : mesh.triangles[f]) {
      const Vec3& vertex = mesh.vertices[index];
      if (!(vertex.x() <= part.high.x())) part.extreme = vertex;
      part.low = part.low.cwiseMin(vertex);
      part.high = part.high.cwiseMax(vertex);
    }
  }
  for (Part& part : parts) {
    for (const std::size_t f : part.facets) {
      const auto& [a, b, c] = mesh.triangles[f];
      const Vec3 u = mesh.vertices[a] - part.low, v = mesh.vertices[b] - part.low, w = mesh.vertices[c] - part.low;
      part.volume += u.dot(v.cross(w)) / 6.0;
    }
  }
  return parts;
}

// Winding number of a part's surface about `point`: the sum of its facets' solid angles over 4π.
double winding_number(const TriangleMesh& mesh, const Part& part, const Vec3& point) {
  double angle = 0;
  for (const std::size_t f : part.facets) {
    const auto& [a, b, c] = mesh.triangles[f];
    angle += solid_angle(mesh.vertices[a] - point, mesh.vertices[b] - point, mesh.vertices[c] - point);
  }
  return angle / (2.0 * k_two_pi);
}

// A part outside the others must enclose positive volume, a part inside another must be a cavity.
Check outward_check(const ExaminedSurface& surface, const std::vector<EdgeSide>& sides) {
  const TriangleMesh& mesh = surface.mesh;
  const std::vector<Part> parts = parts_of(mesh, sides);
  // Bound for files with thousands of nested parts.
  std::size_t facets_left = 200'000'000;
  Tally inverted;
  for (const Part& part : parts) {
    double around = 0;
    for (const Part& other : parts) {
      const bool may_contain = &other != &part && (part.extreme.array() > other.low.array()).all() &&
                               (part.extreme.array() < other.high.array()).all();
      if (!may_contain) continue;
      if (other.facets.size() > facets_left) return not_checked("inverted_parts", "too many nested parts");
      facets_left -= other.facets.size();
      around += winding_number(mesh, other, part.extreme);
    }
    const bool inside = std::lround(around) != 0;
    if (!(inside ? part.volume < 0 : part.volume > 0)) inverted.add(part.facets.front());
  }
  return none_of(surface, "inverted_parts", inverted);
}

// With fewer facets, a search for crossings ends before a thread would have started.
constexpr std::size_t k_worth_a_thread = 2000;

Check crossing_check(const ExaminedSurface& surface) {
  const CrossingSearch search = find_crossing(surface.mesh);
  if (search.gave_up) return not_checked("self_intersections", "too many overlapping facets");
  if (!search.facets) return exactly("self_intersections", 0, 0, "1");
  const auto [f, g] = *search.facets;
  return exactly("self_intersections", 1, 0, "1",
                 facet_at(surface, f) + " crosses facet " + std::to_string(surface.number_of(g)));
}

// ---- preconditions of the other checks ------------------------------------------------------------------------------

Check facets_check(const TriangleMesh& mesh) {
  const std::size_t count = mesh.triangles.size();
  std::string where = "there are no facets";
  if (count > 0)
    where = std::to_string(count) + (count == 1 ? " facet encloses" : " facets enclose") +
            " no solid: at least 4 are required";
  return at_least("facets", static_cast<double>(count), 4, "1", where);
}

Check indices_check(const TriangleMesh& mesh) {
  Tally bad;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const auto& triangle = mesh.triangles[f];
    if (*std::max_element(triangle.begin(), triangle.end()) >= mesh.vertices.size()) bad.add(f);
  }
  return exactly("indices_out_of_range", static_cast<double>(bad.count), 0, "1",
                 "facet " + std::to_string(bad.first) + " refers to a vertex that does not exist");
}

Check finite_check(const TriangleMesh& mesh) {
  const auto bad =
      std::find_if(mesh.vertices.begin(), mesh.vertices.end(), [](const Vec3& vertex) { return !vertex.allFinite(); });
  const auto count = std::count_if(bad, mesh.vertices.end(), [](const Vec3& vertex) { return !vertex.allFinite(); });
  return exactly("vertices_not_finite", static_cast<double>(count), 0, "1",
                 "vertex " + std::to_string(bad - mesh.vertices.begin()));
}

// Checks that the surface is closed and faces outward. The orientation of an open surface is not checked, because it
// has no inside.
void add_surface_checks(const ExaminedSurface& surface, std::vector<Check>& checks) {
  const std::vector<EdgeSide> sides = edge_sides(surface.mesh);
  const Topology topology = topology_of(surface.mesh, sides);
  checks.push_back(none_of(surface, "open_edges", topology.open));
  checks.push_back(none_of(surface, "edges_of_more_than_two_facets", topology.crowded));
  checks.push_back(none_of(surface, "flipped_facets", topology.turned));
  checks.push_back(none_of(surface, "pinched_vertices", topology.pinched));
  const bool closed = topology.open.count == 0 && topology.crowded.count == 0 && topology.turned.count == 0;
  if (closed) checks.push_back(outward_check(surface, sides));
}

}  // namespace

std::vector<Check> check_mesh(const TriangleMesh& mesh) {
  std::vector<Check> checks{facets_check(mesh), indices_check(mesh), finite_check(mesh)};
  if (!all_ok(checks)) return checks;
  const ExaminedSurface welded{weld(mesh), {}};
  const FaultyFacets faulty = find_faulty_facets(welded.mesh);
  checks.push_back(none_of(welded, "degenerate_facets", faulty.degenerate));
  checks.push_back(none_of(welded, "duplicate_facets", faulty.duplicate));
  // Equal facets would make the search for crossings quadratic in their number.
  const ExaminedSurface others = faulty.none() ? ExaminedSurface() : without_faulty_facets(welded.mesh, faulty);
  const ExaminedSurface& examined = faulty.none() ? welded : others;
  auto crossings =
      run_async([&examined] { return crossing_check(examined); }, mesh.triangles.size() > k_worth_a_thread);
  add_surface_checks(examined, checks);
  checks.push_back(crossings.get());
  return checks;
}

}  // namespace fusee::solid
