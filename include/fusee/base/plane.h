/// \file
/// Points, directions and closed polygons in the plane of the mechanism. mm.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

namespace fusee {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;

/// A closed polygon; the last point joins the first and is not repeated. Outlines run counter-clockwise.
using Polygon = std::vector<Vec2>;

/// Unit vector at `angle` (rad, counter-clockwise from +x).
inline Vec2 unit(double angle) { return {std::cos(angle), std::sin(angle)}; }
/// `v` rotated counter-clockwise by `angle` (rad).
Vec2 turned(const Vec2& v, double angle);
/// `v` rotated by +90°.
inline Vec2 turned_left(const Vec2& v) { return {-v.y(), v.x()}; }
inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Signed area: positive when counter-clockwise. mm².
double signed_area(const Polygon& polygon);
/// Length of the closed boundary. mm.
double perimeter(const Polygon& polygon);
/// Radius of the smallest circle about the origin that contains the polygon. mm.
double circumradius(const Polygon& polygon);
/// Distance from `point` to the segment ab. mm.
double distance_to_segment(const Vec2& point, const Vec2& a, const Vec2& b);
/// Distance from `point` to the nearest edge of a closed polygon; infinite when the polygon is empty. mm.
double distance_to_edges(const Polygon& polygon, const Vec2& point);
/// The convex hull, counter-clockwise, without collinear points.
Polygon convex_hull(Polygon points);

}  // namespace fusee
