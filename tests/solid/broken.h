/// \file
/// Simple solids, and functions that damage them.
#pragma once

#include <stdexcept>
#include <string>

#include "fusee/solid.h"

namespace fusee::testing {

/// [x0, x0 + side]³, outward: 12 facets.
inline solid::TriangleMesh cube(double side, const Vec3& corner = Vec3::Zero()) {
  solid::TriangleMesh mesh;
  for (int k = 0; k < 8; ++k) mesh.vertices.push_back(corner + side * Vec3(k & 1, (k >> 1) & 1, (k >> 2) & 1));
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

inline solid::TriangleMesh turned_inside_out(solid::TriangleMesh mesh) {
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh;
}

inline solid::TriangleMesh joined(solid::TriangleMesh a, const solid::TriangleMesh& b) {
  const auto first = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& [i, j, k] : b.triangles) a.triangles.push_back({first + i, first + j, first + k});
  return a;
}

/// Names of the failed checks in order, separated by blanks.
inline std::string failed(const std::vector<Check>& checks) {
  std::string names;
  for (const Check& check : checks) {
    if (!check.ok) names += (names.empty() ? "" : " ") + check.name;
  }
  return names;
}

inline const Check& check_named(const std::vector<Check>& checks, const std::string& name) {
  for (const Check& check : checks) {
    if (check.name == name) return check;
  }
  throw std::out_of_range("no check named " + name);
}

}  // namespace fusee::testing
