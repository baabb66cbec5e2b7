/// \file
/// Internal: exact polygon geometry for drawings. CGAL is included only by the .cpp.
#pragma once

#include <vector>

#include "fusee/base.h"

namespace fusee::formats {

/// +1 if a, b, c turn left, −1 if right, 0 if they are exactly collinear.
int orientation(const Vec2& a, const Vec2& b, const Vec2& c);

/// True if the closed polygon has at least three corners and neither crosses nor touches itself.
bool is_simple(const Polygon& polygon);

/// `plate` minus the cutters, all simple polygons. Outer outlines are counter-clockwise and holes clockwise, the
/// largest first.
std::vector<Polygon> difference(const Polygon& plate, const std::vector<Polygon>& cutters);

}  // namespace fusee::formats
