/// \file
/// Internal: solid angles of triangles, for winding numbers.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "fusee/base.h"

namespace fusee::solid {

/// Solid angle of the triangle a, b, c seen from the origin; positive if the corners run counter-clockwise seen from
/// the other side. Van Oosterom and Strackee 1983.
inline double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2.0 * elementary::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

}  // namespace fusee::solid
