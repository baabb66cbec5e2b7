// AC1009 for laser shops: no handles, no owners, and polylines with separate vertices.
#include "export/drawings/dxf_versions.h"

namespace fusee::formats {
namespace {

void write_r12_tables(DxfTagWriter& tags, const DxfDocument& document) {
  const auto begin_table = [&tags](std::string_view name, int count) {
    tags.text(0, "TABLE");
    tags.text(2, name);
    tags.integer(70, count);
  };
  tags.begin_section("TABLES");
  begin_table("LTYPE", 1);
  tags.text(0, "LTYPE");
  tags.text(2, "CONTINUOUS");
  tags.integer(70, 0);
  tags.text(3, "Solid line");
  tags.integers({{72, 65}, {73, 0}});  // alignment, which is always 'A'; number of dashes
  tags.real(40, 0);
  tags.text(0, "ENDTAB");
  begin_table("LAYER", static_cast<int>(document.layers.size()) + 1);
  const auto layer = [&tags](std::string_view name, int colour) {
    tags.text(0, "LAYER");
    tags.text(2, name);
    tags.integers({{70, 0}, {62, colour}});
    tags.text(6, "CONTINUOUS");
  };
  constexpr int k_white = 7;
  layer("0", k_white);
  for (const DxfLayer& each : document.layers) layer(each.name, each.colour);
  tags.text(0, "ENDTAB");
  begin_table("STYLE", 1);
  tags.text(0, "STYLE");
  tags.text(2, "STANDARD");
  write_style_values(tags);
  tags.text(0, "ENDTAB");
  tags.end_section();
}

void write_r12_polyline(DxfTagWriter& tags, const DxfPath& path) {
  tags.text(0, "POLYLINE");
  tags.text(8, path.layer);
  tags.integer(66, 1);
  tags.point3(10, 0, 0, 0);
  const bool is_in_space = !path.heights.empty();
  tags.integer(70, (path.closed ? k_closed : 0) + (is_in_space ? k_polyline_3d : 0));
  for (std::size_t i = 0; i < path.vertices.size(); ++i) {
    const BulgeVertex& vertex = path.vertices[i];
    tags.text(0, "VERTEX");
    tags.text(8, path.layer);
    tags.point3(10, vertex.place.x(), vertex.place.y(), is_in_space ? path.heights[i] : 0);
    if (is_in_space) tags.integer(70, k_vertex_3d);
    if (vertex.bulge != 0) tags.real(42, vertex.bulge);
  }
  tags.text(0, "SEQEND");
  tags.text(8, path.layer);
}

void write_r12_circle(DxfTagWriter& tags, const std::string& layer, const solid::RoundHole& circle) {
  tags.text(0, "CIRCLE");
  tags.text(8, layer);
  write_circle_values(tags, circle);
}

}  // namespace

std::string r12_text(const DxfDocument& document) {
  DxfTagWriter tags;
  write_remarks(tags, document);
  tags.begin_section("HEADER");
  write_variables(tags, "AC1009", bounding_box(document.paths));
  tags.end_section();
  write_r12_tables(tags, document);
  tags.begin_section("BLOCKS");
  tags.end_section();
  tags.begin_section("ENTITIES");
  for (const DxfPath& path : document.paths) {
    if (path.circle)
      write_r12_circle(tags, path.layer, *path.circle);
    else
      write_r12_polyline(tags, path);
  }
  tags.end_section();
  tags.text(0, "EOF");
  return tags.take();
}

}  // namespace fusee::formats
