/// \file
/// Internal: places rectangles on sheets. mm.
#pragma once

#include <vector>

#include "fusee/base.h"

namespace fusee::formats {

struct NestedPlace {
  int sheet = 0;
  Vec2 corner = Vec2::Zero();  ///< lower left corner on its sheet
  bool fits = true;            ///< false: larger than a sheet; placed alone on one and extending beyond it
};

/// Shelf packing: tallest first, left to right, then the next shelf, then the next sheet. `gap`: distance between
/// rectangles and from the sheet's edge. Returns one place for each size, in the order of `sizes`.
std::vector<NestedPlace> nest(const std::vector<Vec2>& sizes, const Vec2& sheet, double gap);

}  // namespace fusee::formats
