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

// A side of a facet, which lies along an edge.
struct EdgeSide {
  std::uint32_t low = 0, high = 0;  // the edge's vertices, the lower number first
  std::uint32_t facet = 0;
  bool upward = false;  // the facet runs from low to high
};

// The sides of all facets, sorted by edge.
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

// Calls `visit` with the range of each edge's sides.
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
  Tally open;     // edges of one facet
  Tally crowded;  // edges of more than two facets
  Tally turned;   // edges of two facets that face opposite ways
  Tally pinched;  // vertices
};

std::size_t corner_of(const TriangleMesh& mesh, std::size_t facet, std::uint32_t vertex) {
  const auto& triangle = mesh.triangles[facet];
  return 3 * facet + static_cast<std::size_t>(std::find(triangle.begin(), triangle.end(), vertex) - triangle.begin());
}

// A vertex is pinched if the facets around it form groups without a common edge there. The vertices of a hole have such
// groups too, but the hole has its own check. Corner k of facet f has the number 3 f + k.
Tally pinched_vertices(const TriangleMesh& mesh, const std::vector<EdgeSide>& sides) {
  DisjointSets corners(3 * mesh.triangles.size());
  std::vector<bool> is_at_hole(mesh.vertices.size(), false);
  for_each_edge(sides, [&](std::size_t first, std::size_t last) {
    if (last - first == 1) is_at_hole[sides[first].low] = is_at_hole[sides[first].high] = true;
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
    std::size_t& first_group = group[vertex];
    const std::size_t own_group = corners.root(corner);
    if (first_group == none) first_group = own_group;
    // Each further group is counted once, at its root.
    const bool begins_further_group = own_group != first_group && own_group == corner;
    if (begins_further_group && !is_at_hole[vertex]) pinched.add(corner / 3);
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

// ---- orientation ----------------------------------------------------------------------------------------------------

// A connected component of the surface.
struct Component {
  std::vector<std::size_t> facets;
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = -low;
  Vec3 extreme = Vec3::Zero();  // its vertex of largest x, which cannot lie inside it
  double volume = 0;
};

std::vector<Component> components_of(const TriangleMesh& mesh, const std::vector<EdgeSide>& sides) {
  DisjointSets facets(mesh.triangles.size());
  for_each_edge(sides, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first + 1; k < last; ++k) facets.unite(sides[first].facet, sides[k].facet);
  });
  std::vector<std::size_t> number(mesh.triangles.size());
  std::vector<Component> components;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const std::size_t root = facets.root(f);
    if (root == f) {
      number[f] = components.size();
      components.emplace_back();
    }
    Component& component = components[number[root]];
    component.facets.push_back(f);
    for (const std::uint32_t index : mesh.triangles[f]) {
      const Vec3& vertex = mesh.vertices[index];
      if (!(vertex.x() <= component.high.x())) component.extreme = vertex;
      component.low = component.low.cwiseMin(vertex);
      component.high = component.high.cwiseMax(vertex);
    }
  }
  for (Component& component : components) {
    const Vec3& origin = component.low;
    for (const std::size_t f : component.facets) {
      const auto& [a, b, c] = mesh.triangles[f];
      const Vec3 u = mesh.vertices[a] - origin, v = mesh.vertices[b] - origin, w = mesh.vertices[c] - origin;
      component.volume += u.dot(v.cross(w)) / 6.0;
    }
  }
  return components;
}

// Winding number of a component about `point`: the sum of its facets' solid angles over 4π.
double winding_number(const TriangleMesh& mesh, const Component& component, const Vec3& point) {
  double angle = 0;
  for (const std::size_t f : component.facets) {
    const auto& [a, b, c] = mesh.triangles[f];
    angle += solid_angle(mesh.vertices[a] - point, mesh.vertices[b] - point, mesh.vertices[c] - point);
  }
  return angle / (2.0 * k_two_pi);
}

// A component outside the others must enclose positive volume. One inside another must be a cavity, of negative volume.
Check outward_check(const ExaminedSurface& surface, const std::vector<EdgeSide>& sides) {
  const TriangleMesh& mesh = surface.mesh;
  const std::vector<Component> components = components_of(mesh, sides);
  // Limits the time for files with thousands of nested components.
  std::size_t facets_left = 200'000'000;
  Tally inverted;
  for (const Component& component : components) {
    const Vec3& extreme = component.extreme;
    double winding = 0;
    for (const Component& other : components) {
      const bool may_contain = &other != &component && (extreme.array() > other.low.array()).all() &&
                               (extreme.array() < other.high.array()).all();
      if (!may_contain) continue;
      if (other.facets.size() > facets_left) return not_checked("inverted_parts", "too many nested parts");
      facets_left -= other.facets.size();
      winding += winding_number(mesh, other, extreme);
    }
    const bool is_inside = std::lround(winding) != 0;
    if (!(is_inside ? component.volume < 0 : component.volume > 0)) inverted.add(component.facets.front());
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
