/// \file
/// A drawing of polylines as DXF text: AC1015 (AutoCAD 2000) with every table, owner and dictionary that a strict
/// reader looks for, or R12 (AC1009), which laser shops ask for. Millimetres, nine decimals. No splines, arcs or texts.
#pragma once

#include <string>
#include <vector>

#include "fusee/base/plane.h"
#include "fusee/export/export.h"

namespace fusee {

struct DxfLayer {
  std::string name;
  int colour = 7;       ///< AutoCAD colour index
  bool plotted = true;  ///< false: a layer that is neither plotted nor cut
};

struct DxfPath {
  std::string layer;
  Polygon points;
  bool closed = true;
};

struct DxfDocument {
  std::vector<std::string> remarks;  ///< comments (group 999) at the top of the file
  std::vector<DxfLayer> layers;
  std::vector<DxfPath> paths;  ///< drawn in this order

  void closed(std::string layer, Polygon points) { paths.push_back({std::move(layer), std::move(points), true}); }
  void open(std::string layer, Polygon points) { paths.push_back({std::move(layer), std::move(points), false}); }
  /// A line of single-stroke text; `origin` is its lower left corner.
  void text(const std::string& layer, std::string_view text, const Vec2& origin, double height);
};

std::string dxf_text(const DxfDocument& document, DxfVersion version);

/// The axis-parallel square or rectangle from `low` to `high`, counter-clockwise.
Polygon rectangle(const Vec2& low, const Vec2& high);
/// A circle as a regular polygon, counter-clockwise, its corners *on* the circle; sagitta at most 0.002 mm, 24 corners
/// at least.
Polygon circle_polygon(const Vec2& centre, double radius);
/// Smallest box around all points; both corners at the origin when there are none.
struct Box {
  Vec2 low = Vec2::Zero();
  Vec2 high = Vec2::Zero();
  Vec2 size() const { return high - low; }
};
Box bounding_box(const Polygon& points);
Box bounding_box(const std::vector<DxfPath>& paths);

}  // namespace fusee
