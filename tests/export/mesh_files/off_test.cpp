#include <gtest/gtest.h>

#include <algorithm>

#include "mesh_samples.h"

namespace fusee::formats {
namespace {

using ::testing::ElementsAre;
using testing::error_of;
using ::testing::HasSubstr;
using Triangle = std::array<std::uint32_t, 3>;

TEST(OffReader, ReadsAllKindsOfVerticesAndFaces) {
  const std::string plain = "OFF\n# a square\n4 1 4\n0 0 0\n1 0 0\n1 1 0\n\n0 1 0\n4 0 1 2 3\n";
  const solid::TriangleMesh square = read_mesh(plain, "x");
  EXPECT_THAT(square.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
  EXPECT_EQ(square.vertices[2], Vec3(1, 1, 0));
  const std::string coloured =
      "COFF 3 1 0\r\n0 0 0 255 0 0 255\r\n1 0 0 0 255 0 255\r\n1 1 0 0 0 255 255\r\n3 0 1 2 0.5 0.5 0.5";
  EXPECT_THAT(read_mesh(coloured, "x").triangles, ElementsAre(Triangle{0, 1, 2}));
  const std::string normals = "NOFF\n3 1\n0 0 0 0 0 1\n1 0 0 0 0 1\n1 1 0 0 0 1\n3 2 1 0 7\n";
  EXPECT_THAT(read_mesh(normals, "x").triangles, ElementsAre(Triangle{2, 1, 0}));
  // Without the keyword only the name identifies the format.
  EXPECT_THAT(read_mesh(plain.substr(4), "x.OFF").triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
}

TEST(OffReader, CountsWordsNotLines) {
  const std::string plain = "OFF\n4 2 5\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
  const auto expected = read_mesh(plain, "x.off").triangles;
  ASSERT_EQ(expected.size(), 2U);
  std::string line = plain, words = plain;
  std::replace(line.begin(), line.end(), '\n', ' ');
  std::replace(words.begin(), words.end(), ' ', '\n');
  for (const std::string& text :
       {line, words, testing::with_cr(plain), std::string("OFF\n4 2 5\n0 0 0 1 0 0\n1 1 0 0 1 0\n3 0 1\n2\n3 0 2\n3\n"),
        std::string("OFF\n4\n2\n5\n0 0\n0 1 0 0 1\n1 0 0 1 0 3 0 1 2 3 0 2 3"),
        std::string("CNOFF 4 2 5 0 0 0 9 9 9 9 0 0 1 1 0 0 9 9 9 9 0 0 1 1 1 0 9 9 9 9 0 0 1 0 1 0 9 9 9 9 0 0 1 3 0 1 "
                    "2 3 0 2 3"),
        std::string("OFF4 2 5\n") + plain.substr(10), std::string("off\n") + plain.substr(4),
        // A colour that the keyword does not declare, and one of three numbers where four are declared.
        std::string("OFF\n4 2 5\n0 0 0 255 0 0\n1 0 0 255 0 0\n1 1 0 255 0 0\n0 1 0 255 0 0\n3 0 1 2 1 0 0\n3 0 2 3\n"),
        std::string("COFF\n4 2 5\n0 0 0 255 0 0\n1 0 0 255 0 0\n1 1 0 255 0 0\n0 1 0 255 0 0\n3 0 1 2\n3 0 2 3\n")}) {
    const solid::TriangleMesh mesh = read_mesh(text, "x.off");
    EXPECT_EQ(mesh.triangles, expected) << text;
    EXPECT_EQ(mesh.vertices[2], Vec3(1, 1, 0)) << text;
  }
}

TEST(OffReader, LinesAndPointsAreNoFacets) {
  const std::string text = "OFF\n3 3 0\n0 0 0\n1 0 0\n1 1 0\n2 0 1\n1 2\n3 0 1 2\n";
  EXPECT_THAT(read_mesh(text, "x.off").triangles, ElementsAre(Triangle{0, 1, 2}));
}

TEST(OffReader, ErrorsNameThePlace) {
  EXPECT_EQ(error_of("OFF\n3 one 0\n", "x.off"), "x.off:2:3: error: expected the number of faces, found 'one'");
  EXPECT_THAT(error_of("OFF\n-3 1 0\n", "x.off"), HasSubstr("expected the number of vertices, found '-3'"));
  // Words are counted: a missing one is detected at the end.
  EXPECT_EQ(error_of("OFF\n3 1 0\n0 0 0\n1 0\n1 1 0\n3 0 1 2\n", "x.off"),
            "x.off:6:3: error: expected a face of at least 1 corner, found '0'");
  EXPECT_THAT(error_of("OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n3 0 1 3\n", "x.off"),
              HasSubstr("x.off:6:7: error: expected a vertex number below 3, found '3'"));
  EXPECT_THAT(error_of("OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n0 0 1 2\n", "x.off"),
              HasSubstr("expected a face of at least 1 corner"));
  EXPECT_THAT(error_of("OFF\n3 2 0\n0 0 0\n1 0 0\n1 1 0\n3 0 1 2\n", "x.off"),
              HasSubstr("expected a face, the file ends here"));
  EXPECT_THAT(error_of("OFF BINARY\n", "x.off"), HasSubstr("expected an OFF file in text"));
  EXPECT_THAT(error_of("4OFF\n1 1 1\n", "x.off"), HasSubstr("three dimensions"));
}

TEST(OffReader, BoundsAllocation) {
  EXPECT_THAT(error_of("OFF\n4000000000 1 0\n0 0 0\n", "x.off"),
              HasSubstr("at byte 18: expected 4000000000 vertices of at least 5 bytes each, but only 7 bytes follow"));
  EXPECT_THAT(error_of("OFF\n1 9223372036854775807 0\n0 0 0\n", "x.off"),
              HasSubstr("expected 9223372036854775807 faces"));
}

TEST(OffReader, ReadsOrRejectsTruncations) {
  // Only the end of the last face's colour may be cut off: one to five bytes of " 9 9\n".
  EXPECT_EQ(testing::meshes_among_truncations("OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n3 0 1 2 9 9\n", "x.off"), 5);
}

}  // namespace
}  // namespace fusee::formats
