// STL: binary (an 80-byte header, a count, 50 bytes a facet, little-endian floats) and ASCII ("solid … endsolid").

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cctype>
#include <cstring>

#include "export/mesh_files/mesh_formats.h"
#include "export/mesh_files/text_scanner.h"
#include "export/tool.h"
#include "fusee/export/mesh_files.h"

namespace fusee {
namespace {

static_assert(std::endian::native == std::endian::little, "STL floats are copied as they lie in memory");

constexpr std::size_t k_header_size = 80;
constexpr std::size_t k_facets_start = 84;
constexpr std::size_t k_facet_size = 50;

using Float3 = std::array<float, 3>;

Float3 to_floats(const Vec3& v) { return {float(v.x()), float(v.y()), float(v.z())}; }

/// Unit normal of a facet; zero where it has none.
Vec3 facet_normal(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  const Vec3& a = mesh.vertices[triangle[0]];
  const Vec3 across = (mesh.vertices[triangle[1]] - a).cross(mesh.vertices[triangle[2]] - a);
  const double length = across.norm();
  return length > 0 ? Vec3(across / length) : Vec3(Vec3::Zero());
}

char* put_facet(char* to, const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  std::array<Float3, 4> record;
  record[0] = to_floats(facet_normal(mesh, triangle));
  for (int k = 0; k < 3; ++k) record[k + 1] = to_floats(mesh.vertices[triangle[k]]);
  std::memcpy(to, record.data(), sizeof record);
  to[48] = to[49] = 0;
  return to + k_facet_size;
}

bool has_high_byte(std::string_view bytes) {
  return std::any_of(bytes.begin(), bytes.end(), [](char c) { return static_cast<unsigned char>(c) > 127; });
}

/// admesh and PrusaSlicer take a binary STL for ASCII unless a byte > 127 stands within 128 bytes after the header.
/// Almost every facet has one, those that look down always (the sign of their normal). Where the first facets have
/// none, one that has changes places with the first.
void tell_from_ascii(std::string& bytes) {
  constexpr std::size_t k_looked_at = 128;
  const std::string_view facets = std::string_view(bytes).substr(k_facets_start);
  if (has_high_byte(facets.substr(0, k_looked_at))) return;
  for (std::size_t at = 0; at < facets.size(); at += k_facet_size) {
    if (!has_high_byte(facets.substr(at, k_facet_size))) continue;
    char* first = bytes.data() + k_facets_start;
    std::swap_ranges(first, first + k_facet_size, first + at);
    return;
  }
}

TriangleMesh read_binary_stl(std::string_view bytes) {
  const std::size_t count = (bytes.size() - k_facets_start) / k_facet_size;
  TriangleMesh soup;
  soup.vertices.reserve(3 * count);
  soup.triangles.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    std::array<Float3, 3> corners;
    std::memcpy(corners.data(), bytes.data() + k_facets_start + i * k_facet_size + sizeof(Float3), sizeof corners);
    for (const Float3& c : corners) soup.vertices.emplace_back(c[0], c[1], c[2]);
    const auto first = static_cast<std::uint32_t>(3 * i);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

bool is_word(std::string_view word, std::string_view keyword) {
  return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(),
                    [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
}

void expect(TextScanner& text, std::string_view keyword) {
  if (!is_word(text.flowing_word(), keyword)) text.fail(fmt::format("'{}'", keyword));
}

Vec3 flowing_point(TextScanner& text, std::string_view expected) {
  Vec3 point;
  for (double& coordinate : point) coordinate = text.number(text.flowing_word(), expected);
  return point;
}

/// What follows the word "facet". Its normal is read and dropped: the corners' order says the same.
void read_ascii_facet(TextScanner& text, TriangleMesh& soup) {
  expect(text, "normal");
  flowing_point(text, "a number of the normal");
  expect(text, "outer");
  expect(text, "loop");
  for (int corner = 0; corner < 3; ++corner) {
    expect(text, "vertex");
    soup.vertices.push_back(flowing_point(text, "a coordinate"));
  }
  expect(text, "endloop");
  expect(text, "endfacet");
  const auto end = static_cast<std::uint32_t>(soup.vertices.size());
  soup.triangles.push_back({end - 3, end - 2, end - 1});
}

TriangleMesh read_ascii_stl(const Source& source) {
  TriangleMesh soup;
  TextScanner text(source);
  for (std::string_view word = text.flowing_word(); !word.empty(); word = text.flowing_word()) {
    if (!is_word(word, "solid")) text.fail("'solid'");
    text.rest_of_line();
    for (word = text.flowing_word(); !is_word(word, "endsolid"); word = text.flowing_word()) {
      if (!is_word(word, "facet")) text.fail("'facet' or 'endsolid'");
      read_ascii_facet(text, soup);
    }
    text.rest_of_line();
  }
  return soup;
}

/// Where a file that is no ASCII STL is as a binary one wrong.
[[noreturn]] void fail_binary_size(const Source& source) {
  const std::size_t size = source.bytes.size();
  if (size < k_facets_start) {
    fail_at_byte(source, size,
                 fmt::format("expected a binary STL of at least {} bytes or the word 'solid', the file ends here",
                             k_facets_start));
  }
  std::uint32_t count = 0;
  std::memcpy(&count, source.bytes.data() + k_header_size, sizeof count);
  fail_at_byte(source, k_header_size,
               fmt::format("the header announces {} facets, so expected a file of {} bytes, found {}", count,
                           k_facets_start + std::uint64_t{k_facet_size} * count, size));
}

}  // namespace

std::string part_file_name(Side side) { return side == Side::left ? "pulley_p1.stl" : "pulley_p2.stl"; }

std::string stl_bytes(const TriangleMesh& mesh, const std::string& name) {
  std::string bytes(k_facets_start + k_facet_size * mesh.triangles.size(), '\0');
  const std::string header = fmt::format("{}, {}, unit mm", k_tool, printable(name));
  std::copy_n(header.begin(), std::min(header.size(), k_header_size), bytes.begin());
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  std::memcpy(bytes.data() + k_header_size, &count, sizeof count);

  char* to = bytes.data() + k_facets_start;
  for (const auto& triangle : mesh.triangles) to = put_facet(to, mesh, triangle);
  tell_from_ascii(bytes);
  return bytes;
}

bool is_binary_stl(std::string_view bytes) {
  if (bytes.size() < k_facets_start) return false;
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + k_header_size, sizeof count);
  return bytes.size() == k_facets_start + std::uint64_t{k_facet_size} * count;
}

TriangleMesh read_stl(const Source& source) {
  // Size before content: binary files whose header starts with "solid" exist.
  if (is_binary_stl(source.bytes)) return weld(read_binary_stl(source.bytes));
  TextScanner text(source);
  if (is_word(text.flowing_word(), "solid")) return weld(read_ascii_stl(source));
  fail_binary_size(source);
}

}  // namespace fusee
