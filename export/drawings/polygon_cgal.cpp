#include "export/drawings/polygon_cgal.h"

#include <CGAL/Boolean_set_operations_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_set_2.h>
#include <CGAL/Polygon_with_holes_2.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "fusee/base.h"

namespace fusee::formats {
namespace {

using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactPolygon = CGAL::Polygon_2<Exact>;

ExactPolygon points_of(const Polygon& polygon) {
  ExactPolygon result;
  for (const Vec2& p : polygon) result.push_back({p.x(), p.y()});
  return result;
}

/// Counter-clockwise. Throws Bug for a polygon that crosses itself.
ExactPolygon exact(const Polygon& polygon) {
  ExactPolygon result = points_of(polygon);
  demand(result.is_simple(), "a plate's outline of " + std::to_string(polygon.size()) + " points crosses itself");
  if (result.is_clockwise_oriented()) result.reverse_orientation();
  return result;
}

/// The corners in double precision, with coincident ones merged.
Polygon rounded_points(const ExactPolygon& polygon) {
  constexpr double k_same = 1e-7;  // mm
  Polygon result;
  for (const auto& p : polygon.container()) {
    const Vec2 point(CGAL::to_double(p.x()), CGAL::to_double(p.y()));
    if (result.empty() || (point - result.back()).norm() > k_same) result.push_back(point);
  }
  while (result.size() > 1 && (result.front() - result.back()).norm() <= k_same) result.pop_back();
  return result;
}

}  // namespace

int orientation(const Vec2& a, const Vec2& b, const Vec2& c) {
  using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_2;
  return static_cast<int>(CGAL::orientation(Point(a.x(), a.y()), Point(b.x(), b.y()), Point(c.x(), c.y())));
}

bool is_simple(const Polygon& polygon) { return polygon.size() >= 3 && points_of(polygon).is_simple(); }

std::vector<Polygon> difference(const Polygon& plate, const std::vector<Polygon>& cutters) {
  CGAL::Polygon_set_2<Exact> remaining(exact(plate));
  for (const Polygon& cutter : cutters) remaining.difference(exact(cutter));
  std::vector<CGAL::Polygon_with_holes_2<Exact>> parts;
  remaining.polygons_with_holes(std::back_inserter(parts));
  std::vector<Polygon> loops;
  for (const auto& part : parts) {
    loops.push_back(rounded_points(part.outer_boundary()));
    for (const auto& hole : part.holes()) loops.push_back(rounded_points(hole));
  }
  std::stable_sort(loops.begin(), loops.end(), [](const Polygon& a, const Polygon& b) {
    return std::abs(signed_area(a)) > std::abs(signed_area(b));
  });
  return loops;
}

}  // namespace fusee::formats
