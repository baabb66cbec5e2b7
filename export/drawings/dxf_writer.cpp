#include "export/drawings/dxf_writer.h"

#include "export/drawings/dxf_versions.h"
#include "export/drawings/stroke_font.h"
#include "fusee/base/diagnostics.h"

namespace fusee {
namespace {

/// Comments are plain ASCII: the code page of a DXF file differs by version.
std::string ascii(const std::string& text) {
  std::string plain;
  for (const char c : text) plain += c >= ' ' && c <= '~' ? c : '?';
  return plain;
}

}  // namespace

void write_remarks(DxfTagWriter& tags, const DxfDocument& document) {
  for (const std::string& remark : document.remarks) tags.text(999, ascii(remark));
}

void write_variables(DxfTagWriter& tags, std::string_view version, const Box2d& box) {
  const auto variable = [&tags](std::string_view name) { tags.text(9, name); };
  variable("$ACADVER");
  tags.text(1, version);
  variable("$INSBASE");
  tags.point3(10, 0, 0, 0);
  variable("$EXTMIN");
  tags.point3(10, box.low.x(), box.low.y(), 0);
  variable("$EXTMAX");
  tags.point3(10, box.high.x(), box.high.y(), 0);
  variable("$LIMMIN");
  tags.point(10, box.low);
  variable("$LIMMAX");
  tags.point(10, box.high);
  variable("$INSUNITS");
  tags.integer(70, 4);
}

void write_style_values(DxfTagWriter& tags) {
  tags.integer(70, 0);
  tags.reals({{40, 0}, {41, 1}, {50, 0}});
  tags.integer(71, 0);
  tags.real(42, 2.5);
  tags.text(3, "txt");
  tags.text(4, "");
}

void DxfDocument::text(const std::string& layer, std::string_view line, const Vec2& origin, double height) {
  for (Polygon& stroke : stroke_text(line, origin, height)) open(layer, std::move(stroke));
}

std::string dxf_text(const DxfDocument& document, DxfVersion version) {
  for (const DxfPath& path : document.paths) {
    demand(path.points.size() >= 2, "a path on layer " + path.layer + " has fewer than two points");
    for (const Vec2& p : path.points) demand(p.allFinite(), "a point on layer " + path.layer + " is not finite");
  }
  return version == DxfVersion::r12 ? r12_text(document) : ac1015_text(document);
}

Box2d bounding_box(const std::vector<DxfPath>& paths) {
  Polygon corners;
  for (const DxfPath& path : paths) {
    const Box2d box = bounding_box(path.points);
    corners.insert(corners.end(), {box.low, box.high});
  }
  return bounding_box(corners);
}

}  // namespace fusee
