#include "rig/string_geometry.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text.h"
#include "fusee/base.h"

namespace fusee::rig {
namespace {

/// Unit direction of the tangent from a circle of `radius` about the start of `span` to the end of `span`. The tangent
/// has the length `straight`.
Vec2 leaving_circle(const Vec2& span, double radius, double straight) {
  return (straight * span - radius * turned_left(span)) / span.squaredNorm();
}

std::size_t wrapped(std::ptrdiff_t corner, std::size_t count) {
  const auto n = static_cast<std::ptrdiff_t>(count);
  return static_cast<std::size_t>(((corner % n) + n) % n);
}

/// True for all corners of a closed polygon, and for the corners of a spiral.
bool has_corner(const Hull& hull, std::ptrdiff_t corner) {
  return !hull.is_helical() || (corner >= 0 && corner < std::ssize(hull.corners));
}

double arc_at(const Hull& hull, std::ptrdiff_t corner) {
  const std::size_t within = wrapped(corner, hull.corners.size());
  const auto turns = (corner - static_cast<std::ptrdiff_t>(within)) / static_cast<std::ptrdiff_t>(hull.corners.size());
  return static_cast<double>(turns) * hull.around + hull.arc[within];
}

}  // namespace

Hull hull_of(const Polygon& points) {
  Hull hull;
  hull.corners = convex_hull(points);
  for (std::size_t i = 0; i < hull.corners.size(); ++i) {
    hull.arc.push_back(hull.around);
    hull.around += (hull.corners[(i + 1) % hull.corners.size()] - hull.corners[i]).norm();
  }
  return hull;
}

Hull spiral_of(Polygon corners, std::vector<double> height, std::ptrdiff_t home) {
  Hull hull;
  hull.corners = std::move(corners);
  hull.height = std::move(height);
  hull.home = home;
  hull.arc.push_back(0);
  for (std::size_t i = 1; i < hull.corners.size(); ++i) {
    const double along = (hull.corners[i] - hull.corners[i - 1]).norm();
    hull.arc.push_back(hull.arc.back() + std::hypot(along, hull.height[i] - hull.height[i - 1]));
  }
  hull.around = hull.arc.back();
  return hull;
}

UpperString upper_string(const Vec2& from, const Circle& pin) {
  const Vec2 span = pin.centre - from;
  const double straight = std::sqrt(span.squaredNorm() - pin.radius * pin.radius);
  // The circle is at the far end of the span, which mirrors the offset.
  const Vec2 along = (straight * span + pin.radius * turned_left(span)) / span.squaredNorm();
  return {straight, turned_left(along), cross(along, from)};
}

LowerString lower_string(const Hull& hull, const Circle& pin, std::ptrdiff_t near) {
  const std::size_t count = hull.corners.size();
  LowerString string;
  string.corner = near;
  for (std::size_t steps = 0; steps <= 2 * count; ++steps) {
    const Vec2& corner = hull.corners[wrapped(string.corner, count)];
    const Vec2 span = corner - pin.centre;
    string.length = std::sqrt(span.squaredNorm() - pin.radius * pin.radius);
    if (!(string.length > 0)) break;
    const Vec2 along = leaving_circle(span, pin.radius, string.length);
    string.normal = turned_left(along);
    if (!has_corner(hull, string.corner - 1) || !has_corner(hull, string.corner + 1)) break;
    const auto beyond = [&](std::ptrdiff_t other) {
      return string.normal.dot(hull.corners[wrapped(other, count)] - corner);
    };
    if (beyond(string.corner + 1) > 0) {
      ++string.corner;
    } else if (beyond(string.corner - 1) > 0) {
      --string.corner;
    } else {
      string.arc = arc_at(hull, string.corner);
      string.arm = string.normal.dot(corner);
      if (hull.is_helical()) string.height = hull.height[static_cast<std::size_t>(string.corner)];
      return string;
    }
  }
  throw InputError("rig", "no string runs from a pin at (" + rounded(pin.centre.x()) + ", " + rounded(pin.centre.y()) +
                              ") mm from the axis to the pulley");
}

std::ptrdiff_t initial_corner(const Hull& hull, const Circle& pin) {
  if (hull.is_helical()) return hull.home;
  const Vec2 outwards = -turned_left(pin.centre);
  const auto further = [&](const Vec2& a, const Vec2& b) { return outwards.dot(a) < outwards.dot(b); };
  return std::max_element(hull.corners.begin(), hull.corners.end(), further) - hull.corners.begin();
}

}  // namespace fusee::rig
