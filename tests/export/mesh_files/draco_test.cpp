#include <gtest/gtest.h>

#include <algorithm>

#include "mesh_samples.h"

namespace fusee::formats {
namespace {

using testing::error_of;
using ::testing::HasSubstr;

double distance_to_nearest(const Vec3& place, const solid::TriangleMesh& mesh) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vec3& vertex : mesh.vertices) nearest = std::min(nearest, (vertex - place).norm());
  return nearest;
}

TEST(Draco, MovesVerticesWithinTolerance) {
  const solid::TriangleMesh mesh = testing::torus();
  std::size_t larger = std::numeric_limits<std::size_t>::max();
  for (const double tolerance : {0.001, 0.01, 0.1}) {
    const std::string bytes = draco_bytes(mesh, tolerance);
    EXPECT_LT(bytes.size(), larger) << "a coarser tolerance gives a smaller file";
    larger = bytes.size();
    const solid::TriangleMesh read = read_mesh(bytes, "torus.drc");
    ASSERT_EQ(read.vertices.size(), mesh.vertices.size());
    ASSERT_EQ(read.triangles.size(), mesh.triangles.size());
    for (const Vec3& vertex : mesh.vertices) EXPECT_LE(distance_to_nearest(vertex, read), tolerance);
    // The bound is below tolerance times the torus's area, 4 π² · 20 mm · 6 mm = 4737 mm².
    EXPECT_NEAR(solid::enclosed_volume(read), solid::enclosed_volume(mesh), 3000 * tolerance);
  }
}

TEST(Draco, KeepsThinFaces) {
  // A flat tetrahedron, 0.001 mm thick: on a grid of 0.01 mm its faces would coincide.
  solid::TriangleMesh needle = testing::tetrahedron();
  for (Vec3& vertex : needle.vertices) vertex.y() *= 0.00025;
  const solid::TriangleMesh read = read_mesh(draco_bytes(solid::rounded_to_float(needle), 0.01), "needle.drc");
  EXPECT_EQ(read.vertices.size(), 4U);
  EXPECT_NEAR(solid::enclosed_volume(read) / solid::enclosed_volume(needle), 1.0, 0.5);
}

TEST(Draco, KeepsFloatsOfVeryFineMesh) {
  // A small part far from a large one: even the finest of Draco's grids, 24 bits of a kilometre, is too coarse.
  solid::TriangleMesh small = testing::tetrahedron(), large = testing::tetrahedron();
  for (Vec3& vertex : small.vertices) vertex *= 1e-6;
  for (Vec3& vertex : large.vertices) vertex = 1e5 * vertex + Vec3(1e3, 1e3, 1e3);
  solid::TriangleMesh both = small;
  both.vertices.insert(both.vertices.end(), large.vertices.begin(), large.vertices.end());
  for (const auto& [a, b, c] : large.triangles) both.triangles.push_back({a + 4, b + 4, c + 4});
  both = solid::rounded_to_float(std::move(both));
  const solid::TriangleMesh read = read_mesh(draco_bytes(both, 0.01), "both.drc");
  ASSERT_EQ(read.vertices.size(), both.vertices.size());
  for (const Vec3& vertex : both.vertices) EXPECT_EQ(distance_to_nearest(vertex, read), 0.0);
}

TEST(Draco, IsDeterministic) { EXPECT_EQ(draco_bytes(testing::torus(), 0.01), draco_bytes(testing::torus(), 0.01)); }

TEST(DracoReader, ReportsErrors) {
  std::string bytes = draco_bytes(testing::tetrahedron(), 0.01);
  EXPECT_THAT(error_of("DRACO", "x.drc"), HasSubstr("x.drc: error: at byte 0: expected a Draco header"));
  std::string other = bytes;
  other[6] = 9;
  EXPECT_THAT(error_of(other, "x.drc"), HasSubstr("at byte 5: expected Draco's bitstream 2.2, found 2.9"));
  other = bytes;
  other[7] = 0;
  EXPECT_THAT(error_of(other, "x.drc"), HasSubstr("at byte 7: expected a mesh, found a cloud of points"));
  other = bytes;
  other[8] = 5;
  EXPECT_THAT(error_of(other, "x.drc"), HasSubstr("at byte 8: expected Draco's method 0 or 1, found 5"));
  EXPECT_THAT(error_of(bytes.substr(0, bytes.size() / 2), "x.drc"), HasSubstr("Draco cannot decode this"));
}

TEST(DracoReader, BoundsAllocation) {
  // Header 2.2, mesh, method 0 (sequential); 1 210 662 faces and as many points, in 23 bytes; entropy-coded indices.
  const std::string bomb("DRACO\x02\x02\x01\x00\x00\x00\xA6\xF2\xC9\x80\x00\xA6\xF2\xC9\x80\x00\x00\x01", 23);
  EXPECT_THAT(error_of(bomb, "x.drc"), HasSubstr("Draco cannot decode this"));
}

TEST(DracoReader, RejectsTruncations) {
  EXPECT_EQ(testing::meshes_among_truncations(draco_bytes(testing::tetrahedron(), 0.01), "x.drc"), 0);
}

}  // namespace
}  // namespace fusee::formats
