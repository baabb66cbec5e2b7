/// \file
/// Rectangles on sheets. mm.
#pragma once

#include <vector>

#include "fusee/base/plane.h"

namespace fusee {

struct NestedPlace {
  int sheet = 0;
  Vec2 corner = Vec2::Zero();  ///< lower left, on its sheet
  bool fits = true;            ///< false: larger than a sheet; it has one to itself and stands over
};

/// Shelves: the tallest first, from left to right, then the next shelf, then the next sheet. `gap` between all and to
/// the edge. One place a size, in their order.
std::vector<NestedPlace> nest(const std::vector<Vec2>& sizes, const Vec2& sheet, double gap);

}  // namespace fusee
