#include "export/drawings/dxf_writer.h"

#include "export/drawings/dxf_versions.h"
#include "export/drawings/stroke_font.h"
#include "fusee/base.h"

namespace fusee::formats {
namespace {

constexpr int k_insunits_mm = 4;
constexpr double k_box_sagitta = 0.001;  // mm; the box is for display only

/// Comments are plain ASCII, because the code page of a DXF file depends on its version.
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
  tags.integer(70, k_insunits_mm);
}

void write_circle_values(DxfTagWriter& tags, const solid::RoundHole& circle) {
  tags.point3(10, circle.centre.x(), circle.centre.y(), 0);
  tags.real(40, 0.5 * circle.diameter);
}

void write_style_values(DxfTagWriter& tags) {
  tags.integer(70, 0);
  tags.reals({{40, 0}, {41, 1}, {50, 0}});
  tags.integer(71, 0);
  tags.real(42, 2.5);
  tags.text(3, "txt");
  tags.text(4, "");
}

void DxfDocument::add_closed(std::string layer, const Contour& contour, const Vec2& shift) {
  DxfPath path{std::move(layer), {}, true, contour.circle};
  if (path.circle) {
    path.circle->centre += shift;
  } else {
    path.vertices = vertices_of(contour);
    for (BulgeVertex& vertex : path.vertices) vertex.place += shift;
  }
  paths.push_back(std::move(path));
}

void DxfDocument::add_closed_arcs(std::string layer, std::vector<BulgeVertex> vertices) {
  paths.push_back({std::move(layer), std::move(vertices), true, {}});
}

void DxfDocument::add_open(std::string layer, const Polygon& points) {
  paths.push_back({std::move(layer), vertices_of({points, {}, 0}), false, {}});
}

void DxfDocument::add_in_space(std::string layer, const std::vector<Vec3>& points) {
  DxfPath path{std::move(layer), {}, false, {}};
  for (const Vec3& point : points) {
    path.vertices.push_back({point.head<2>(), 0});
    path.heights.push_back(point.z());
  }
  paths.push_back(std::move(path));
}

void DxfDocument::add_text(const std::string& layer, std::string_view line, const Vec2& origin, double height) {
  for (const Polygon& stroke : stroke_text(line, origin, height)) add_open(layer, stroke);
}

std::string dxf_text(const DxfDocument& document, DxfVersion version) {
  for (const DxfPath& path : document.paths) {
    if (path.circle) {
      demand(path.circle->diameter > 0 && path.circle->centre.allFinite(),
             "a circle on layer " + path.layer + " is not finite or has no diameter");
      continue;
    }
    demand(path.vertices.size() >= 2, "a path on layer " + path.layer + " has fewer than two points");
    for (const BulgeVertex& vertex : path.vertices)
      demand(vertex.place.allFinite(), "a point on layer " + path.layer + " is not finite");
  }
  return version == DxfVersion::r12 ? r12_text(document) : ac1015_text(document);
}

Box2d bounding_box(const std::vector<DxfPath>& paths) {
  Polygon corners;
  for (const DxfPath& path : paths) {
    if (path.circle) {
      const Vec2 reach = Vec2::Constant(0.5 * path.circle->diameter);
      corners.insert(corners.end(), {path.circle->centre - reach, path.circle->centre + reach});
      continue;
    }
    const Box2d box = bounding_box(sampled_bulges(path.vertices, path.closed, k_box_sagitta).points);
    corners.insert(corners.end(), {box.low, box.high});
  }
  return bounding_box(corners);
}

}  // namespace fusee::formats
