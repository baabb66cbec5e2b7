// Geomview OFF in text: a line of counts, a line a vertex, a line a face.

#include <fmt/format.h>

#include <optional>
#include <vector>

#include "export/mesh_files/mesh_formats.h"
#include "export/mesh_files/text_scanner.h"

namespace fusee {
namespace {

struct Counts {
  std::uint64_t vertices = 0;
  std::uint64_t faces = 0;
};

std::uint64_t count(const TextScanner& text, std::string_view word, std::string_view expected) {
  const std::int64_t value = text.integer(word, expected);
  if (value < 0) text.fail(expected);
  return static_cast<std::uint64_t>(value);
}

/// The keyword is optional; its prefixes ST, C and N add values after each vertex' coordinates, which are passed over.
Counts read_header(TextScanner& text) {
  std::string_view word = text.flowing_word();
  if (word.ends_with("OFF")) {
    if (word.find_first_of("4n") != std::string_view::npos) text.fail("an OFF file of three dimensions");
    word = text.flowing_word();
  }
  if (word == "BINARY") text.fail("an OFF file in text");
  Counts counts;
  counts.vertices = count(text, word, "the number of vertices");
  counts.faces = count(text, text.flowing_word(), "the number of faces");
  text.rest_of_line();
  return counts;
}

void read_face(TextScanner& text, TriangleMesh& mesh, std::vector<std::uint32_t>& corners) {
  if (!text.next_line()) text.fail("a face");
  const std::uint64_t size = count(text, text.word(), "the number of a face's corners");
  if (size < 3) text.fail("a face of at least 3 corners");
  corners.clear();
  for (std::uint64_t i = 0; i < size; ++i) {
    const std::uint64_t index = count(text, text.word(), "a vertex number");
    if (index >= mesh.vertices.size()) text.fail(fmt::format("a vertex number below {}", mesh.vertices.size()));
    corners.push_back(static_cast<std::uint32_t>(index));
  }
  if (!add_fan(mesh, corners)) text.fail("a face that has a vertex at most twice");
}

}  // namespace

TriangleMesh read_off(const Source& source) {
  constexpr std::size_t k_least_vertex_line = 6;  // "0 0 0\n"
  constexpr std::size_t k_least_face_line = 8;    // "3 0 1 2\n"
  TextScanner text(source, '#');
  const Counts counts = read_header(text);
  // One more for a last line without an end.
  demand_room(source, text.next_line_offset(), counts.vertices, k_least_vertex_line - 1, "vertices");
  demand_room(source, text.next_line_offset(), counts.faces, k_least_face_line - 1, "faces");
  TriangleMesh mesh;
  mesh.vertices.reserve(counts.vertices);
  for (std::uint64_t i = 0; i < counts.vertices; ++i) {
    if (!text.next_line()) text.fail("a vertex");
    mesh.vertices.push_back(text.point("a coordinate of a vertex"));
  }
  mesh.triangles.reserve(counts.faces);
  std::vector<std::uint32_t> corners;
  for (std::uint64_t i = 0; i < counts.faces; ++i) read_face(text, mesh, corners);
  return mesh;
}

}  // namespace fusee
