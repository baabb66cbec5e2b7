/// \file
/// A triangle mesh as plain values, and measurements of it. mm.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fusee/base/check.h"
#include "fusee/base/plane.h"

namespace fusee {

/// Indexed triangles, counter-clockwise seen from outside. A mesh read from a file may have any defect.
struct TriangleMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// By the divergence theorem; positive when the faces look outward. Indices must be in range. mm³.
double enclosed_volume(const TriangleMesh& mesh);
struct Bounds {
  Vec3 low, high;
};
Bounds bounds(const TriangleMesh& mesh);
/// One index for each distinct position (exact equality), with triangles renumbered. Topology checks require a welded
/// mesh.
TriangleMesh weld(const TriangleMesh& mesh);
/// Welds the mesh and removes facets with two equal corners, which rounding of very short edges produces.
TriangleMesh without_collapsed_facets(const TriangleMesh& mesh);
/// Rounds every coordinate to the nearest float, as every mesh format stores it.
TriangleMesh rounded_to_float(TriangleMesh mesh);

/// Checks that a mesh is a solid: finite, indices in range, closed, 2-manifold (edges and vertices), outward, no
/// degenerate or duplicate face, no self-intersection. One Check each, with `where` naming the first faulty facet and
/// its place. Checks that an earlier fault makes impossible are reported as failed, with the reason in `where`.
std::vector<Check> check_mesh(const TriangleMesh& mesh);

/// Closed section at height z as loops: outer ones counter-clockwise, holes clockwise. Empty when the plane misses the
/// mesh.
std::vector<Polygon> section(const TriangleMesh& mesh, double z);
/// The groove floor in a section: its loop of largest area. Throws InputError when there is none.
Polygon outer_loop(const std::vector<Polygon>& loops);

}  // namespace fusee
