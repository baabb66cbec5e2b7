/// \file
/// Internal: rectangles, circles, contours and boxes for drawings. mm.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "export/drawings/sampled_curves.h"
#include "fusee/base.h"
#include "fusee/solid.h"

namespace fusee::formats {

Polygon shifted(Polygon points, const Vec2& shift);
/// The axis-aligned rectangle with the corners `low` and `high`, counter-clockwise.
Polygon rectangle(const Vec2& low, const Vec2& high);
/// A circle as a regular polygon, counter-clockwise, with its corners *on* the circle; sagitta at most 0.002 mm, at
/// least 24 corners.
Polygon circle_polygon(const Vec2& centre, double radius);

/// A closed contour: the polygon for measurements, and its round parts for drawing.
struct Contour {
  Polygon points;
  std::optional<solid::RoundHole> circle;  ///< the whole contour is this circle
  std::size_t arc_points = 0;              ///< number of the first points that lie on one arc about the origin
};

Contour circle_contour(const solid::RoundHole& hole);
/// The vertices of a contour that is not a circle; its arc is one edge with a bulge.
std::vector<BulgeVertex> vertices_of(const Contour& contour);
/// The angle from `from` to `to` about the origin, counter-clockwise, in (0, 2π]. rad.
double turn_between(const Vec2& from, const Vec2& to);

struct Box2d {
  Vec2 low = Vec2::Zero();
  Vec2 high = Vec2::Zero();
  Vec2 size() const { return high - low; }
};
/// The smallest box around all points; both corners at the origin if there are none.
Box2d bounding_box(const Polygon& points);

}  // namespace fusee::formats
