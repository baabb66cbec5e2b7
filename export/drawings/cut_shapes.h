/// \file
/// The part's outlines as they are cut and not printed, and what a cutter makes of them. mm.
#pragma once

#include <optional>
#include <vector>

#include "export/drawings/plane_shapes.h"
#include "fusee/base/plane.h"
#include "fusee/export/product.h"

namespace fusee {

/// Of the product's body, where it is known already.
BodyLayout layout_to_cut(const Product& product);

/// The bore as it is cut: a circle, arcs and flats, or corners.
Contour bore_contour(const BoreLayout& bore);

/// Every edge moved outward by `distance` (inward when negative), corners mitred: exact for the polygon.
/// Counter-clockwise in and out. Sense is lost where an edge is shorter than what is taken away: is_simple() and the
/// area tell.
Polygon offset_edges(const Polygon& polygon, double distance);

/// Cutter's path round a plate of this outline, `distance` outside of it: offset_edges(), without the edges that would
/// turn round in a hollow that is shorter than the cutter is wide.
Polygon cut_round(const Polygon& outline, double distance);

/// Cutter's path for a hole of this outline: half a kerf inside it, a circle for a circle and an arc for an arc. Null
/// when the kerf is wider than the hole somewhere.
std::optional<Contour> cut_hole(const Contour& hole, double kerf);

bool contains(const Polygon& polygon, const Vec2& point);

/// The material of a plate: within all of its outlines, outside all of its holes.
class Material2d {
 public:
  void add_outline(const Polygon& outline);
  void add_hole(const Polygon& hole);
  /// Is `point` in the material, `margin` or more away from every edge?
  bool holds(const Vec2& point, double margin) const;
  /// Every point of an axis-parallel box, looked at on a grid of a millimetre.
  bool holds_box(const Vec2& low, const Vec2& size, double margin) const;

 private:
  struct Edges {
    Polygon points;
    Vec2 low, high;
  };
  std::vector<Edges> outlines_;
  std::vector<Edges> holes_;
};

}  // namespace fusee
