#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Random.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <numeric>
#include <tuple>

#include "fusee/base/diagnostics.h"
#include "solid/boolean.h"
#include "solid/self_intersection.h"

namespace fusee {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Slots = std::array<boost::optional<SurfaceMesh*>, 4>;
// Places of the results in CGAL's array.
constexpr std::size_t k_union = 0, k_common = 1, k_difference = 2;

SurfaceMesh surface_of(const TriangleMesh& mesh) {
  SurfaceMesh surface;
  surface.reserve(mesh.vertices.size(), 3 * mesh.triangles.size() / 2, mesh.triangles.size());
  for (const Vec3& vertex : mesh.vertices) surface.add_vertex({vertex.x(), vertex.y(), vertex.z()});
  using Vertex = SurfaceMesh::Vertex_index;
  for (const auto& [a, b, c] : mesh.triangles) {
    demand(surface.add_face(Vertex(a), Vertex(b), Vertex(c)) != SurfaceMesh::null_face(),
           "a boolean of a mesh that is not manifold");
  }
  return surface;
}

TriangleMesh triangles_of(SurfaceMesh& surface) {
  surface.collect_garbage();
  TriangleMesh mesh;
  for (const auto vertex : surface.vertices()) {
    const auto& point = surface.point(vertex);
    mesh.vertices.emplace_back(point.x(), point.y(), point.z());
  }
  for (const auto face : surface.faces()) {
    std::array<std::uint32_t, 3> triangle{};
    std::size_t k = 0;
    for (const auto vertex : surface.vertices_around_face(surface.halfedge(face)))
      triangle.at(k++) = static_cast<std::uint32_t>(vertex.idx());
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

// Rounding may make the ends of a very short edge one: the edge is collapsed, the facets beside it are gone.
TriangleMesh without_short_edges(const TriangleMesh& rounded) {
  TriangleMesh mesh = weld(rounded);
  std::erase_if(mesh.triangles, [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  return mesh;
}

// Rounding may put a facet's three corners on a line. It lies along its longest edge: the two facets on that edge are
// divided the other way.
void flip_flat_facets(TriangleMesh& mesh) {
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    if (!is_degenerate(mesh, f)) continue;
    auto& flat = mesh.triangles[f];
    const auto length = [&](std::size_t k) {
      return (mesh.vertices[flat[(k + 1) % 3]] - mesh.vertices[flat[k]]).squaredNorm();
    };
    const std::size_t k = length(0) >= length(1) ? (length(0) >= length(2) ? 0 : 2) : (length(1) >= length(2) ? 1 : 2);
    const std::uint32_t p = flat[k], q = flat[(k + 1) % 3], r = flat[(k + 2) % 3];
    const auto runs_back = [p, q](const auto& t) {
      return (t[0] == q && t[1] == p) || (t[1] == q && t[2] == p) || (t[2] == q && t[0] == p);
    };
    const auto beside = std::find_if(mesh.triangles.begin(), mesh.triangles.end(), runs_back);
    if (beside == mesh.triangles.end()) continue;
    const std::uint32_t s = (*beside)[0] + (*beside)[1] + (*beside)[2] - p - q;
    flat = {p, s, r};
    *beside = {s, q, r};
  }
}

// CGAL numbers what it makes in an order that depends on where in memory its boxes lie: the same vertices and facets
// are put into the same order every time.
TriangleMesh in_order(TriangleMesh mesh) {
  std::vector<std::uint32_t> order(mesh.vertices.size()), rank(order.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const Vec3 &p = mesh.vertices[a], &q = mesh.vertices[b];
    return std::tuple(p.z(), p.y(), p.x()) < std::tuple(q.z(), q.y(), q.x());
  });
  std::vector<Vec3> vertices;
  for (std::uint32_t k = 0; k < order.size(); ++k) {
    rank[order[k]] = k;
    vertices.push_back(mesh.vertices[order[k]]);
  }
  mesh.vertices = std::move(vertices);
  for (auto& triangle : mesh.triangles) {
    for (std::uint32_t& index : triangle) index = rank[index];
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
  }
  std::sort(mesh.triangles.begin(), mesh.triangles.end());
  return mesh;
}

std::optional<BooleanResult> combine(const TriangleMesh& a, const TriangleMesh& b, std::size_t wanted) {
  // CGAL's box search draws from its default generator: the same draws give the same order of vertices every time.
  CGAL::get_default_random() = CGAL::Random(0);
  SurfaceMesh first = surface_of(a), second = surface_of(b), result, common;
  Slots slots;
  slots[wanted] = &result;
  slots[k_common] = &common;
  const std::array<bool, 4> valid = pmp::corefine_and_compute_boolean_operations(first, second, slots);
  if (!valid[wanted] || !valid[k_common]) return std::nullopt;
  BooleanResult outcome;
  outcome.mesh = in_order(without_short_edges(rounded_to_float(triangles_of(result))));
  flip_flat_facets(outcome.mesh);
  outcome.common_volume = enclosed_volume(triangles_of(common));
  return outcome;
}

}  // namespace

std::optional<BooleanResult> subtract(const TriangleMesh& body, const TriangleMesh& tool) {
  return combine(body, tool, k_difference);
}
std::optional<BooleanResult> unite(const TriangleMesh& a, const TriangleMesh& b) { return combine(a, b, k_union); }

TriangleMesh together(const std::vector<TriangleMesh>& meshes) {
  TriangleMesh all;
  for (const TriangleMesh& mesh : meshes) {
    const auto first = static_cast<std::uint32_t>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const auto& [a, b, c] : mesh.triangles) all.triangles.push_back({first + a, first + b, first + c});
  }
  return all;
}

}  // namespace fusee
