#include "export/drawings/sampled_curves.h"

#include <algorithm>
#include <cmath>

#include "fusee/base/units.h"

namespace fusee {
namespace {

constexpr int k_most_steps = 20'000;  // of one arc

int arc_steps(double radius, double turn, double sagitta) {
  if (!(radius > sagitta)) return 8;
  const double steps = std::ceil(std::abs(turn) / std::sqrt(8 * sagitta / radius));
  return static_cast<int>(std::clamp(steps, 2.0, static_cast<double>(k_most_steps)));
}

/// From `from` (which is not repeated) to `to`.
void append_bulge(Polygon& points, const Vec2& from, const Vec2& to, double bulge, double sagitta) {
  if (bulge != 0 && std::abs(bulge) < 1e6 && (to - from).norm() > 0) {
    const double turn = 4 * std::atan(bulge);
    const Vec2 centre = 0.5 * (from + to) + turned_left(to - from) * ((1 - bulge * bulge) / (4 * bulge));
    const Vec2 spoke = from - centre;
    const int steps = arc_steps(spoke.norm(), turn, sagitta);
    for (int i = 1; i < steps; ++i) points.push_back(centre + turned(spoke, turn * i / steps));
  }
  points.push_back(to);
}

/// De Boor's recursion.
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

/// One span of a spline, halved until the middle lies on the chord.
struct SpanSampler {
  const BSpline& spline;
  std::size_t span;
  double sagitta;
  Polygon& out;

  /// Points after `from` up to and with `to`.
  void sample(double t0, const Vec2& from, double t1, const Vec2& to, int depth = 0) {
    const double tm = 0.5 * (t0 + t1);
    const Vec2 middle = point_at(spline, tm, span);
    // The first halvings are made anyway: an inflection may put the middle on the chord.
    const bool flat = (middle - 0.5 * (from + to)).norm() <= sagitta;
    if (depth >= 12 || (flat && depth >= 2)) {
      out.push_back(to);
      return;
    }
    sample(t0, from, tm, middle, depth + 1);
    sample(tm, middle, t1, to, depth + 1);
  }
};

}  // namespace

SampledCurve sampled_arc(const Vec2& centre, double radius, double from, double to, double sagitta) {
  SampledCurve curve;
  while (to <= from) to += k_two_pi;
  const int steps = arc_steps(radius, to - from, sagitta);
  for (int i = 0; i <= steps; ++i) curve.points.push_back(centre + radius * unit(from + (to - from) * i / steps));
  return curve;
}

SampledCurve closed_by_full_turn(SampledCurve curve) {
  curve.points.pop_back();
  curve.closed = true;
  return curve;
}

SampledCurve sampled_bulges(const std::vector<BulgeVertex>& vertices, bool closed, double sagitta) {
  SampledCurve curve{{}, closed};
  if (vertices.empty()) return curve;
  curve.points.push_back(vertices.front().place);
  for (std::size_t i = 0; i + 1 < vertices.size(); ++i) {
    append_bulge(curve.points, vertices[i].place, vertices[i + 1].place, vertices[i].bulge, sagitta);
  }
  if (closed && vertices.size() > 1) {
    append_bulge(curve.points, vertices.back().place, vertices.front().place, vertices.back().bulge, sagitta);
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

}  // namespace fusee
