#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_data_structure_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include "fusee/base.h"
#include "solid/caps.h"

namespace fusee::solid {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
struct FaceState {
  bool seen = false;
  bool inside = false;
};
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using FaceBase =
    CGAL::Constrained_triangulation_face_base_2<Kernel, CGAL::Triangulation_face_base_with_info_2<FaceState, Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::No_constraint_intersection_tag>;

void insert_loop(Triangulation& triangulation, const Polygon& loop, std::uint32_t first) {
  std::vector<Triangulation::Vertex_handle> handles;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    auto handle = triangulation.insert({loop[i].x(), loop[i].y()},
                                       handles.empty() ? Triangulation::Face_handle() : handles.back()->face());
    handle->info() = first + static_cast<std::uint32_t>(i);
    handles.push_back(handle);
  }
  // Checked before constraints are inserted: CGAL fails on a constraint from a point to itself.
  demand(triangulation.number_of_vertices() == first + loop.size(), "a flat face has coinciding corners");
  for (std::size_t i = 0; i < handles.size(); ++i)
    triangulation.insert_constraint(handles[i], handles[(i + 1) % handles.size()]);
}

// Flood fill from outside. Across a constraint, a loop's edge, inside becomes outside and the reverse.
void mark_inside(Triangulation& triangulation) {
  std::vector<Triangulation::Face_handle> front{triangulation.infinite_face()};
  triangulation.infinite_face()->info().seen = true;
  while (!front.empty()) {
    const auto face = front.back();
    front.pop_back();
    for (int side = 0; side < 3; ++side) {
      const auto next = face->neighbor(side);
      if (next->info().seen) continue;
      next->info().seen = true;
      next->info().inside = face->info().inside != triangulation.is_constrained({face, side});
      front.push_back(next);
    }
  }
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate(const std::vector<Polygon>& loops,
                                                      const std::vector<Vec2>& inner) {
  Triangulation triangulation;
  std::uint32_t count = 0;
  for (const Polygon& loop : loops) {
    insert_loop(triangulation, loop, count);
    count += static_cast<std::uint32_t>(loop.size());
  }
  for (const Vec2& point : inner) triangulation.insert({point.x(), point.y()})->info() = count++;
  demand(triangulation.number_of_vertices() == count, "a flat face has coinciding corners");
  mark_inside(triangulation);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const auto face : triangulation.finite_face_handles()) {
    if (face->info().inside)
      triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  }
  return triangles;
}

}  // namespace fusee::solid
