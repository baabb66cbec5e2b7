/// \file
/// Internal: text for a place on a part.
#pragma once

#include <string>

#include "base/text.h"
#include "fusee/base.h"

namespace fusee::solid {

/// "(3.100, 4.200, 0.000) mm"
inline std::string place_of(const Vec3& point) {
  return "(" + fixed(point.x(), 3) + ", " + fixed(point.y(), 3) + ", " + fixed(point.z(), 3) + ") mm";
}

}  // namespace fusee::solid
