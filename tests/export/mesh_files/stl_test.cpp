#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "mesh_samples.h"

namespace fusee::formats {
namespace {

using testing::error_of;
using testing::facets;
using ::testing::HasSubstr;

constexpr std::string_view k_ascii_facet =
    "facet normal 0 0 -1\n outer loop\n vertex 0 0 0\n vertex 0 4 0\n vertex 3 0 0\n endloop\nendfacet\n";

std::string ascii(std::string_view facets_text) {
  return "solid part\n" + std::string(facets_text) + "endsolid part\n";
}

float float_at(const std::string& bytes, std::size_t offset) {
  float value = 0;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

TEST(StlWriter, FollowsTheFormat) {
  const std::string bytes = stl_bytes(testing::tetrahedron(), "finger");
  ASSERT_EQ(bytes.size(), 84U + 4 * 50U);
  EXPECT_TRUE(bytes.starts_with("fusee "));
  EXPECT_THAT(bytes.substr(0, 80), HasSubstr("finger, unit mm"));
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, 4);
  EXPECT_EQ(count, 4U);
  // The first face is the bottom: its normal, then its corners (0 0 0) (0 4 0) (3 0 0), then no attribute.
  EXPECT_EQ(float_at(bytes, 84 + 8), -1.0F);
  EXPECT_EQ(float_at(bytes, 84 + 24 + 4), 4.0F);
  EXPECT_EQ(float_at(bytes, 84 + 36), 3.0F);
  EXPECT_EQ(bytes[84 + 48], 0);
  EXPECT_EQ(bytes[84 + 49], 0);
}

TEST(StlWriter, NormalsAreTrue) {
  const solid::TriangleMesh mesh = testing::torus();
  const std::string bytes = stl_bytes(mesh, "torus");
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    const Vec3 a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
    const Vec3 normal(float_at(bytes, 84 + 50 * i), float_at(bytes, 88 + 50 * i), float_at(bytes, 92 + 50 * i));
    EXPECT_NEAR(normal.norm(), 1.0, 1e-6);
    EXPECT_NEAR(normal.dot(b - a), 0.0, 1e-5);
    EXPECT_NEAR(normal.dot(c - a), 0.0, 1e-5);
    EXPECT_GT(normal.dot((b - a).cross(c - a)), 0.0);
  }
}

TEST(StlWriter, DegenerateFaceHasNoNormal) {
  const solid::TriangleMesh line{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}};
  const std::string bytes = stl_bytes(line, "line");
  for (int k = 0; k < 3; ++k) EXPECT_EQ(float_at(bytes, 84 + 4 * k), 0.0F);
}

bool has_high_byte(std::string_view bytes) {
  return std::any_of(bytes.begin(), bytes.end(), [](char c) { return static_cast<unsigned char>(c) > 127; });
}

TEST(StlWriter, IsNotMistakenForText) {
  // Upward facets whose numbers have only bytes below 128 (0, 2, 0.5), and finally a downward one.
  const solid::TriangleMesh mesh{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}},
                                 {{0, 1, 2}, {0, 1, 2}, {0, 1, 2}, {0, 1, 2}, {0, 2, 1}}};
  const solid::TriangleMesh flat{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 0.5}},
                                 {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {0, 2, 1}}};
  for (const solid::TriangleMesh& m : {mesh, flat, testing::tetrahedron(), testing::torus()}) {
    const std::string bytes = stl_bytes(m, "x");
    EXPECT_TRUE(has_high_byte(bytes.substr(84, 128)));
    std::vector<std::array<std::array<float, 3>, 3>> written = facets(read_mesh(bytes, "x.stl")), given = facets(m);
    std::sort(written.begin(), written.end());
    std::sort(given.begin(), given.end());
    EXPECT_EQ(written, given);
  }
}

TEST(StlWriter, NeverStartsWithSolidAndCutsLongNames) {
  const std::string bytes = stl_bytes(testing::tetrahedron(), std::string(500, 's') + "\n\xFF");
  EXPECT_TRUE(bytes.starts_with("fusee "));
  EXPECT_EQ(bytes.size(), 84U + 4 * 50U);
}

TEST(Stl, RoundTrip) {
  const solid::TriangleMesh mesh = testing::torus();
  const solid::TriangleMesh read = read_mesh(stl_bytes(mesh, "torus"), "torus.stl");
  EXPECT_EQ(read.vertices.size(), mesh.vertices.size());
  EXPECT_EQ(facets(read), facets(mesh));
}

TEST(Stl, AcceptsBinaryStartingWithSolid) {
  std::string bytes = stl_bytes(testing::tetrahedron(), "x");
  bytes.replace(0, 12, "solid part\nf");
  EXPECT_EQ(facets(read_mesh(bytes, "x.stl")), facets(testing::tetrahedron()));
}

TEST(Stl, ReadsNanAndInfinity) {
  solid::TriangleMesh mesh = testing::tetrahedron();
  mesh.vertices[3].z() = std::numeric_limits<double>::infinity();
  mesh.vertices[2].x() = std::numeric_limits<double>::quiet_NaN();
  const solid::TriangleMesh read = read_mesh(stl_bytes(mesh, "x"), "x.stl");
  EXPECT_EQ(read.triangles.size(), 4U);
  EXPECT_TRUE(std::any_of(read.vertices.begin(), read.vertices.end(), [](const Vec3& v) { return std::isinf(v.z()); }));
  EXPECT_TRUE(std::any_of(read.vertices.begin(), read.vertices.end(), [](const Vec3& v) { return std::isnan(v.x()); }));
}

TEST(StlAscii, ReadsVariants) {
  const solid::TriangleMesh plain = read_mesh(ascii(k_ascii_facet), "x.stl");
  ASSERT_EQ(plain.triangles.size(), 1U);
  EXPECT_EQ(plain.vertices[plain.triangles[0][1]], Vec3(0, 4, 0));
  const std::string shouted =
      "\xEF\xBB\xBFSOLID\r\nFACET NORMAL +0.0 0 -1E0\r\nOUTER LOOP\r\nVERTEX 0 0 0 VERTEX\r\n0 4. 0\r\nVERTEX 3e0 0 "
      "0\r\nENDLOOP ENDFACET\r\nENDSOLID";
  EXPECT_EQ(facets(read_mesh(shouted, "x")), facets(plain));
  // Several solids form one mesh, and their corners are welded.
  const solid::TriangleMesh twice = read_mesh(ascii(k_ascii_facet) + ascii(k_ascii_facet), "x.stl");
  EXPECT_EQ(twice.triangles.size(), 2U);
  EXPECT_EQ(twice.vertices.size(), 3U);
  EXPECT_EQ(read_mesh("solid nothing\nendsolid nothing\n", "x.stl").triangles.size(), 0U);
}

TEST(StlAscii, ErrorsNameThePlace) {
  std::string text = ascii(k_ascii_facet);
  text.replace(text.find("0 4 0"), 5, "0 4x 0");
  EXPECT_EQ(error_of(text, "x.stl"), "x.stl:5:11: error: expected a coordinate, found '4x'");
  EXPECT_EQ(error_of("solid x\nfaced", "x.stl"), "x.stl:2:1: error: expected 'facet' or 'endsolid', found 'faced'");
  EXPECT_THAT(error_of("solid x\nfacet normal 0 0 1\n", "x.stl"), HasSubstr("expected 'outer', the file ends here"));
  const std::string quad =
      ascii("facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 1 1 0 vertex 0 1 0 endloop endfacet\n");
  EXPECT_THAT(error_of(quad, "x.stl"), HasSubstr("x.stl:2:70: error: expected 'endloop', found 'vertex'"));
}

// Exporters write an invalid normal as their C library prints it, or omit the normal.
TEST(StlAscii, IgnoresNormals) {
  const solid::TriangleMesh plain = read_mesh(ascii(k_ascii_facet), "x.stl");
  const std::string text = ascii(k_ascii_facet);
  const std::size_t at = text.find("normal"), end = text.find("outer");
  for (const char* normal :
       {"normal nan nan nan\n", "normal -nan(ind) -nan(ind) -nan(ind)\n", "normal 1.#QNAN 0 -1.#IND\n",
        "normal weird x y\n", "normal 0 0\n", "normal\n", "\n", "NORMAL 0,0 0,0 1,0\n"}) {
    std::string other = text;
    other.replace(at, end - at, normal);
    EXPECT_EQ(facets(read_mesh(other, "x.stl")), facets(plain)) << normal;
  }
  EXPECT_THAT(error_of("solid x\nfacet normal 0 0 1\nvertex 0 0 0\n", "x.stl"),
              HasSubstr("x.stl:3:1: error: expected 'outer', found 'vertex'"));
}

TEST(StlAscii, ReadsSolidsOnOneLine) {
  const solid::TriangleMesh plain = read_mesh(ascii(k_ascii_facet), "x.stl");
  std::string line = ascii(k_ascii_facet);
  std::replace(line.begin(), line.end(), '\n', ' ');
  EXPECT_EQ(facets(read_mesh(line, "x.stl")), facets(plain));
  EXPECT_EQ(read_mesh(line + line, "x.stl").triangles.size(), 2U);
  EXPECT_EQ(facets(read_mesh(testing::with_cr(ascii(k_ascii_facet)), "x.stl")), facets(plain));
  // A name may contain any words.
  EXPECT_EQ(
      read_mesh("solid a facet of it\n" + std::string(k_ascii_facet) + "endsolid a facet\n", "x.stl").triangles.size(),
      1U);
}

// Writers add comments, omit "solid", and copies end with zero bytes or the end mark of DOS.
TEST(StlAscii, ReadsCommentsAndPadding) {
  const std::string two = std::string(k_ascii_facet) + std::string(k_ascii_facet);  // longer than a binary header
  const std::string plain = ascii(two);
  for (const std::string& text :
       {"# by a tool\n" + plain, "; by a tool\n// again\n" + plain, "solid x\n# a comment\n" + two + "endsolid\n",
        plain + std::string(200, '\0'), plain + "\x1A", two, two + "endsolid\n"})
    EXPECT_EQ(facets(read_mesh(text, "x.stl")), facets(read_mesh(plain, "x.stl"))) << text;
  EXPECT_THAT(error_of(plain + "tail\n", "x.stl"), HasSubstr("expected 'solid', found 'tail'"));
}

TEST(StlAscii, ReportsDecimalComma) {
  std::string text = ascii(k_ascii_facet);
  text.replace(text.find("0 4 0"), 5, "0 4,5 0");
  EXPECT_THAT(error_of(text, "x.stl"), HasSubstr("expected a coordinate, found '4,5'"));
  EXPECT_THAT(error_of(text, "x.stl"), HasSubstr("decimal comma"));
}

TEST(Stl, AcceptsUnknownCountAndTrailingBytes) {
  const std::string bytes = stl_bytes(testing::tetrahedron(), "x");
  for (const char* count : {"\0\0\0\0", "\xFF\xFF\xFF\xFF"}) {
    std::string unknown = bytes;
    unknown.replace(80, 4, count, 4);
    EXPECT_EQ(facets(read_mesh(unknown, "x.stl")), facets(testing::tetrahedron()));
    unknown.pop_back();
    EXPECT_THAT(error_of(unknown, "x.stl"), HasSubstr("expected a file of"));
  }
  EXPECT_EQ(facets(read_mesh(bytes + "tail", "x.stl")), facets(testing::tetrahedron()));
  std::string solid = bytes + "tail";
  solid.replace(0, 12, "solid part\nf");
  EXPECT_EQ(facets(read_mesh(solid, "x.stl")), facets(testing::tetrahedron()));
}

TEST(Stl, RejectsWrongBinaryLength) {
  const std::string bytes = stl_bytes(testing::tetrahedron(), "x");
  EXPECT_THAT(error_of(bytes.substr(0, 200), "x.stl"),
              HasSubstr("at byte 80: the header announces 4 facets, so expected a file of 284 bytes, found 200"));
  // Fifty more bytes may be a facet that the count omits.
  EXPECT_THAT(error_of(bytes + std::string(50, '\0'), "x.stl"), HasSubstr("found 334"));
  EXPECT_THAT(error_of("fusee", "x.stl"), HasSubstr("at byte 5: expected a binary STL of at least 84 bytes"));
}

TEST(Stl, RejectsTruncations) {
  EXPECT_EQ(testing::meshes_among_truncations(stl_bytes(testing::tetrahedron(), "x"), "x.stl"), 0);
  // Cut off at any place before the end of "endsolid", the text is no mesh. Only the line's end may be missing.
  EXPECT_EQ(testing::meshes_among_truncations("solid x\n" + std::string(k_ascii_facet) + "endsolid\n", "x.stl"), 1);
}

TEST(Stl, IsDeterministic) { EXPECT_EQ(stl_bytes(testing::torus(), "x"), stl_bytes(testing::torus(), "x")); }

}  // namespace
}  // namespace fusee::formats
