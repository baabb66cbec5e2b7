/// \file
/// Internal: a drawing of polylines and circles as DXF text. AC1015 (AutoCAD 2000) has every table, owner and
/// dictionary that strict readers require. R12 (AC1009) is for laser shops. Millimetres, nine decimals. No splines or
/// text entities: an arc is a polyline's bulge, a helical curve a 3-D polyline, and text is drawn as strokes.
#pragma once

#include <string>
#include <vector>

#include "export/drawings/plane_shapes.h"
#include "fusee/base.h"
#include "fusee/export.h"

namespace fusee::formats {

struct DxfLayer {
  std::string name;
  int colour = 7;       ///< AutoCAD colour index
  bool plotted = true;  ///< false for a layer that is neither plotted nor cut
};

struct DxfPath {
  std::string layer;
  std::vector<BulgeVertex> vertices;  ///< empty for a circle
  bool closed = true;
  std::optional<solid::RoundHole> circle;
  std::vector<double> heights = {};  ///< z of the vertices of a 3-D polyline; empty in the plane
};

struct DxfDocument {
  std::vector<std::string> remarks;  ///< comments (group 999) at the top of the file
  std::vector<DxfLayer> layers;
  std::vector<DxfPath> paths;  ///< drawn in this order

  void add_closed(std::string layer, const Polygon& points) { add_closed(std::move(layer), Contour{points, {}, 0}); }
  void add_closed(std::string layer, const Contour& contour, const Vec2& shift = Vec2::Zero());
  void add_closed_arcs(std::string layer, std::vector<BulgeVertex> vertices);
  void add_open(std::string layer, const Polygon& points);
  /// Adds an open 3-D polyline.
  void add_in_space(std::string layer, const std::vector<Vec3>& points);
  /// Adds a line of single-stroke text with its lower left corner at `origin`.
  void add_text(const std::string& layer, std::string_view text, const Vec2& origin, double height);
};

std::string dxf_text(const DxfDocument& document, DxfVersion version);

/// The box around all points of all paths.
Box2d bounding_box(const std::vector<DxfPath>& paths);

}  // namespace fusee::formats
