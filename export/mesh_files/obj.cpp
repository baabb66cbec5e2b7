// Wavefront OBJ: vertices and polygons of a text. All other statements are skipped.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "export/mesh_files/mesh_files.h"
#include "export/mesh_files/mesh_formats.h"
#include "export/mesh_files/polygons.h"
#include "export/mesh_files/text_scanner.h"
#include "export/tool.h"

namespace fusee::formats {
namespace {

constexpr std::array<std::string_view, 41> k_skipped_statements = {
    "vt",     "vn",     "vp",     "p",   "l",    "g",     "s",        "o",        "mg",   "usemtl",     "mtllib",
    "usemap", "maplib", "cstype", "deg", "bmat", "step",  "curv",     "curv2",    "surf", "parm",       "trim",
    "hole",   "scrv",   "sp",     "end", "con",  "bevel", "c_interp", "d_interp", "lod",  "shadow_obj", "trace_obj",
    "ctech",  "stech",  "call",   "csh", "bsp",  "bzp",   "cdc",      "cdp"};

/// The greatest vertex number of a face, and its place. Vertices may follow their faces.
struct GreatestIndex {
  std::int64_t index = -1;
  Place place;
};

/// The next word of a statement. A backslash at the end of a line, with or without a blank before it, continues the
/// statement on the next line.
std::string_view statement_word(TextScanner& text) {
  std::string_view word = text.word();
  while ((word.empty() || word == "\\") && text.is_continued() && text.next_line()) word = text.word();
  return text.is_continued() && word.ends_with('\\') ? word.substr(0, word.size() - 1) : word;
}

Vec3 read_vertex(TextScanner& text) {
  Vec3 vertex;
  for (double& coordinate : vertex) coordinate = text.number(statement_word(text), "a coordinate of a vertex");
  return vertex;
}

/// "7", "7/2", "7//3", "-1/-1/-1" → the vertex' index from 0.
std::int64_t corner_index(const TextScanner& text, std::string_view word, std::size_t vertices) {
  constexpr std::string_view k_expected = "a vertex number (1, 2, … or -1, -2, … from the end)";
  const std::int64_t index = text.integer(word.substr(0, word.find('/')), k_expected);
  if (index == 0 || index > std::int64_t{UINT32_MAX}) text.fail(k_expected);
  if (index > 0) return index - 1;
  if (index < -static_cast<std::int64_t>(vertices))
    text.fail(fmt::format("a vertex number, with {} vertices before it", vertices));
  return static_cast<std::int64_t>(vertices) + index;
}

void read_face(TextScanner& text, std::size_t vertices, PolygonSplitter& polygons, GreatestIndex& greatest) {
  std::vector<std::uint32_t> corners;
  for (std::string_view word = statement_word(text); !word.empty(); word = statement_word(text)) {
    const std::int64_t index = corner_index(text, word, vertices);
    if (index > greatest.index) greatest = {index, text.place()};
    corners.push_back(static_cast<std::uint32_t>(index));
  }
  if (corners.empty()) text.fail("a face of at least 1 corner");
  if (const auto expected = polygons.add(corners)) text.fail(*expected);
}

void put_vertex(fmt::memory_buffer& to, const Vec3& v) {
  // Adding zero removes the sign of a negative zero. Nine digits read back as the same float. Read as doubles, they are
  // so close to that float that volumes agree with the STL's. With the shortest texts that read back as the same float,
  // the volume of a pulley of 0.3 m was 1e-7 off.
  fmt::format_to(std::back_inserter(to), "v {:.9g} {:.9g} {:.9g}\n", float(v.x()) + 0.0F, float(v.y()) + 0.0F,
                 float(v.z()) + 0.0F);
}

}  // namespace

std::string obj_text(const solid::TriangleMesh& mesh, const std::string& name) {
  fmt::memory_buffer text;
  text.reserve(64 + 40 * mesh.vertices.size() + 24 * mesh.triangles.size());
  fmt::format_to(std::back_inserter(text), "# {}, unit mm\no {}\n", k_tool, printable(name));
  for (const Vec3& vertex : mesh.vertices) put_vertex(text, vertex);
  for (const auto& t : mesh.triangles) {
    fmt::format_to(std::back_inserter(text), "f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  }
  return fmt::to_string(text);
}

solid::TriangleMesh read_obj(const Source& source) {
  solid::TriangleMesh mesh;
  PolygonSplitter polygons(source, mesh);
  GreatestIndex greatest;
  TextScanner text(source, '#');
  while (text.next_line()) {
    const std::string_view keyword = text.word();
    if (keyword == "v") {
      mesh.vertices.push_back(read_vertex(text));
    } else if (keyword == "f" || keyword == "fo") {
      read_face(text, mesh.vertices.size(), polygons, greatest);
    } else if (std::find(k_skipped_statements.begin(), k_skipped_statements.end(), keyword) ==
               k_skipped_statements.end()) {
      text.fail("an OBJ statement ('v', 'f', …)");
    } else {
      while (!statement_word(text).empty()) {
      }
    }
  }
  if (greatest.index >= static_cast<std::int64_t>(mesh.vertices.size())) {
    throw InputError(
        {Severity::error,
         greatest.place,
         fmt::format("a face refers to vertex {}, but the file has {}", greatest.index + 1, mesh.vertices.size()),
         {}});
  }
  polygons.split_concave();
  return mesh;
}

}  // namespace fusee::formats
