#include <gtest/gtest.h>

#include <locale>

#include "mesh_samples.h"

namespace fusee::formats {
namespace {

using ::testing::ElementsAre;
using testing::error_of;
using testing::facets;
using ::testing::HasSubstr;
using Triangle = std::array<std::uint32_t, 3>;

constexpr std::string_view k_square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(Obj, RoundTripIsExactInFloats) {
  const solid::TriangleMesh mesh = testing::torus();
  const solid::TriangleMesh read = solid::rounded_to_float(read_mesh(obj_text(mesh, "torus"), "torus.obj"));
  EXPECT_EQ(read.vertices, mesh.vertices);
  EXPECT_EQ(read.triangles, mesh.triangles);
}

// A reader that uses doubles computes the volume of the STL.
TEST(Obj, VolumeMatchesFloats) {
  solid::TriangleMesh mesh = testing::torus();
  for (Vec3& vertex : mesh.vertices) vertex = 31.7 * vertex + Vec3(0, 0, 37.9);
  mesh = solid::rounded_to_float(mesh);
  const double volume = solid::enclosed_volume(mesh);
  EXPECT_NEAR(solid::enclosed_volume(read_mesh(obj_text(mesh, "torus"), "torus.obj")), volume, 2e-8 * volume);
}

TEST(Obj, NamesItsObjectAndWritesNineDigits) {
  const solid::TriangleMesh mesh{{{0.1, -0.0, 1e-7}, {16777216, 0, 0}, {0, 1.0 / 3.0, 0}}, {{0, 1, 2}}};
  const std::string text = obj_text(mesh, "a\nname");
  EXPECT_THAT(
      text, HasSubstr("\no a\\x0aname\nv 0.100000001 0 1.00000001e-07\nv 16777216 0 0\nv 0 0.333333343 0\nf 1 2 3\n"));
  EXPECT_THAT(text, HasSubstr("unit mm"));
}

TEST(Obj, NameEndsItsLine) {
  const solid::TriangleMesh mesh = testing::torus();
  for (const char* name : {"a \\", "\\", "a\\\n", "# \\"}) {
    const std::string text = obj_text(mesh, name);
    EXPECT_THAT(text, Not(HasSubstr("\\\n"))) << name;
    EXPECT_EQ(read_mesh(text, "x.obj").vertices.size(), mesh.vertices.size()) << name;
  }
}

TEST(Obj, RejectsFaceWithVertexThrice) {
  EXPECT_EQ(read_mesh(std::string(k_square) + "f 1 2 3 4 4 3 2 1\n", "x.obj").triangles.size(), 6U);
  std::string face = "f";
  for (int i = 0; i < 5'000'000; ++i) face += i % 3 == 0 ? " 1" : i % 3 == 1 ? " 2" : " 3";
  EXPECT_THAT(error_of(std::string(k_square) + face + "\n", "x.obj"), HasSubstr("x.obj:5:"));
  EXPECT_THAT(error_of(std::string(k_square) + "f 1 2 3 1 2 3 1\n", "x.obj"),
              HasSubstr("expected a face that has a vertex at most twice"));
  EXPECT_THAT(error_of("OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n7 0 1 2 0 1 2 0\n", "x.off"),
              HasSubstr("expected a face that has a vertex at most twice"));
  EXPECT_THAT(error_of("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                       "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n"
                       "7 0 1 2 0 1 2 0\n",
                       "x.ply"),
              HasSubstr("expected a face that has a vertex at most twice"));
}

// 5000 faces of 35 facets each exceed the 100 000 that are always allowed, plus one for each 6 bytes of the file.
TEST(Obj, BoundsFacetsByFileSize) {
  std::string face = "f", faces;
  for (int i = 0; i < 36; ++i) face += i % 2 == 0 ? " 1" : " 2";
  for (int i = 0; i < 5000; ++i) faces += face + " 38\n";
  std::string vertices = "v 1 0 0\n";
  for (int i = 1; i < 38; ++i) vertices += "v 0 1 0\n";
  EXPECT_THAT(error_of(vertices + faces, "x.obj"), HasSubstr("expected no more than 1"));
}

TEST(ObjReader, FansPolygonsAndCountsNegativeIndices) {
  EXPECT_THAT(read_mesh(std::string(k_square) + "f 1 2 3 4\n", "x.obj").triangles,
              ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
  EXPECT_THAT(read_mesh(std::string(k_square) + "f -4 -3 -2\n", "x.obj").triangles, ElementsAre(Triangle{0, 1, 2}));
  // The fourth, the first and the third; the second is skipped.
  EXPECT_THAT(read_mesh(std::string(k_square) + "f -1//-1 +1/7 -2/1/1\n", "x.obj").triangles,
              ElementsAre(Triangle{2, 0, 1}));
}

TEST(ObjReader, SkipsOtherStatements) {
  const std::string text =
      "\xEF\xBB\xBF# made by hand\r\nmtllib a.mtl\r\n\r\ng all\r\nvn 0 0 1\r\nvt 0 0\r\nv 0 0 0 1 0.5 0.5 0.5 # "
      "coloured\r\nv 1 0 0\r\n"
      "usemtl red\r\ns off\r\nf 1/1/1 2/1/1 \\\r\n 3/1/1\r\nv 1 1 nan\r\nl 1 2\r\n";
  const solid::TriangleMesh mesh = read_mesh(text, "x");
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
  EXPECT_TRUE(std::isnan(mesh.vertices[2].z()));
}

TEST(ObjReader, LinesAndPointsAreNoFacets) {
  EXPECT_THAT(read_mesh(std::string(k_square) + "f 1 2\nf 3\nf 1 2 3\n", "x.obj").triangles,
              ElementsAre(Triangle{0, 1, 2}));
}

TEST(ObjReader, ContinuesStatementsAfterBackslash) {
  for (const char* face : {"f 1 2 \\\n3 4\n", "f 1 2\\\n 3 4\n", "f 1 \\\n\\\n2 3 4\n"})
    EXPECT_THAT(read_mesh(std::string(k_square) + face, "x.obj").triangles,
                ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}))
        << face;
  EXPECT_EQ(read_mesh("v 1 \\\n2\\\n 3\nv 0 0 0\nv 0 1 0\nf 1 2 3\n", "x.obj").vertices[0], Vec3(1, 2, 3));
}

TEST(ObjReader, LinesMayEndWithCarriageReturnsAlone) {
  EXPECT_THAT(read_mesh(testing::with_cr("# by hand\n" + std::string(k_square) + "f 1 2 3 4\n"), "x.obj").triangles,
              ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
}

TEST(ObjReader, ErrorsNameThePlace) {
  EXPECT_EQ(error_of("v 0 0\n", "x.obj"), "x.obj:1:6: error: expected a coordinate of a vertex, the file ends here");
  EXPECT_EQ(error_of("v 0 0\nv 1 1 1\n", "x.obj"),
            "x.obj:1:6: error: expected a coordinate of a vertex, the line ends here");
  EXPECT_THAT(error_of("v 0 0,5 1\n", "x.obj"),
              HasSubstr("x.obj:1:5: error: expected a coordinate of a vertex, found '0,5'"));
  const std::string square(k_square);
  EXPECT_EQ(error_of(square + "f 1 2 9\nf 1 2 5\n", "x.obj"),
            "x.obj:5:7: error: a face refers to vertex 9, but the file has 4");
  EXPECT_THAT(error_of(square + "f 1 2 0\n", "x.obj"), HasSubstr("x.obj:5:7: error: expected a vertex number"));
  EXPECT_THAT(error_of(square + "f 1 2 -5\n", "x.obj"), HasSubstr("with 4 vertices before it, found '-5'"));
  EXPECT_THAT(error_of(square + "f 1 2 99999999999\n", "x.obj"),
              HasSubstr("x.obj:5:7: error: expected a vertex number"));
  EXPECT_THAT(error_of(square + "f\n", "x.obj"), HasSubstr("x.obj:5:2: error: expected a face of at least 1 corner"));
  EXPECT_THAT(error_of(square + "face 1 2 3\n", "x.obj"), HasSubstr("x.obj:5:1: error: expected an OBJ statement"));
  EXPECT_THAT(error_of(std::string("v 0 0 0\nv \x01\xFF 0 0\n"), "x.obj"), HasSubstr("found '\\x01\\xff'"));
}

TEST(ObjReader, ReadsOrRejectsTruncations) {
  testing::meshes_among_truncations(std::string(k_square) + "f 1 2 \\\n 3 4\n", "x.obj");
}

/// A decimal comma, as half the world's locales have it.
struct CommaPoint : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
};

TEST(Obj, IsIndependentOfLocale) {
  const std::string before = obj_text(testing::torus(), "x");
  const std::locale old = std::locale::global(std::locale(std::locale::classic(), new CommaPoint));
  const std::string after = obj_text(testing::torus(), "x");
  const solid::TriangleMesh read = read_mesh(after, "x.obj");
  std::locale::global(old);
  EXPECT_EQ(after, before);
  EXPECT_EQ(facets(read), facets(testing::torus()));
}

}  // namespace
}  // namespace fusee::formats
