/// \file
/// Internal: places rectangles on sheets. mm.
#pragma once

#include <vector>

#include "fusee/base.h"

namespace fusee::formats {

struct NestedPlace {
  int sheet = 0;
  Vec2 corner = Vec2::Zero();  ///< lower left corner on its sheet
  bool fits = true;            ///< false: larger than a sheet, so that it extends beyond its sheet
};

inline constexpr double k_sheet_gap = 20;  // mm, between sheets side by side

/// Corner of the drawing's sheet with this index, the first at the origin.
inline Vec2 sheet_corner(int index, const Vec2& sheet) { return {index * (sheet.x() + k_sheet_gap), 0}; }
/// Lower left corner of a nested rectangle on the drawing.
inline Vec2 corner_on_drawing(const NestedPlace& place, const Vec2& sheet) {
  return place.corner + sheet_corner(place.sheet, sheet);
}
/// Number of sheets with a rectangle on them; 1 without rectangles.
int sheet_count(const std::vector<NestedPlace>& places);

/// Shelf packing: tallest first, left to right, then the next shelf, then the next sheet. `gap`: distance between
/// rectangles and from the sheet's edge. Returns one place for each size, in the order of `sizes`.
std::vector<NestedPlace> nest(const std::vector<Vec2>& sizes, const Vec2& sheet, double gap);

}  // namespace fusee::formats
