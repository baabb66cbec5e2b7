#include <algorithm>
#include <cmath>

#include "fusee/base.h"
#include "fusee/profile.h"

namespace fusee::profile {

bool Outline::is_active(std::size_t i) const {
  return active_first <= active_last ? active_first <= i && i <= active_last : i >= active_first || i <= active_last;
}

Polygon parallel(const Outline& outline, double distance) {
  Polygon polygon;
  polygon.reserve(outline.points.size());
  for (const OutlinePoint& point : outline.points) polygon.push_back(point.position + distance * point.normal);
  return polygon;
}

double sagitta(const Vec2& from, double psi_from, const Vec2& to, double psi_to) {
  const Vec2 along = to - from;
  const double chord = along.norm(), turn = std::remainder(psi_to - psi_from, k_two_pi);
  // Angles from the tangent at `from` to the chord, and from there to the tangent at `to`.
  const double first = std::remainder(elementary::atan2(along.y(), along.x()) - psi_from - 0.5 * k_pi, k_two_pi);
  const double second = turn - first;
  const double of_an_arc = chord * turn / 8.0;
  if (!(first > 0) || !(second > 0)) return of_an_arc;
  return std::min(of_an_arc, chord / (1.0 / elementary::tan(first) + 1.0 / elementary::tan(second)));
}

}  // namespace fusee::profile
