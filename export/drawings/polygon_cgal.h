/// \file
/// What drawings need of exact polygon geometry; the only file of this room that includes CGAL is its .cpp.
#pragma once

#include <vector>

#include "fusee/base/plane.h"

namespace fusee {

/// +1 when a, b, c turn left, −1 right, 0 when they are exactly on one line.
int orientation(const Vec2& a, const Vec2& b, const Vec2& c);

/// Does the closed polygon neither cross nor touch itself, with three corners at least?
bool is_simple(const Polygon& polygon);

/// `plate` without the cutters, all simple polygons: outer outlines counter-clockwise and holes clockwise, the largest
/// first.
std::vector<Polygon> difference(const Polygon& plate, const std::vector<Polygon>& cutters);

}  // namespace fusee
