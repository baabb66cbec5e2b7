/// \file
/// A triangle mesh as plain values, and what is measured on it. mm.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fusee/base/check.h"
#include "fusee/base/plane.h"

namespace fusee {

/// Indexed triangles, counter-clockwise seen from outside. May be broken in any way when it comes from a file.
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
/// One index per distinct position (exact equality), triangles renumbered: what a soup of facets needs before its
/// topology is looked at.
TriangleMesh weld(const TriangleMesh& mesh);
/// Welded, without the facets of which two corners are one: rounding makes the ends of very short edges so.
TriangleMesh without_collapsed_facets(const TriangleMesh& mesh);
/// Every coordinate rounded to the nearest float, as every mesh format will hold it.
TriangleMesh rounded_to_float(TriangleMesh mesh);

/// Is it a solid? Finite, indices in range, closed, 2-manifold (edges and vertices), outward, no degenerate or
/// duplicate face, no self-intersection: one Check each, `where` naming the first faulty facet and its place. The
/// checks later in the list that cannot be answered because of an earlier fault are reported failed with the reason in
/// `where`.
std::vector<Check> check_mesh(const TriangleMesh& mesh);

/// Closed section at height z: loops of the cut, outer ones counter-clockwise, holes clockwise. Empty when the plane
/// misses.
std::vector<Polygon> section(const TriangleMesh& mesh, double z);
/// The groove floor in a section: its loop of largest area. InputError when there is none.
Polygon outer_loop(const std::vector<Polygon>& loops);

}  // namespace fusee
