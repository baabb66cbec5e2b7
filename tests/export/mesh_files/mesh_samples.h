/// \file
/// Meshes of known shape, and helpers for tests of the formats.
#pragma once

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>
#include <string_view>

#include "export/mesh_files/mesh_files.h"
#include "fusee/base.h"

namespace fusee::testing {

inline solid::TriangleMesh tetrahedron() {
  return {{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {0, 0, 5}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

/// Coordinates without short decimals, rounded to floats.
inline solid::TriangleMesh torus(int around = 40, int across = 24) {
  solid::TriangleMesh mesh;
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>((i % around) * across + j % across); };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double u = k_two_pi * i / around, v = k_two_pi * j / across;
      const double r = 20 + 6 * std::cos(v);
      mesh.vertices.emplace_back(r * std::cos(u), r * std::sin(u), 6 * std::sin(v));
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return solid::rounded_to_float(std::move(mesh));
}

/// The corners of the faces in order, as floats: equal for equal meshes with any vertex numbering.
inline std::vector<std::array<std::array<float, 3>, 3>> facets(const solid::TriangleMesh& mesh) {
  std::vector<std::array<std::array<float, 3>, 3>> list;
  for (const auto& t : mesh.triangles) {
    auto& facet = list.emplace_back();
    for (int k = 0; k < 3; ++k) {
      for (int c = 0; c < 3; ++c) facet[k][c] = static_cast<float>(mesh.vertices.at(t[k])[c]);
    }
  }
  return list;
}

/// The error message for bytes that are no mesh; "" if they are one.
inline std::string error_of(std::string_view bytes, const std::string& name) {
  try {
    formats::read_mesh(bytes, name);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

/// Text as an old Macintosh has it: lines end with \r alone.
inline std::string with_cr(std::string_view text) {
  std::string changed;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n') continue;
    changed += text[i] == '\n' ? '\r' : text[i];
  }
  return changed;
}

/// Truncates `bytes` at every place: each piece is a mesh or an InputError. Returns the number of meshes.
inline int meshes_among_truncations(std::string_view bytes, const std::string& name) {
  int meshes = 0;
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    // A copy of exactly this size, so that a sanitizer detects an access beyond its end.
    const std::string piece(bytes.substr(0, size));
    if (error_of(piece, name).empty()) ++meshes;
  }
  return meshes;
}

}  // namespace fusee::testing
