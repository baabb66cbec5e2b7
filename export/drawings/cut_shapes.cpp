#include "export/drawings/cut_shapes.h"

#include <algorithm>
#include <cmath>

#include "export/drawings/plane_shapes.h"
#include "export/drawings/polygon_cgal.h"
#include "solid/bore.h"

namespace fusee::formats {
namespace {

/// The first edge that an excessive offset has inverted; the number of edges if there is none.
std::size_t inverted_edge(const Polygon& before, const Polygon& after) {
  for (std::size_t i = 0; i < before.size(); ++i) {
    const std::size_t j = (i + 1) % before.size();
    if (!((after[j] - after[i]).dot(before[j] - before[i]) > 0)) return i;
  }
  return before.size();
}

/// The point at `radius` from the origin that is nearest to `point`, on the line through `point` and `neighbour`.
Vec2 on_circle(const Vec2& point, const Vec2& neighbour, double radius) {
  const Vec2 direction = (neighbour - point).normalized();
  const double to_foot = -point.dot(direction);
  const Vec2 foot = point + to_foot * direction;
  const double half_chord = std::sqrt(std::max(0.0, radius * radius - foot.squaredNorm()));
  return foot + (to_foot > 0 ? -half_chord : half_chord) * direction;
}

/// Moves the first `count` points onto the arc of this radius about the origin, in equal steps. An offset has moved the
/// arc's chords, so that these points no longer lie on it. The arc ends where the adjacent straight edges meet it.
void put_on_arc(Polygon& points, std::size_t count, double radius) {
  const Vec2 first = on_circle(points.front(), points.back(), radius);
  const Vec2 last = on_circle(points[count - 1], points[count % points.size()], radius);
  const double turn = turn_between(first, last);
  for (std::size_t i = 0; i < count; ++i)
    points[i] = turned(first, turn * static_cast<double>(i) / static_cast<double>(count - 1));
}

bool is_outside_box(const Vec2& low, const Vec2& high, const Vec2& point, double margin) {
  return point.x() - low.x() < -margin || point.y() - low.y() < -margin || high.x() - point.x() < -margin ||
         high.y() - point.y() < -margin;
}

bool is_near_edge(const Polygon& polygon, const Vec2& point, double margin) {
  const double reach = margin * (1.0 + 1e-9);  // edges whose box is further away need no exact distance
  const double left = point.x() - reach, right = point.x() + reach, below = point.y() - reach,
               above = point.y() + reach;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vec2 &a = polygon[j], &b = polygon[i];
    const bool is_far = (a.x() > right && b.x() > right) || (a.x() < left && b.x() < left) ||
                        (a.y() > above && b.y() > above) || (a.y() < below && b.y() < below);
    if (!is_far && distance_to_segment(point, a, b) < margin) return true;
  }
  return false;
}

}  // namespace

// Plates are cut to size: the corrections of a print do not apply.
solid::BodyLayout layout_to_cut(Mechanism mechanism, const profile::SynthesisResult& synthesis) {
  mechanism.material.shrinkage = 0;
  mechanism.material.hole_compensation = 0;
  mechanism.material.elephant_foot = 0;
  return solid::resolve_layout(mechanism, synthesis);
}

// Pockets and bore are at most those of the printed pulley, and the hub is the same. Automatic sizes that are recomputed
// without the chamfer at the bed could be too large for the cut part.
solid::BodyLayout layout_to_cut(const Product& product) {
  solid::BodyLayout layout =
      product.cut_layout ? *product.cut_layout : layout_to_cut(product.joint.mechanism, product.synthesis);
  layout.pocket_radius = std::min(layout.pocket_radius, product.pulley.layout.pocket_radius);
  const solid::BoreLayout& printed = product.pulley.layout.bore;
  if (printed.shaft > 0 && printed.shaft < layout.bore.shaft)
    layout.bore = solid::bore_of_shaft(product.joint.mechanism, printed);
  layout.hub_radius = product.pulley.layout.hub_radius;
  layout.set_screw.present = product.pulley.layout.set_screw.present;
  layout.z_hub = layout.z_top + product.pulley.layout.z_hub - product.pulley.layout.z_top;
  return layout;
}

Contour bore_contour(const solid::BoreLayout& bore) {
  if (bore.circle) return circle_contour(*bore.circle);
  return {bore.outline, std::nullopt, bore.arc_points};
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
    // A mitred corner moves by distance · (n₁ + n₂) / (1 + n₁ · n₂), with the unit normals n₁ and n₂ of both edges.
    // Where the divisor is below this limit, the corner is a needle: it moves by ten times the distance at most.
    constexpr double k_least_divisor = 0.02;
    moved.push_back(polygon[i] + distance * (before + after) / std::max(1 + before.dot(after), k_least_divisor));
  }
  return moved;
}

// An outline corrected for errors of manufacture may be concave by some µm. An inverted edge is replaced by its middle.
Polygon cut_around(const Polygon& outline, double distance) {
  Polygon kept = outline;
  for (;;) {
    Polygon path = offset_edges(kept, distance);
    const std::size_t inverted = inverted_edge(kept, path);
    if (inverted == kept.size() || kept.size() <= 3) return path;
    const std::size_t next = (inverted + 1) % kept.size();
    kept[inverted] = 0.5 * (kept[inverted] + kept[next]);
    kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(next));
  }
}

std::optional<Contour> cut_hole(const Contour& hole, double kerf) {
  Polygon path = offset_edges(hole.points, -0.5 * kerf);
  if (inverted_edge(hole.points, path) < path.size() || !is_simple(path)) return std::nullopt;
  if (hole.circle)
    return Contour{std::move(path), solid::RoundHole{hole.circle->centre, hole.circle->diameter - kerf}, 0};
  if (hole.arc_points > 0) put_on_arc(path, hole.arc_points, hole.points.front().norm() - 0.5 * kerf);
  return Contour{std::move(path), std::nullopt, hole.arc_points};
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
    if (is_outside_box(hole.low, hole.high, point, margin)) continue;
    if (contains(hole.points, point) || is_near_edge(hole.points, point, margin)) return false;
  }
  return std::all_of(outlines_.begin(), outlines_.end(), [&](const Edges& outline) {
    return !is_outside_box(outline.low, outline.high, point, 0) && contains(outline.points, point) &&
           !is_near_edge(outline.points, point, margin);
  });
}

bool Material2d::holds_box(const Vec2& low, const Vec2& size, double margin) const {
  const int columns = static_cast<int>(std::ceil(size.x())) + 1;
  const int rows = static_cast<int>(std::ceil(size.y())) + 1;
  const auto at = [&](int i, int j) { return holds(low + Vec2(size.x() * i / columns, size.y() * j / rows), margin); };
  // Corners first: if any point fails, one of them usually does.
  if (!at(0, 0) || !at(columns, 0) || !at(0, rows) || !at(columns, rows)) return false;
  for (int i = 0; i <= columns; ++i) {
    for (int j = 0; j <= rows; ++j) {
      if (!at(i, j)) return false;
    }
  }
  return true;
}

}  // namespace fusee::formats
