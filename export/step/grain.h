/// \file
/// Internal: rounding of coordinates in STEP files.
#pragma once

#include <cmath>

#include "fusee/base.h"

namespace fusee::formats {

/// Resolution of written poles, mm: a tenth of the file's stated accuracy, which saves a fifth of the bytes.
inline double rounded_to_grain(double value) {
  constexpr double k_grain = 1e-6;
  // + 0.0 avoids negative zero.
  return std::round(value / k_grain) * k_grain + 0.0;
}
inline Vec2 rounded_to_grain(const Vec2& point) { return {rounded_to_grain(point.x()), rounded_to_grain(point.y())}; }
inline Vec3 rounded_to_grain(const Vec3& point) {
  return {rounded_to_grain(point.x()), rounded_to_grain(point.y()), rounded_to_grain(point.z())};
}

}  // namespace fusee::formats
