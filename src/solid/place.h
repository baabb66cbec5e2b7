/// \file
/// Internal: text for a place on a part.
#pragma once

#include <string>

#include "fusee/base.h"
#include "base/text.h"

namespace fusee {

/// "(3.100, 4.200, 0.000) mm"
inline std::string place_of(const Vec3& point) {
  return "(" + fixed(point.x(), 3) + ", " + fixed(point.y(), 3) + ", " + fixed(point.z(), 3) + ") mm";
}

}  // namespace fusee
