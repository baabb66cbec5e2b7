#include "export/drawings/sampled_curves.h"

#include <algorithm>
#include <cmath>

#include "fusee/base.h"

namespace fusee::formats {
namespace {

constexpr int k_most_steps = 20'000;  // per arc

/// Number of chords. A chord that spans the angle φ has the sagitta r φ² / 8.
int arc_steps(double radius, double turn, double sagitta) {
  constexpr int k_steps_of_tiny_arc = 8;
  if (!(radius > sagitta)) return k_steps_of_tiny_arc;
  const double steps = std::ceil(std::abs(turn) / std::sqrt(8 * sagitta / radius));
  return static_cast<int>(std::clamp(steps, 2.0, static_cast<double>(k_most_steps)));
}

/// Diameter of the circle that the arc belongs to; empty for an ellipse.
std::optional<double> diameter_of(const EllipticArc& arc) {
  constexpr double k_round = 1e-9;
  const double radius = arc.u.norm();
  const bool is_round =
      std::abs(arc.v.norm() - radius) <= k_round * radius && std::abs(arc.u.dot(arc.v)) <= k_round * radius * radius;
  return is_round ? std::optional<double>(2 * radius) : std::nullopt;
}

/// The semi-major axis: the square root of the larger eigenvalue of u uᵀ + v vᵀ.
double longest_radius(const EllipticArc& arc) {
  const double uu = arc.u.squaredNorm(), vv = arc.v.squaredNorm(), uv = arc.u.dot(arc.v);
  return std::sqrt(0.5 * (uu + vv) + elementary::hypot(0.5 * (uu - vv), uv));
}

/// Parameters of the arc's ends and of its extreme points in x and y, in increasing order.
std::vector<double> breaks_of(const EllipticArc& arc) {
  std::vector<double> breaks = {arc.from};
  for (const int axis : {0, 1}) {
    const double extreme = elementary::atan2(arc.v[axis], arc.u[axis]);
    const double first = extreme + k_pi * std::ceil((arc.from - extreme) / k_pi);
    for (int k = 0; first + k_pi * k < arc.to; ++k) breaks.push_back(std::max(arc.from, first + k_pi * k));
  }
  breaks.push_back(arc.to);
  std::sort(breaks.begin(), breaks.end());
  return breaks;
}

/// Appends an arc without its first point.
void append_arc(Polygon& points, const EllipticArc& arc, double sagitta) {
  constexpr double k_same = 1e-9;  // rad
  const double turn = arc.to - arc.from;
  const int steps = arc_steps(longest_radius(arc), turn, sagitta);
  const std::vector<double> breaks = breaks_of(arc);
  for (std::size_t b = 1; b < breaks.size(); ++b) {
    const double from = breaks[b - 1], width = breaks[b] - from;
    if (width < k_same && breaks[b] != arc.to) continue;
    const int parts = std::max(1, static_cast<int>(std::ceil(steps * width / turn - k_same)));
    for (int i = 1; i <= parts; ++i) {
      const double t = from + width * i / parts;
      points.push_back(arc.centre + elementary::cos(t) * arc.u + elementary::sin(t) * arc.v);
    }
  }
}

/// Appends the edge from `from` (excluded) to `to`. The centre of a bulge b lies on the perpendicular bisector of the
/// chord c, at (1 − b²) / (4 b) · c turned left.
void append_bulge(Polygon& points, const Vec2& from, const Vec2& to, double bulge, double sagitta,
                  const DrawingPlacement& place) {
  constexpr double k_most_bulge = 1e6;  // an arc of a whole turn but for 4e-6 rad; edges beyond are drawn straight
  if (bulge != 0 && std::abs(bulge) < k_most_bulge && (to - from).norm() > 0) {
    const double turn = 4 * elementary::atan(bulge);
    const Vec2 centre = 0.5 * (from + to) + turned_left(to - from) * ((1 - bulge * bulge) / (4 * bulge));
    const Vec2 spoke = from - centre;
    const EllipticArc arc{centre, spoke, (turn < 0 ? -1 : 1) * turned_left(spoke), 0, std::abs(turn)};
    append_arc(points, arc.placed(place), sagitta);
    points.pop_back();  // the arc's end is `to` but for rounding
  }
  points.push_back(place(to));
}

/// The diameter of a circle drawn as a polyline: two half circles on one chord.
std::optional<double> diameter_of(const std::vector<BulgeVertex>& vertices, bool closed,
                                  const DrawingPlacement& place) {
  if (!closed || vertices.size() != 2) return std::nullopt;
  if (vertices[0].bulge != vertices[1].bulge || std::abs(vertices[0].bulge) != 1) return std::nullopt;
  const Vec2 radius = 0.5 * (vertices[1].place - vertices[0].place);
  return diameter_of(EllipticArc{Vec2::Zero(), radius, turned_left(radius)}.placed(place));
}

/// The point of a rational B-spline at `t` in its knot span `span`, by de Boor's algorithm.
Vec2 point_at(const BSpline& spline, double t, std::size_t span) {
  std::vector<Vec3> d(spline.poles.begin() + static_cast<std::ptrdiff_t>(span) - spline.degree,
                      spline.poles.begin() + static_cast<std::ptrdiff_t>(span) + 1);
  const auto p = static_cast<std::size_t>(spline.degree);
  for (std::size_t r = 1; r <= p; ++r) {
    for (std::size_t j = p; j >= r; --j) {
      const double low = spline.knots[j + span - p];
      const double width = spline.knots[j + 1 + span - r] - low;
      const double a = width > 0 ? (t - low) / width : 0;
      d[j] = (1 - a) * d[j - 1] + a * d[j];
    }
  }
  return d[p].head<2>() / d[p].z();
}

/// Samples one span of a spline by bisection until the middle lies on the chord.
struct SpanSampler {
  const BSpline& spline;
  std::size_t span;
  double sagitta;
  Polygon& out;

  /// Points after `from` up to and including `to`.
  void sample(double t0, const Vec2& from, double t1, const Vec2& to, int depth = 0) {
    const double tm = 0.5 * (t0 + t1);
    const Vec2 middle = point_at(spline, tm, span);
    // The first bisections are unconditional: an inflection may put the middle on the chord.
    constexpr int k_unconditional = 2, k_deepest = 12;
    const bool is_flat = (middle - 0.5 * (from + to)).norm() <= sagitta;
    if (depth >= k_deepest || (is_flat && depth >= k_unconditional)) {
      out.push_back(to);
      return;
    }
    sample(t0, from, tm, middle, depth + 1);
    sample(tm, middle, t1, to, depth + 1);
  }
};

}  // namespace

SampledCurve sampled_arc(const EllipticArc& arc, double sagitta) {
  SampledCurve curve;
  curve.points.push_back(arc.centre + elementary::cos(arc.from) * arc.u + elementary::sin(arc.from) * arc.v);
  append_arc(curve.points, arc, sagitta);
  if (arc.to - arc.from < k_two_pi) return curve;
  curve.points.pop_back();
  curve.closed = true;
  curve.diameter = diameter_of(arc);
  return curve;
}

SampledCurve sampled_bulges(const std::vector<BulgeVertex>& vertices, bool closed, double sagitta,
                            const DrawingPlacement& place) {
  SampledCurve curve{{}, closed, diameter_of(vertices, closed, place)};
  if (vertices.empty()) return curve;
  curve.points.push_back(place(vertices.front().place));
  for (std::size_t i = 0; i + 1 < vertices.size(); ++i) {
    append_bulge(curve.points, vertices[i].place, vertices[i + 1].place, vertices[i].bulge, sagitta, place);
  }
  if (closed && vertices.size() > 1) {
    append_bulge(curve.points, vertices.back().place, vertices.front().place, vertices.back().bulge, sagitta, place);
    curve.points.pop_back();
  }
  return curve;
}

SampledCurve sampled_spline(const BSpline& spline, double sagitta, std::size_t most_points) {
  SampledCurve curve;
  for (auto span = static_cast<std::size_t>(spline.degree); span < spline.poles.size(); ++span) {
    const double t0 = spline.knots[span];
    const double t1 = spline.knots[span + 1];
    if (!(t1 > t0)) continue;
    const Vec2 from = point_at(spline, t0, span);
    if (curve.points.empty()) curve.points.push_back(from);
    SpanSampler{spline, span, sagitta, curve.points}.sample(t0, from, t1, point_at(spline, t1, span));
    if (curve.points.size() > most_points) break;
  }
  return curve;
}

}  // namespace fusee::formats
