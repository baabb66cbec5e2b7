// STL: binary (an 80-byte header, a count, 50 bytes a facet, little-endian floats) and ASCII ("solid … endsolid").

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cstring>
#include <limits>
#include <optional>

#include "export/mesh_files/mesh_files.h"
#include "export/mesh_files/mesh_formats.h"
#include "export/mesh_files/text_scanner.h"
#include "export/tool.h"

namespace fusee::formats {
namespace {

static_assert(std::endian::native == std::endian::little, "STL floats are copied from memory without a change");

constexpr std::size_t k_header_size = 80;
constexpr std::size_t k_facets_start = 84;
constexpr std::size_t k_facet_size = 50;

/// Words that end a normal and cannot be part of it.
constexpr auto k_keywords =
    std::to_array<std::string_view>({"facet", "loop", "vertex", "endloop", "endfacet", "solid", "endsolid"});

using Float3 = std::array<float, 3>;

Float3 to_floats(const Vec3& v) { return {float(v.x()), float(v.y()), float(v.z())}; }

/// Unit normal of a facet; zero for a degenerate one.
Vec3 facet_normal(const solid::TriangleMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  const Vec3& a = mesh.vertices[triangle[0]];
  const Vec3 normal = (mesh.vertices[triangle[1]] - a).cross(mesh.vertices[triangle[2]] - a);
  const double length = normal.norm();
  return length > 0 ? Vec3(normal / length) : Vec3(Vec3::Zero());
}

/// Writes the 50 bytes of a facet and returns the end of them.
char* put_facet(char* to, const solid::TriangleMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  std::array<Float3, 4> record;
  record[0] = to_floats(facet_normal(mesh, triangle));
  for (int k = 0; k < 3; ++k) record[k + 1] = to_floats(mesh.vertices[triangle[k]]);
  std::memcpy(to, record.data(), sizeof record);
  to[48] = to[49] = 0;  // attribute bytes, unused
  return to + k_facet_size;
}

bool has_high_byte(std::string_view bytes) {
  return std::any_of(bytes.begin(), bytes.end(), [](char c) { return static_cast<unsigned char>(c) > 127; });
}

/// admesh and PrusaSlicer treat a binary STL as ASCII unless a byte > 127 occurs within 128 bytes after the header.
/// Almost every facet has one, downward facets always (the sign of their normal). If the first facets have none, one
/// that has is swapped with the first.
void distinguish_from_ascii(std::string& bytes) {
  constexpr std::size_t k_examined = 128;
  const std::string_view facets = std::string_view(bytes).substr(k_facets_start);
  if (has_high_byte(facets.substr(0, k_examined))) return;
  for (std::size_t at = 0; at < facets.size(); at += k_facet_size) {
    if (!has_high_byte(facets.substr(at, k_facet_size))) continue;
    char* first = bytes.data() + k_facets_start;
    std::swap_ranges(first, first + k_facet_size, first + at);
    return;
  }
}

/// Facets of a binary file; each has vertices of its own.
solid::TriangleMesh read_facets(std::string_view bytes, std::size_t count) {
  solid::TriangleMesh soup;
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

/// True if `word` is the keyword, in lower or upper case. `keyword` is in lower case.
bool is_word(std::string_view word, std::string_view keyword) {
  return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(),
                    [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
}

void expect(TextScanner& text, std::string_view keyword) {
  if (!is_word(text.flowing_word(), keyword)) text.fail(fmt::format("'{}'", keyword));
}

/// The normal is redundant, because the corners' order gives it. Writers omit it, or write "nan", "-nan(ind)" or
/// "1.#QNAN". Up to "outer", anything but another keyword is accepted.
void skip_normal(TextScanner& text) {
  std::string_view word = text.flowing_word();
  for (; !word.empty() && !is_word(word, "outer"); word = text.flowing_word()) {
    if (std::any_of(k_keywords.begin(), k_keywords.end(), [&](std::string_view k) { return is_word(word, k); })) break;
  }
  if (!is_word(word, "outer")) text.fail("'outer'");
}

/// The part of a facet after its first word.
void read_ascii_facet(TextScanner& text, solid::TriangleMesh& soup) {
  skip_normal(text);
  expect(text, "loop");
  for (int corner = 0; corner < 3; ++corner) {
    expect(text, "vertex");
    soup.vertices.push_back(text.flowing_point("a coordinate"));
  }
  expect(text, "endloop");
  expect(text, "endfacet");
  const auto end = static_cast<std::uint32_t>(soup.vertices.size());
  soup.triangles.push_back({end - 3, end - 2, end - 1});
}

/// A name may contain the word "facet", but neither "facet normal" nor "facet outer".
bool is_name_over(TextScanner ahead) {
  const std::string_view word = ahead.word();
  if (!is_word(word, "facet")) return is_word(word, "endsolid");
  const std::string_view next = ahead.flowing_word();
  return is_word(next, "normal") || is_word(next, "outer");
}

/// Skips the name after "solid" or "endsolid". It ends with its line, or before a facet or "endsolid" on that line.
void skip_name(TextScanner& text) {
  while (!is_name_over(text) && !text.word().empty()) {
  }
}

/// The next word that does not belong to a comment. The format has no comments, but some writers add lines of them.
std::string_view uncommented_word(TextScanner& text) {
  std::string_view word = text.flowing_word();
  for (; word.starts_with('#') || word.starts_with(';') || word.starts_with("//"); word = text.flowing_word())
    text.rest_of_line();
  return word;
}

/// True for zero bytes, which fill the last block of a copy, for the end mark of DOS, and for an empty word.
bool is_padding(std::string_view word) { return word.find_first_not_of(std::string_view("\0\x1A", 2)) == word.npos; }

solid::TriangleMesh read_ascii_stl(const Source& source) {
  solid::TriangleMesh soup;
  TextScanner text(source);
  bool is_open = false, has_solid = false;  // within a solid; a line "solid" or "endsolid" was read
  for (std::string_view word = uncommented_word(text); is_open || !is_padding(word); word = uncommented_word(text)) {
    // A file without the line "solid" may still end with "endsolid".
    const bool may_end = is_open || (!has_solid && !soup.triangles.empty());
    if (is_word(word, "facet")) {
      read_ascii_facet(text, soup);
      is_open = has_solid;
    } else if (is_word(word, may_end ? "endsolid" : "solid")) {
      skip_name(text);
      is_open = !may_end;
      has_solid = true;
    } else {
      text.fail(is_open ? "'facet' or 'endsolid'" : "'solid'");
    }
  }
  return soup;
}

/// Some writers omit the line "solid".
bool starts_as_text(const Source& source) {
  // A binary header may start with "solid" too, but text contains no zero byte.
  constexpr std::size_t k_examined = k_facets_start + k_facet_size;
  if (source.bytes.substr(0, k_examined).find('\0') != std::string_view::npos) return false;
  TextScanner text(source);
  const std::string_view word = uncommented_word(text);
  if (is_word(word, "solid")) return true;
  if (!is_word(word, "facet")) return false;
  const std::string_view next = text.flowing_word();
  return is_word(next, "normal") || is_word(next, "outer");
}

std::uint32_t announced_facets(std::string_view bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + k_header_size, sizeof count);
  return count;
}

/// Number of facets of a binary file. Writers that do not know it write 0 or −1; the size then gives it. Bytes after
/// the announced facets are skipped unless they are facets. Empty if count and size contradict.
std::optional<std::size_t> binary_facets(std::string_view bytes) {
  if (bytes.size() < k_facets_start) return std::nullopt;
  const std::size_t announced = announced_facets(bytes);
  const std::size_t possible = (bytes.size() - k_facets_start) / k_facet_size;
  const bool is_whole = (bytes.size() - k_facets_start) % k_facet_size == 0;
  const bool is_unknown = announced == 0 || announced == std::numeric_limits<std::uint32_t>::max();
  if (is_whole && (is_unknown || announced == possible)) return possible;
  if (!is_whole && !is_unknown && announced <= possible) return announced;
  return std::nullopt;
}

/// The file is neither an ASCII STL nor a complete binary one.
[[noreturn]] void fail_binary_size(const Source& source) {
  const std::size_t size = source.bytes.size();
  if (size < k_facets_start) {
    fail_at_byte(source, size,
                 fmt::format("expected a binary STL of at least {} bytes or the word 'solid', the file ends here",
                             k_facets_start));
  }
  const std::uint32_t count = announced_facets(source.bytes);
  fail_at_byte(source, k_header_size,
               fmt::format("the header announces {} facets, so expected a file of {} bytes, found {}", count,
                           k_facets_start + std::uint64_t{k_facet_size} * count, size));
}

}  // namespace

std::string part_file_name(transmission::Side side) {
  return side == transmission::Side::left ? "pulley_p1.stl" : "pulley_p2.stl";
}

std::string stl_bytes(const solid::TriangleMesh& mesh, const std::string& name) {
  std::string bytes(k_facets_start + k_facet_size * mesh.triangles.size(), '\0');
  const std::string header = fmt::format("{}, {}, unit mm", k_tool, printable(name));
  std::copy_n(header.begin(), std::min(header.size(), k_header_size), bytes.begin());
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  std::memcpy(bytes.data() + k_header_size, &count, sizeof count);

  char* to = bytes.data() + k_facets_start;
  for (const auto& triangle : mesh.triangles) to = put_facet(to, mesh, triangle);
  distinguish_from_ascii(bytes);
  return bytes;
}

bool is_binary_stl(std::string_view bytes) {
  if (bytes.size() < k_facets_start) return false;
  return bytes.size() == k_facets_start + std::uint64_t{k_facet_size} * announced_facets(bytes);
}

solid::TriangleMesh read_stl(const Source& source) {
  if (starts_as_text(source) && !is_binary_stl(source.bytes)) return solid::weld(read_ascii_stl(source));
  if (const auto count = binary_facets(source.bytes)) return solid::weld(read_facets(source.bytes, *count));
  fail_binary_size(source);
}

}  // namespace fusee::formats
