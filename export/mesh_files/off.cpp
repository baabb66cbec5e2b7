// Geomview OFF in text: counts, vertices, faces. The format counts words, not lines, except that a face's colour ends
// with its line.

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "export/mesh_files/mesh_formats.h"
#include "export/mesh_files/polygons.h"
#include "export/mesh_files/text_scanner.h"

namespace fusee::formats {
namespace {

struct OffHeader {
  std::uint64_t vertices = 0;
  std::uint64_t faces = 0;
  std::size_t words_per_vertex = 3;  ///< coordinates, plus the values declared by the keyword's prefix
};

/// A whole number of at least 0.
std::uint64_t count(const TextScanner& text, std::string_view word, std::string_view expected) {
  const std::int64_t value = text.integer(word, expected);
  if (value < 0) text.fail(expected);
  return static_cast<std::uint64_t>(value);
}

/// Skips the number of edges. It follows on the line of the faces' number or alone on the next one. Some writers omit
/// it.
void skip_edge_count(TextScanner& text) {
  if (!text.word().empty()) return;
  TextScanner ahead = text;
  if (!ahead.flowing_word().empty() && ahead.word().empty()) text.flowing_word();
}

/// The keyword is optional. Its prefixes ST, C and N add values after the coordinates of each vertex. Some files of
/// ModelNet have no blank between the keyword and the number of vertices ("OFF8 12 0").
OffHeader read_off_header(TextScanner& text) {
  std::string_view word = text.flowing_word();
  OffHeader header;
  const std::size_t first_digit = std::min(word.find_first_of("0123456789"), word.size());
  if (const std::string_view keyword = word.substr(0, first_digit); keyword == "OFF" && first_digit < word.size()) {
    word.remove_prefix(first_digit);
  } else if (word == "off") {
    word = text.flowing_word();
  } else if (word.ends_with("OFF")) {
    if (word.find_first_of("4n") != std::string_view::npos) text.fail("an OFF file of three dimensions");
    if (word.starts_with("ST")) header.words_per_vertex += 2;                    // texture coordinates
    if (word.find('C') != std::string_view::npos) header.words_per_vertex += 4;  // colour
    if (word.find('N') != std::string_view::npos) header.words_per_vertex += 3;  // normal
    word = text.flowing_word();
  }
  if (word == "BINARY") text.fail("an OFF file in text");
  header.vertices = count(text, word, "the number of vertices");
  header.faces = count(text, text.flowing_word(), "the number of faces");
  skip_edge_count(text);
  return header;
}

/// Number of words up to the end of the line, which are skipped.
std::size_t remaining_words(TextScanner& text) {
  std::size_t words = 0;
  while (!text.word().empty()) ++words;
  return words;
}

/// Writers add values that the keyword does not declare, or omit some. Such a file still has one vertex on each line:
/// as many lines as vertices follow, with equal numbers of words.
bool has_one_vertex_per_line(TextScanner text, std::uint64_t vertices) {
  if (!text.word().empty()) return false;
  std::size_t words = 0;
  for (std::uint64_t i = 0; i < vertices; ++i) {
    if (!text.next_line()) return false;
    const std::size_t words_on_line = remaining_words(text);
    if (words_on_line < 3 || (i > 0 && words_on_line != words)) return false;
    words = words_on_line;
  }
  return true;
}

void read_vertices(TextScanner& text, const OffHeader& header, solid::TriangleMesh& mesh) {
  const bool has_vertex_lines = has_one_vertex_per_line(text, header.vertices);
  mesh.vertices.reserve(header.vertices);
  for (std::uint64_t i = 0; i < header.vertices; ++i) {
    mesh.vertices.push_back(text.flowing_point("a coordinate of a vertex"));
    if (has_vertex_lines) {
      text.rest_of_line();
    } else {
      for (std::size_t k = 3; k < header.words_per_vertex; ++k) text.number(text.flowing_word(), "a value of a vertex");
    }
  }
}

void read_face(TextScanner& text, std::uint64_t vertices, PolygonSplitter& polygons,
               std::vector<std::uint32_t>& corners) {
  const std::string_view word = text.flowing_word();
  if (word.empty()) text.fail("a face");
  const std::uint64_t size = count(text, word, "the number of a face's corners");
  if (size == 0) text.fail("a face of at least 1 corner");
  corners.clear();
  for (std::uint64_t i = 0; i < size; ++i) {
    const std::uint64_t index = count(text, text.flowing_word(), "a vertex number");
    if (index >= vertices) text.fail(fmt::format("a vertex number below {}", vertices));
    corners.push_back(static_cast<std::uint32_t>(index));
  }
  if (const auto expected = polygons.add(corners)) text.fail(*expected);
}

/// A colour ends with its line. If there are fewer lines than faces, faces share lines and have no colours.
void read_faces(TextScanner& text, const OffHeader& header, solid::TriangleMesh& mesh) {
  const bool has_one_face_per_line = text.lines_ahead(header.faces) == header.faces;
  mesh.triangles.reserve(header.faces);
  PolygonSplitter polygons(text.source(), mesh);
  std::vector<std::uint32_t> corners;
  for (std::uint64_t i = 0; i < header.faces; ++i) {
    read_face(text, mesh.vertices.size(), polygons, corners);
    if (has_one_face_per_line) text.rest_of_line();
  }
  polygons.split_concave();
}

}  // namespace

solid::TriangleMesh read_off(const Source& source) {
  constexpr std::size_t k_least_vertex = 6;  // "0 0 0 "
  constexpr std::size_t k_least_face = 4;    // "1 0 "
  TextScanner text(source, '#');
  const OffHeader header = read_off_header(text);
  // One byte less: the last line may have no end.
  demand_room(source, text.offset(), header.vertices, k_least_vertex - 1, "vertices");
  demand_room(source, text.offset(), header.faces, k_least_face - 1, "faces");
  solid::TriangleMesh mesh;
  read_vertices(text, header, mesh);
  read_faces(text, header, mesh);
  return mesh;
}

}  // namespace fusee::formats
