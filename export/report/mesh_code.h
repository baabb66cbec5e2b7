/// \file
/// Internal: a compact triangle mesh for a page: 16-bit positions, differences, base64. viewer.js reads it.
#pragma once

#include <optional>
#include <string>

#include "fusee/solid.h"

namespace fusee::formats {

/// Every triangle of a mesh, in order. Positions are rounded to `step`, with an error of at most step/2 in each
/// coordinate.
///
/// The encoded bytes have a varint `newest − index` for each corner, where `newest` is the number of vertices so far. 0
/// is a new vertex, followed by three zigzag varints: its coordinates minus those of the previous vertex, in steps.
struct MeshCode {
  std::string base64;  ///< the encoded bytes
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  Vec3 low{0, 0, 0};  ///< corner of the bounding box from which steps count, mm
  double step = 0;    ///< mm
};

/// Empty for a mesh that is empty or invalid (an index out of range, a number that is not finite).
std::optional<MeshCode> encode_mesh(const solid::TriangleMesh& mesh);

}  // namespace fusee::formats
