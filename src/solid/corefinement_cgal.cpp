#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Random.h>
#include <CGAL/Surface_mesh.h>

#include <optional>

#include "solid/corefinement.h"

namespace fusee::solid {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using IsCut = SurfaceMesh::Property_map<SurfaceMesh::Edge_index, bool>;

// Empty if a vertex or an edge belongs to several sheets.
std::optional<SurfaceMesh> surface_of(const TriangleMesh& mesh) {
  SurfaceMesh surface;
  surface.reserve(mesh.vertices.size(), 3 * mesh.triangles.size() / 2, mesh.triangles.size());
  for (const Vec3& vertex : mesh.vertices) surface.add_vertex({vertex.x(), vertex.y(), vertex.z()});
  using Vertex = SurfaceMesh::Vertex_index;
  for (const auto& [a, b, c] : mesh.triangles) {
    if (surface.add_face(Vertex(a), Vertex(b), Vertex(c)) == SurfaceMesh::null_face()) return std::nullopt;
  }
  return surface;
}

// Groups of connected facets that the cut line does not separate.
std::vector<std::vector<SurfaceMesh::Face_index>> patches_in(const SurfaceMesh& surface, const IsCut& is_cut) {
  std::vector<std::vector<SurfaceMesh::Face_index>> patches;
  std::vector<bool> seen(surface.num_faces(), false);
  for (const auto seed : surface.faces()) {
    if (seen[seed]) continue;
    seen[seed] = true;
    std::vector<SurfaceMesh::Face_index>& patch = patches.emplace_back(1, seed);
    for (std::size_t k = 0; k < patch.size(); ++k) {
      for (const auto side : surface.halfedges_around_face(surface.halfedge(patch[k]))) {
        const auto beyond = surface.face(surface.opposite(side));
        if (beyond == SurfaceMesh::null_face() || is_cut[surface.edge(side)] || seen[beyond]) continue;
        seen[beyond] = true;
        patch.push_back(beyond);
      }
    }
  }
  return patches;
}

// Vertices are identified by position only: each patch has its own copies.
std::vector<TriangleMesh> patches_of(const SurfaceMesh& surface, const IsCut& is_cut) {
  std::vector<TriangleMesh> meshes;
  for (const auto& patch : patches_in(surface, is_cut)) {
    TriangleMesh& mesh = meshes.emplace_back();
    mesh.triangles.reserve(patch.size());
    mesh.vertices.reserve(3 * patch.size());
    for (const auto face : patch) {
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      for (const auto vertex : surface.vertices_around_face(surface.halfedge(face))) {
        const auto& point = surface.point(vertex);
        mesh.vertices.emplace_back(point.x(), point.y(), point.z());
      }
      mesh.triangles.push_back({first, first + 1, first + 2});
    }
  }
  return meshes;
}

}  // namespace

std::optional<CorefinedPair> corefined(const TriangleMesh& a, const TriangleMesh& b) {
  // CGAL's box search draws from its default generator. A fixed seed gives the same order of vertices every time.
  CGAL::get_default_random() = CGAL::Random(0);
  std::optional<SurfaceMesh> first = surface_of(a), second = surface_of(b);
  if (!first || !second) return std::nullopt;
  IsCut cut_first = first->add_property_map<SurfaceMesh::Edge_index, bool>("e:cut", false).first;
  IsCut cut_second = second->add_property_map<SurfaceMesh::Edge_index, bool>("e:cut", false).first;
  pmp::corefine(*first, *second, CGAL::parameters::edge_is_constrained_map(cut_first),
                CGAL::parameters::edge_is_constrained_map(cut_second));
  first->collect_garbage();
  second->collect_garbage();
  return CorefinedPair{patches_of(*first, cut_first), patches_of(*second, cut_second)};
}

}  // namespace fusee::solid
