// Any bytes as the outline of a closed, upright solid, written as Draco within any tolerance. It must read as the same
// solid, with equal faces and all vertices within the tolerance. fuzz_mesh covers the reader. The first three bytes
// select scale, height and tolerance, each further byte is a radius.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "export/mesh_files/mesh_files.h"
#include "fusee/solid.h"

namespace {

using fusee::Vec3;
using fusee::solid::TriangleMesh;

constexpr std::size_t k_most_corners = 64;

/// A star-shaped prism: rings of corners below and above, both around the axis.
TriangleMesh prism(const std::vector<double>& radii, double height) {
  TriangleMesh mesh;
  const auto count = static_cast<std::uint32_t>(radii.size());
  for (const double z : {0.0, height}) {
    for (std::uint32_t i = 0; i < count; ++i) {
      const double turn = 2 * std::numbers::pi * i / count;
      mesh.vertices.emplace_back(radii[i] * std::cos(turn), radii[i] * std::sin(turn), z);
    }
  }
  mesh.vertices.emplace_back(0, 0, 0);
  mesh.vertices.emplace_back(0, 0, height);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t next = (i + 1) % count;
    mesh.triangles.push_back({2 * count, next, i});
    mesh.triangles.push_back({2 * count + 1, count + i, count + next});
    mesh.triangles.push_back({i, next, count + next});
    mesh.triangles.push_back({i, count + next, count + i});
  }
  return fusee::solid::rounded_to_float(std::move(mesh));
}

bool is_solid(const TriangleMesh& mesh) {
  const std::vector<fusee::Check> checks = fusee::solid::check_mesh(mesh);
  return std::all_of(checks.begin(), checks.end(), [](const fusee::Check& check) { return check.ok; });
}

/// True if each vertex of `one` has a vertex of `other` within `reach`.
bool lies_within(const TriangleMesh& one, const TriangleMesh& other, double reach) {
  return std::all_of(one.vertices.begin(), one.vertices.end(), [&](const Vec3& vertex) {
    return std::any_of(other.vertices.begin(), other.vertices.end(),
                       [&](const Vec3& near) { return (near - vertex).norm() <= reach; });
  });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 6) return 0;
  const double scale = std::pow(10.0, data[0] % 8 - 4);
  const double height = scale * (1 + data[1]);
  const double tolerance = scale * std::pow(10.0, -(data[2] % 7));
  std::vector<double> radii;
  for (std::size_t i = 3; i < std::min(size, 3 + k_most_corners); ++i) radii.push_back(scale * (1 + data[i] / 16.0));
  const TriangleMesh mesh = prism(radii, height);
  if (!is_solid(mesh)) return 0;
  const TriangleMesh again = fusee::formats::read_mesh(fusee::formats::draco_bytes(mesh, tolerance), "fuzz.drc");
  const double largest_radius = 17 * scale;                           // 1 + 255/16, rounded up
  const double reach = tolerance + 1e-6 * (height + largest_radius);  // rounding of floats
  if (again.triangles.size() != mesh.triangles.size() || !is_solid(again)) std::abort();
  if (!lies_within(mesh, again, reach) || !lies_within(again, mesh, reach)) std::abort();
  return 0;
}
