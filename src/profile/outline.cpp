#include "fusee/profile/outline.h"

namespace fusee {

bool Outline::is_active(std::size_t i) const {
  return active_first <= active_last ? active_first <= i && i <= active_last : i >= active_first || i <= active_last;
}

Polygon parallel(const Outline& outline, double distance) {
  Polygon polygon;
  polygon.reserve(outline.points.size());
  for (const OutlinePoint& point : outline.points) polygon.push_back(point.position + distance * point.normal);
  return polygon;
}

}  // namespace fusee
