/// \file
/// Internal: outlines of the part for cutting instead of printing, and their compensation for the cutter. mm.
#pragma once

#include <optional>
#include <vector>

#include "export/drawings/plane_shapes.h"
#include "fusee/base.h"
#include "fusee/export.h"

namespace fusee::formats {

/// The layout of the product for cutting.
solid::BodyLayout layout_to_cut(const Product& product);

/// The bore as it is cut: a circle, arcs and flats, or corners.
Contour bore_contour(const solid::BoreLayout& bore);

/// Moves every edge outward by `distance` (inward if negative) with mitred corners, exactly for the polygon. Input and
/// output are counter-clockwise. An edge that is shortened by more than its length points the other way:
/// is_simple() or the sign of the area reveals it.
Polygon offset_edges(const Polygon& polygon, double distance);

/// The cutter's path around a plate of this outline, `distance` outside it: offset_edges() without the edges that would
/// be inverted where a concave corner is narrower than the cutter.
Polygon cut_around(const Polygon& outline, double distance);

/// The cutter's path for a hole of this outline: half a kerf inside it, with circles and arcs kept. Empty if the kerf
/// is wider than the hole somewhere.
std::optional<Contour> cut_hole(const Contour& hole, double kerf);

bool contains(const Polygon& polygon, const Vec2& point);

/// The material of a plate: within all of its outlines, outside all of its holes.
class Material2d {
 public:
  void add_outline(const Polygon& outline);
  void add_hole(const Polygon& hole);
  /// True if `point` is in the material and at least `margin` away from every edge.
  bool holds(const Vec2& point, double margin) const;
  /// True if holds() is true at every point of a grid over an axis-aligned box. The grid's steps are at most 1 mm.
  bool holds_box(const Vec2& low, const Vec2& size, double margin) const;

 private:
  struct Edges {
    Polygon points;
    Vec2 low, high;
  };
  std::vector<Edges> outlines_;
  std::vector<Edges> holes_;
};

}  // namespace fusee::formats
