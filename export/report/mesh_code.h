/// \file
/// A triangle mesh small enough to stand inside a page: 16-bit positions, differences, base64. viewer.js is the reader.
#pragma once

#include <optional>
#include <string>

#include "fusee/solid/mesh.h"

namespace fusee {

/// Every triangle of the mesh, in order. Positions are rounded to `step`: at most step/2 in each coordinate.
///
/// bytes: for each corner a varint `newest − index`, where `newest` is the number of vertices met so far; 0 is a new
/// vertex, and three zigzag varints follow: its coordinates less those of the vertex met before, in steps.
struct MeshCode {
  std::string base64;
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  Vec3 low{0, 0, 0};
  double step = 0;  ///< mm
};

/// Nothing for a mesh that is empty or broken (an index out of range, a number that is not finite).
std::optional<MeshCode> encode_mesh(const TriangleMesh& mesh);

}  // namespace fusee
