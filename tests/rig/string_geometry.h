/// \file
/// A taut string between a point, a round pin and a convex polygon, by tangents alone. Right-hand image: the string
/// runs down on the right of pin and pulley. mm, rad.
///
/// Uses no equation of the transmission: no support functions, no moment-arm formulas.
#pragma once

#include <cstddef>
#include <vector>

#include "fusee/base.h"

namespace fusee::rig {

struct Circle {
  Vec2 centre = Vec2::Zero();
  double radius = 0;
};

/// A strictly convex polygon, counter-clockwise, with the length along it to each corner; or a spiral, which is open
/// and climbs.
struct Hull {
  Polygon corners;
  std::vector<double> arc;     ///< from corner 0 to corner i
  double around = 0;           ///< once around; of a spiral from end to end
  std::vector<double> height;  ///< of a spiral's corners; empty: all at one height
  std::ptrdiff_t home = 0;     ///< of a spiral: a corner near which the string leaves it at home

  bool is_helical() const { return !height.empty(); }
};

/// Around the points; what is not convex is bridged by the string.
Hull hull_of(const Polygon& points);
/// Counter-clockwise. Lengths along it are those in space.
Hull spiral_of(Polygon corners, std::vector<double> height, std::ptrdiff_t home);

/// The string from its end `from`, down to the pin.
struct UpperString {
  double length = 0;  ///< to the pin's tangent point
  Vec2 normal;        ///< unit, from the pin's centre to the tangent point
  double arm = 0;     ///< of a pull about the origin, clockwise
};
/// `from` must lie outside the pin.
UpperString upper_string(const Vec2& from, const Circle& pin);

/// The string from the pin down to the corner at which it meets the polygon.
struct LowerString {
  double length = 0;          ///< between both points of contact
  Vec2 normal;                ///< unit, outwards, of the straight string
  std::ptrdiff_t corner = 0;  ///< counted on through turns
  double arc = 0;             ///< along the polygon to that corner, counted on through turns
  double arm = 0;             ///< about the origin
  double height = 0;          ///< of that corner
};
/// `near`: start of the search. InputError if the pin lies inside the pulley, or if a spiral ends before.
LowerString lower_string(const Hull& hull, const Circle& pin, std::ptrdiff_t near);

/// A corner near the one that the string meets. Uses a spiral's `home` only.
std::ptrdiff_t initial_corner(const Hull& hull, const Circle& pin);

}  // namespace fusee::rig
