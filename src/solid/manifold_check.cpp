#include "solid/manifold_check.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <string>

#include "fusee/base.h"

namespace fusee::solid {
namespace {

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};
using HalfEdges = OpenMesh::TriMesh_ArrayKernelT<Traits>;

}  // namespace

// add_face() rejects an edge with more than two faces, and a face that splits a vertex's neighbourhood.
void demand_solid(const TriangleMesh& mesh, const char* what) {
  HalfEdges half_edges;
  half_edges.reserve(mesh.vertices.size(), 3 * mesh.triangles.size() / 2, mesh.triangles.size());
  for (const Vec3& vertex : mesh.vertices) half_edges.add_vertex({vertex.x(), vertex.y(), vertex.z()});
  const auto handle = [](std::uint32_t index) { return HalfEdges::VertexHandle(static_cast<int>(index)); };
  for (const auto& [a, b, c] : mesh.triangles) {
    demand(half_edges.add_face(handle(a), handle(b), handle(c)).is_valid(),
           std::string(what) + ": complex edge at facet " + std::to_string(half_edges.n_faces()));
  }
  for (const auto vertex : half_edges.vertices()) {
    demand(!half_edges.is_boundary(vertex) && half_edges.is_manifold(vertex),
           std::string(what) + ": open at vertex " + std::to_string(vertex.idx()));
  }
}

}  // namespace fusee::solid
