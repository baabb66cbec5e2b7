#include <algorithm>
#include <cctype>

#include "base/text.h"
#include "export/mesh_files/mesh_files.h"
#include "fusee/export.h"
#include "fusee/pipeline.h"
#include "solid/conditions.h"

namespace fusee::pipeline {
namespace {

/// Size of a binary STL with ten million triangles, more than anyone prints. Bytes.
constexpr std::size_t k_largest_part = std::size_t{512} << 20;

bool has_ending(std::string name, std::string_view ending) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name.size() >= ending.size() && name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
}

/// An ASCII DXF starts with group code 0 (SECTION) or 999 (a comment) on a line of its own; no mesh format does.
bool is_drawing(std::string_view bytes, const std::string& name) {
  if (has_ending(name, ".dxf")) return true;
  const std::string_view first = bytes.substr(0, std::min(bytes.find_first_of("\r\n"), std::size_t{8}));
  std::string code;
  for (const char c : first) {
    if (c != ' ') code += c;
  }
  return code == "0" || code == "999";
}

Part parse_part(std::string_view bytes, const std::string& name) {
  if (const auto text = utf8_of_utf16(bytes)) return parse_part(*text, name);
  if (is_drawing(bytes, name)) return formats::read_dxf(bytes, name);
  return formats::read_mesh(bytes, name);
}

bool is_closed(const formats::DrawingPath& path) { return path.closed; }

/// The layer of the lines of text below fusee's sheets; nothing is cut there.
bool is_note(const formats::DrawingPath& path) { return path.layer == "NOTES"; }

}  // namespace

Part read_part(const std::filesystem::path& path, FileAccess& files) {
  return parse_part(read_file(path, k_largest_part, files), path.string());
}

std::vector<Check> check_part(const Part& part) {
  if (const auto* mesh = std::get_if<solid::TriangleMesh>(&part)) return solid::check_mesh(*mesh);
  return formats::check_drawing(std::get<formats::Drawing>(part));
}

PartSize size_of(const Part& part, const std::vector<Check>& checks) {
  PartSize size;
  solid::Bounds box;
  if (const auto* mesh = std::get_if<solid::TriangleMesh>(&part)) {
    if (mesh->vertices.empty()) return size;
    box = solid::bounds(*mesh);
    if (all_ok(checks)) size.volume = solid::enclosed_volume(*mesh);
  } else {
    solid::TriangleMesh points;
    const std::vector<formats::DrawingPath>& paths = std::get<formats::Drawing>(part).paths;
    const bool has_cuts = !std::all_of(paths.begin(), paths.end(), is_note);
    for (const formats::DrawingPath& path : paths) {
      if (has_cuts && is_note(path)) continue;
      for (const Vec2& point : path.points) points.vertices.emplace_back(point.x(), point.y(), 0.0);
    }
    if (points.vertices.empty()) return size;
    box = solid::bounds(points);
    size.contours = static_cast<std::size_t>(std::count_if(paths.begin(), paths.end(), is_closed));
  }
  if ((box.high - box.low).allFinite()) size.extent = box.high - box.low;
  return size;
}

std::optional<Check> room_check(const Mechanism& mechanism, const Part& part) {
  const auto* mesh = std::get_if<solid::TriangleMesh>(&part);
  if (mesh == nullptr || !(mechanism.body.room > 0)) return std::nullopt;
  const double diameter = solid::diameter_about_axis(*mesh) * (1.0 - mechanism.material.shrinkage);
  const profile::Condition room = solid::room_condition(mechanism, diameter);
  Check check{"room_diameter", room.value, room.limit, room.unit, room.ok, {}};
  if (!check.ok) check.where = "about the z axis, where fusee build puts the pulley's";
  return check;
}

}  // namespace fusee::pipeline
