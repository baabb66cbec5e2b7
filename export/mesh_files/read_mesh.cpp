// Chooses the format: by content first, because names may be wrong, then by the name's ending.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "base/text.h"
#include "export/mesh_files/mesh_files.h"
#include "export/mesh_files/mesh_formats.h"
#include "export/mesh_files/text_scanner.h"

namespace fusee::formats {
namespace {

using Reader = solid::TriangleMesh (*)(const Source&);

struct FormatReader {
  std::string_view ending;
  Reader reader;
};
constexpr std::array<FormatReader, 6> k_endings = {{{".stl", read_stl},
                                                    {".obj", read_obj},
                                                    {".3mf", read_threemf},
                                                    {".off", read_off},
                                                    {".ply", read_ply},
                                                    {".drc", read_drc}}};

/// Null if the content is ambiguous.
Reader reader_by_content(const Source& source) {
  if (is_binary_stl(source.bytes)) return read_stl;
  if (source.bytes.starts_with("PK\x03\x04") || source.bytes.starts_with("PK\x05\x06")) return read_threemf;
  if (source.bytes.starts_with("DRACO")) return read_drc;
  const std::string_view word = TextScanner(source, '#').flowing_word();
  if (word == "ply") return read_ply;
  if (word == "OFF" || word == "COFF" || word == "NOFF" || word == "CNOFF" || word == "STOFF") return read_off;
  if (lower(word.substr(0, 6)) == "solid") return read_stl;
  if (word == "v" || word == "o" || word == "mtllib") return read_obj;
  return nullptr;
}

Reader reader_by_name(const std::string& file_name) {
  const std::string name = lower(file_name);
  const auto found =
      std::find_if(k_endings.begin(), k_endings.end(), [&](const FormatReader& e) { return name.ends_with(e.ending); });
  return found == k_endings.end() ? nullptr : found->reader;
}

}  // namespace

void fail_at_byte(const Source& source, std::size_t offset, const std::string& message) {
  throw InputError(source.name, fmt::format("at byte {}: {}", offset, message));
}

void demand_room(const Source& source, std::size_t offset, std::uint64_t count, std::size_t least_bytes,
                 const std::string& things) {
  const std::size_t remaining = source.bytes.size() - std::min(offset, source.bytes.size());
  if (least_bytes == 0 || count <= remaining / least_bytes) return;
  fail_at_byte(source, offset,
               fmt::format("expected {} {} of at least {} bytes each, but only {} bytes follow", count, things,
                           least_bytes, remaining));
}

/// Unused vertices do not affect size or position and may be infinite.
solid::TriangleMesh without_unused_vertices(const solid::TriangleMesh& mesh) {
  constexpr auto k_unused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> new_index(mesh.vertices.size(), k_unused);
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) new_index[corner] = 0;  // used; numbered below
  }
  if (std::find(new_index.begin(), new_index.end(), k_unused) == new_index.end()) return mesh;
  solid::TriangleMesh used;
  for (std::size_t i = 0; i < new_index.size(); ++i) {
    if (new_index[i] == k_unused) continue;
    new_index[i] = static_cast<std::uint32_t>(used.vertices.size());
    used.vertices.push_back(mesh.vertices[i]);
  }
  used.triangles.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) used.triangles.push_back({new_index[a], new_index[b], new_index[c]});
  return used;
}

solid::TriangleMesh read_mesh(std::string_view bytes, const std::string& file_name) {
  if (bytes.empty()) throw InputError(file_name, "the file is empty, expected a mesh");
  const Source source{bytes, file_name};
  Reader reader = reader_by_content(source);
  if (reader == nullptr) reader = reader_by_name(file_name);
  if (reader == nullptr) {
    throw InputError(file_name, "expected a mesh, but neither its first bytes nor its name identify the format",
                     "fusee reads .stl, .obj, .3mf, .off, .ply, .drc and .dxf");
  }
  return without_unused_vertices(reader(source));
}

}  // namespace fusee::formats
