#include "profile/polar_curve.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

namespace fusee::profile {
namespace {

/// Number of chords of the active arc, and of the arc that closes it.
constexpr int k_points = 1440;

struct PolarPoint {
  double angle = 0;
  double r = 0;
  double slope = 0;  ///< dr/dangle
};

/// Direction of the outward normal of a curve r(angle).
double normal_of(const PolarPoint& point) { return point.angle - elementary::atan2(point.slope, point.r); }
Vec2 position_of(const PolarPoint& point) { return point.r * unit(point.angle); }

/// The radius at the fraction u of the closing side: a cubic with the radii and slopes of both ends, limited to between
/// 0.8 of the smaller radius and the larger radius.
double closing_radius(const PolarPoint& begin, const PolarPoint& end, double u) {
  const double span = end.angle - begin.angle;
  const double v = 1.0 - u;
  const double cubic =
      begin.r * v * v * (1 + 2 * u) + end.r * u * u * (3 - 2 * u) + span * u * v * (begin.slope * v - end.slope * u);
  return std::clamp(cubic, 0.8 * std::min(begin.r, end.r), std::max(begin.r, end.r));
}

/// The active arc of the drawing: the stroke in the image, evenly spaced in the pulley's angle, which is the angle of
/// the drawing.
std::vector<PolarPoint> active_points(const TakeOffs& take_offs) {
  const transmission::Transmission& transmission = take_offs.transmission();
  const double sign = transmission::mirror_sign(take_offs.side());
  const double begin = sign > 0 ? transmission.alpha_min() : -transmission.alpha_max();
  const double end = sign > 0 ? transmission.alpha_max() : -transmission.alpha_min();
  const double home_normal = take_offs.at(0.0).curve.psi;
  std::vector<PolarPoint> points;
  for (int i = 0; i <= k_points; ++i) {
    TakeOff at;
    at.stroke = transmission.at_alpha(sign * (begin + (end - begin) * i / k_points));
    const transmission::TendonPoint& tendon = take_offs.tendon(at);
    points.push_back({home_normal + sign * at.stroke.alpha, tendon.p, sign * tendon.dp});
  }
  return points;
}

Polygon closed_drawing(const std::vector<PolarPoint>& active) {
  Polygon drawing;
  for (const PolarPoint& point : active) drawing.push_back(position_of(point));
  PolarPoint next_turn = active.front();
  next_turn.angle += k_two_pi;
  const PolarPoint& begin = active.back();
  for (int i = 1; i < k_points; ++i) {
    const double u = static_cast<double>(i) / k_points;
    drawing.push_back(closing_radius(begin, next_turn, u) * unit(begin.angle + (next_turn.angle - begin.angle) * u));
  }
  return drawing;
}

/// Outward normals of the edges of a convex polygon, increasing.
std::vector<double> edge_normals(const Polygon& hull) {
  std::vector<double> normals;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 edge = hull[(i + 1) % hull.size()] - hull[i];
    const double normal = elementary::atan2(edge.y(), edge.x()) - 0.5 * k_pi;
    normals.push_back(i == 0 ? normal : turned_into(normals.back(), normal));
  }
  return normals;
}

/// A half plane {x : x·normal <= limit}.
struct HalfPlane {
  Vec2 normal;
  double limit = 0;

  double outside(const Vec2& point) const { return normal.dot(point) - limit; }
};

std::vector<HalfPlane> half_planes(const Polygon& hull) {
  std::vector<HalfPlane> planes;
  const std::vector<double> normals = edge_normals(hull);
  for (std::size_t i = 0; i < hull.size(); ++i) planes.push_back({unit(normals[i]), unit(normals[i]).dot(hull[i])});
  return planes;
}

/// Intersection of the borders of two half planes.
Vec2 corner_of(const HalfPlane& a, const HalfPlane& b) {
  const double sine = cross(a.normal, b.normal);
  return (a.limit * -turned_left(b.normal) + b.limit * turned_left(a.normal)) / sine;
}

/// A convex polygon with all edges moved inward. The half planes are sorted by direction; redundant ones are dropped.
Polygon shrunk(const Polygon& hull, double distance) {
  std::deque<HalfPlane> kept;
  for (HalfPlane plane : half_planes(hull)) {
    plane.limit -= distance;
    while (kept.size() > 1 && plane.outside(corner_of(kept[kept.size() - 2], kept.back())) >= 0) kept.pop_back();
    while (kept.size() > 1 && plane.outside(corner_of(kept[0], kept[1])) >= 0) kept.pop_front();
    kept.push_back(plane);
  }
  while (kept.size() > 2 && kept.front().outside(corner_of(kept[kept.size() - 2], kept.back())) >= 0) kept.pop_back();
  Polygon corners;
  for (std::size_t i = 0; i < kept.size(); ++i) corners.push_back(corner_of(kept[i], kept[(i + 1) % kept.size()]));
  return convex_hull(corners);
}

/// Maximum depth of `points` inside their convex `hull`. Most points are corners of the hull and are skipped.
double hollow_depth(const Polygon& hull, const std::vector<PolarPoint>& points) {
  double deepest = 0;
  const std::vector<HalfPlane> planes = half_planes(hull);
  const auto in_order = [](const Vec2& a, const Vec2& b) { return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y()); };
  Polygon corners = hull;
  std::sort(corners.begin(), corners.end(), in_order);
  for (const PolarPoint& point : points) {
    const Vec2 position = position_of(point);
    if (std::binary_search(corners.begin(), corners.end(), position, in_order)) continue;
    double inside = point.r;
    for (const HalfPlane& plane : planes) inside = std::min(inside, -plane.outside(position));
    deepest = std::max(deepest, inside);
  }
  return deepest;
}

}  // namespace

PolarCurve::PolarCurve(const Mechanism& mechanism, const TakeOffs& take_offs)
    : rounding_(0.5 * mechanism.tendon.diameter + k_least_floor_radius) {
  const std::vector<PolarPoint> active = active_points(take_offs);
  active_begin_ = normal_of(active.front());
  active_end_ = normal_of(active.back());
  const Polygon hull = convex_hull(closed_drawing(active));
  deepest_hollow_ = hollow_depth(hull, active);
  core_ = shrunk(hull, rounding_);
  normals_ = edge_normals(core_);
}

Vec2 PolarCurve::position(double psi) const {
  const double turned = turned_into(normals_.front(), psi);
  const auto after = std::upper_bound(normals_.begin(), normals_.end(), turned);
  // Corner i + 1 lies between the normals of the edges that reach and leave it.
  const auto corner = static_cast<std::size_t>(after - normals_.begin()) % core_.size();
  return core_[corner] + rounding_ * unit(psi);
}

CurvePoint PolarCurve::at(double psi) const {
  constexpr double probe = radians(1.0);
  const Vec2 x = position(psi);
  // Difference quotients to both sides, since ρ = |dX/dψ|. A quotient across a bridge, the straight edge over a hollow,
  // is too large, so the smaller counts.
  const double radius = std::min((position(psi + probe) - x).norm(), (x - position(psi - probe)).norm()) / probe;
  return {psi, x.dot(unit(psi)), x.dot(turned_left(unit(psi))), radius};
}

std::vector<double> PolarCurve::straight_directions() const {
  std::vector<double> directions;
  // Edges much longer than the spacing of the drawn points are bridges.
  const double long_edge = 20.0 * perimeter(core_) / k_points;
  for (std::size_t i = 0; i < core_.size(); ++i) {
    const double length = (core_[(i + 1) % core_.size()] - core_[i]).norm();
    if (length > long_edge) directions.push_back(normals_[i]);
  }
  return directions;
}

}  // namespace fusee::profile
