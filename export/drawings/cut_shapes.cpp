#include "export/drawings/cut_shapes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "export/drawings/plane_shapes.h"
#include "export/drawings/polygon_cgal.h"

namespace fusee {
namespace {

/// A print's hole has few facets, tangent to its circle: the circle itself.
Polygon circle_within(const Polygon& facets) {
  const Vec2 centre = std::accumulate(facets.begin(), facets.end(), Vec2(0, 0)) / static_cast<double>(facets.size());
  return circle_polygon(centre, distance_to_edges(facets, centre));
}

/// Offset too far, an edge runs backward.
bool edges_keep_direction(const Polygon& before, const Polygon& after) {
  for (std::size_t i = 0; i < before.size(); ++i) {
    const std::size_t j = (i + 1) % before.size();
    if (!((after[j] - after[i]).dot(before[j] - before[i]) > 0)) return false;
  }
  return true;
}

bool near_an_edge(const Polygon& polygon, const Vec2& point, double margin) {
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    if (distance_to_segment(point, polygon[j], polygon[i]) < margin) return true;
  }
  return false;
}

bool beyond(const Vec2& low, const Vec2& high, const Vec2& point, double margin) {
  return (point - low).minCoeff() < -margin || (high - point).minCoeff() < -margin;
}

}  // namespace

BodyLayout layout_to_cut(const Product& product) {
  Mechanism mechanism = product.joint.mechanism;
  mechanism.material.shrinkage = 0;
  mechanism.material.hole_compensation = 0;
  mechanism.material.elephant_foot = 0;
  BodyLayout layout = resolve_layout(mechanism, product.synthesis);
  if (layout.bore.kind == Bore::round || (layout.bore.kind == Bore::horn && layout.bore.spline_teeth == 0))
    layout.bore.outline = circle_within(layout.bore.outline);
  for (Polygon& hole : layout.bore.screw_holes) hole = circle_within(hole);
  return layout;
}

Polygon offset_edges(const Polygon& polygon, double distance) {
  const std::size_t n = polygon.size();
  const auto outward = [&](std::size_t i) -> Vec2 {
    return -turned_left(polygon[(i + 1) % n] - polygon[i]).normalized();
  };
  Polygon moved;
  moved.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 before = outward((i + n - 1) % n);
    const Vec2 after = outward(i);
    // The mitre's tip is (before + after)/(1 + cos); a needle's tip is cut at ten times the distance.
    moved.push_back(polygon[i] + distance * (before + after) / std::max(1 + before.dot(after), 0.02));
  }
  return moved;
}

std::optional<Polygon> cut_hole(const Polygon& hole, double kerf) {
  Polygon path = offset_edges(hole, -0.5 * kerf);
  if (!edges_keep_direction(hole, path) || !is_simple(path)) return std::nullopt;
  return path;
}

bool contains(const Polygon& polygon, const Vec2& p) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vec2& a = polygon[i];
    const Vec2& b = polygon[j];
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()))
      inside = !inside;
  }
  return inside;
}

void Material2d::add_outline(const Polygon& outline) {
  const Box2d box = bounding_box(outline);
  outlines_.push_back({outline, box.low, box.high});
}

void Material2d::add_hole(const Polygon& hole) {
  const Box2d box = bounding_box(hole);
  holes_.push_back({hole, box.low, box.high});
}

bool Material2d::holds(const Vec2& point, double margin) const {
  for (const Edges& hole : holes_) {
    if (beyond(hole.low, hole.high, point, margin)) continue;
    if (contains(hole.points, point) || near_an_edge(hole.points, point, margin)) return false;
  }
  return std::all_of(outlines_.begin(), outlines_.end(), [&](const Edges& outline) {
    return !beyond(outline.low, outline.high, point, 0) && contains(outline.points, point) &&
           !near_an_edge(outline.points, point, margin);
  });
}

bool Material2d::holds_box(const Vec2& low, const Vec2& size, double margin) const {
  const int columns = static_cast<int>(std::ceil(size.x())) + 1;
  const int rows = static_cast<int>(std::ceil(size.y())) + 1;
  const auto at = [&](int i, int j) { return holds(low + Vec2(size.x() * i / columns, size.y() * j / rows), margin); };
  // The corners fail first where anything does.
  if (!at(0, 0) || !at(columns, 0) || !at(0, rows) || !at(columns, rows)) return false;
  for (int i = 0; i <= columns; ++i) {
    for (int j = 0; j <= rows; ++j) {
      if (!at(i, j)) return false;
    }
  }
  return true;
}

}  // namespace fusee
