#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "mesh_samples.h"

namespace fusee::formats {
namespace {

using ::testing::ElementsAre;
using testing::error_of;
using testing::facets;
using ::testing::HasSubstr;
using Triangle = std::array<std::uint32_t, 3>;

/// Concatenated values in either byte order.
class Bytes {
 public:
  explicit Bytes(bool big_endian) : big_endian_(big_endian) {}
  template <class Value>
  Bytes& put(Value value) {
    std::array<char, sizeof value> raw;
    std::memcpy(raw.data(), &value, sizeof value);
    if (big_endian_) std::reverse(raw.begin(), raw.end());
    text_.append(raw.data(), raw.size());
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  bool big_endian_;
  std::string text_;
};

/// A square. Irrelevant are the colour of its vertices, the material of its face, the element before them, which has a
/// list too, and the element after them.
std::string binary_square(bool big_endian) {
  Bytes body(big_endian);
  body.put(std::int16_t{-5}).put(std::uint8_t{2}).put(1.5F).put(2.5F);  // element "camera"
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}) {
    body.put(std::uint8_t{200}).put(x).put(y).put(-0.25F);
  }
  body.put(std::int32_t{7}).put(std::uint16_t{4});
  for (const std::int32_t corner : {0, 1, 2, 3}) body.put(corner);
  return std::string("ply\nformat binary_") + (big_endian ? "big" : "little") +
         "_endian 1.0\ncomment by hand\nelement camera 1\nproperty short a\nproperty list uchar float b\n"
         "element vertex 4\nproperty uchar red\nproperty double x\nproperty float64 y\nproperty float z\n"
         "element face 1\nproperty int material\nproperty list ushort int vertex_index\nelement nothing "
         "4000000000\nend_header\n" +
         body.text();
}

constexpr std::string_view k_ascii =
    "ply\r\nformat ascii 1.0\r\nobj_info x\r\nelement vertex 3\r\nproperty float x\r\nproperty float y\r\nproperty "
    "float z\r\n"
    "property uchar red\r\nelement face 1\r\nproperty list uchar uint vertex_indices\r\nend_header\r\n"
    "0 0 0 1\r\n1 0 0 1\r\n1 1 nan 1\r\n3 0 1 2\r\n";

std::string changed(std::string_view text, std::string_view from, std::string_view to) {
  std::string copy(text);
  return copy.replace(copy.find(from), from.size(), to);
}

TEST(PlyReader, ReadsTextAndBothOrdersOfBytes) {
  const solid::TriangleMesh ascii = read_mesh(k_ascii, "x");
  EXPECT_THAT(ascii.triangles, ElementsAre(Triangle{0, 1, 2}));
  EXPECT_TRUE(std::isnan(ascii.vertices[2].z()));
  for (const bool big_endian : {false, true}) {
    const solid::TriangleMesh square = read_mesh(binary_square(big_endian), "x");
    EXPECT_THAT(square.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
    EXPECT_EQ(square.vertices[2], Vec3(1, 1, -0.25));
  }
}

TEST(PlyReader, CountsWordsNotLines) {
  const std::size_t body = k_ascii.find("0 0 0 1");
  const std::string head(k_ascii.substr(0, body));
  for (const char* rows : {"0 0\n0 1 1 0 0 1\n1 1 2 1\n3 0\n1 2\n", "0 0 0 1 1 0 0 1 1 1 2 1 3 0 1 2"}) {
    const solid::TriangleMesh mesh = read_mesh(head + rows, "x.ply");
    EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
    EXPECT_EQ(mesh.vertices[2], Vec3(1, 1, 2));
  }
  // A surplus value at a row's end is skipped if each row has its line.
  EXPECT_EQ(read_mesh(head + "0 0 0 1 77\n1 0 0 1 77\n1 1 2 1 77\n3 0 1 2 77\n", "x.ply").vertices[2], Vec3(1, 1, 2));
}

TEST(PlyReader, LinesMayEndWithCarriageReturnsAlone) {
  EXPECT_THAT(read_mesh(testing::with_cr(k_ascii), "x.ply").triangles, ElementsAre(Triangle{0, 1, 2}));
  const std::string binary = binary_square(false);
  const std::size_t body = binary.find("end_header\n") + 11;
  std::string cr = testing::with_cr(binary.substr(0, body)) + binary.substr(body);
  EXPECT_EQ(facets(read_mesh(cr, "x.ply")), facets(read_mesh(binary, "x.ply")));
  // A first value that begins with a line feed is not part of the last line's end.
  cr[body] = '\n';
  EXPECT_EQ(facets(read_mesh(cr, "x.ply")), facets(read_mesh(binary, "x.ply")));
}

TEST(PlyReader, AcceptsCommentsBeforeFormat) {
  EXPECT_THAT(read_mesh(changed(k_ascii, "format", "comment by hand\r\nformat"), "x.ply").triangles,
              ElementsAre(Triangle{0, 1, 2}));
}

TEST(PlyReader, HeaderErrorsNameThePlace) {
  EXPECT_EQ(error_of(changed(k_ascii, "ascii", "utf8"), "x.ply"),
            "x.ply:2:8: error: expected 'ascii', 'binary_little_endian' or 'binary_big_endian', found 'utf8'");
  EXPECT_EQ(error_of(changed(k_ascii, "float y", "half y"), "x.ply"),
            "x.ply:6:10: error: expected a PLY type ('float', 'uchar', 'int', …), found 'half'");
  EXPECT_EQ(error_of(changed(k_ascii, "float y", "float v"), "x.ply"),
            "x.ply:4:9: error: expected the properties x, y and z of a vertex");
  EXPECT_EQ(error_of(changed(k_ascii, "vertex_indices", "edges"), "x.ply"),
            "x.ply:9:9: error: expected the property list vertex_indices of a face");
  EXPECT_THAT(error_of(changed(k_ascii, "element face", "element tristrips"), "x.ply"),
              HasSubstr("found triangle strips"));
  EXPECT_THAT(error_of(changed(k_ascii, "end_header", "vertices"), "x.ply"),
              HasSubstr("x.ply:11:1: error: expected 'element'"));
  EXPECT_THAT(error_of("ply\nformat ascii 1.0\nelement vertex -1\n", "x.ply"),
              HasSubstr("x.ply:3:16: error: expected the number"));
  EXPECT_THAT(error_of("ply\nformat ascii 1.0\nproperty float x\n", "x.ply"),
              HasSubstr("an element before its properties"));
  EXPECT_THAT(error_of("ply\nformat ascii 1.0\n", "x.ply"), HasSubstr("expected 'end_header', the file ends here"));
}

TEST(PlyReader, ValueErrorsNameThePlace) {
  EXPECT_EQ(error_of(changed(k_ascii, "3 0 1 2", "3 0 1 3"), "x.ply"),
            "x.ply:15:7: error: expected a vertex number from 0 to 2, found '3'");
  EXPECT_THAT(error_of(changed(k_ascii, "3 0 1 2", "3 0 1 1.5"), "x.ply"), HasSubstr("found '1.5'"));
  EXPECT_THAT(error_of(changed(k_ascii, "3 0 1 2", "0 0 1 2"), "x.ply"),
              HasSubstr("x.ply:15:1: error: expected a face of at least 1 corner"));
  EXPECT_THAT(error_of(changed(k_ascii, "3 0 1 2", "5 0 1 2"), "x.ply"),
              HasSubstr("expected a number, the file ends here"));
  std::string binary = binary_square(false);
  const std::size_t last = binary.size() - 4;
  binary[last] = 9;
  EXPECT_THAT(error_of(binary, "x.ply"),
              HasSubstr("at byte " + std::to_string(last) + ": expected a vertex number from 0 to 3"));
}

TEST(PlyReader, BoundsAllocation) {
  EXPECT_THAT(error_of(changed(k_ascii, "vertex 3", "vertex 4000000000"), "x.ply"),
              HasSubstr("expected 4000000000 elements 'vertex' of at least 7 bytes each"));
  EXPECT_THAT(error_of(changed(binary_square(true), "face 1", "face 9999999999"), "x.ply"),
              HasSubstr("expected 9999999999 elements 'face'"));
}

TEST(PlyReader, RejectsTruncations) {
  EXPECT_EQ(testing::meshes_among_truncations(binary_square(false), "x.ply"), 0);
  EXPECT_EQ(testing::meshes_among_truncations(binary_square(true), "x.ply"), 0);
  // Its last line end may be missing.
  EXPECT_EQ(testing::meshes_among_truncations(k_ascii, "x.ply"), 2);
}

}  // namespace
}  // namespace fusee::formats
