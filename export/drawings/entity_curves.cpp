#include "export/drawings/entity_curves.h"

#include <algorithm>
#include <cmath>

#include "fusee/base/text.h"
#include "fusee/base/units.h"

namespace fusee {
namespace {

constexpr double k_largest = 1e9;  // radius or axis

EntityCurve lwpolyline(const DxfEntity& entity, const std::string& file, double sagitta) {
  std::vector<BulgeVertex> vertices;
  for (const DxfTag& tag : entity.tags) {
    if (tag.code == 10) vertices.push_back({{dxf_number(file, tag), 0}, 0});
    if (vertices.empty()) continue;
    if (tag.code == 20) vertices.back().place.y() = dxf_number(file, tag);
    if (tag.code == 42) vertices.back().bulge = dxf_number(file, tag);
  }
  return {sampled_bulges(vertices, DxfValues(file, entity.tags).integer(70, 0) & 1, sagitta), {}};
}

EntityCurve polyline(const DxfEntity& entity, const std::string& file, double sagitta) {
  const int flags = DxfValues(file, entity.tags).integer(70, 0);
  if (flags & (16 | 64)) return {std::nullopt, " mesh"};
  std::vector<BulgeVertex> vertices;
  for (const std::vector<DxfTag>& tags : entity.vertices) {
    const DxfValues vertex(file, tags);
    if (vertex.integer(70, 0) & 16) continue;  // a spline's frame, not its curve
    vertices.push_back({vertex.point(10), vertex.real(42, 0)});
  }
  return {sampled_bulges(vertices, flags & 1, sagitta), {}};
}

EntityCurve circle_or_arc(const DxfEntity& entity, const std::string& file, double sagitta) {
  const DxfValues values(file, entity.tags);
  const double radius = values.real(40, 0);
  if (!(radius > 0) || radius > k_largest) {
    fail_in_dxf(file, entity.line, "the radius of this " + std::string(entity.type) + " is " + shortest(radius),
                "it must be above 0");
  }
  if (entity.type == "CIRCLE")
    return {closed_by_full_turn(sampled_arc(values.point(10), radius, 0, k_two_pi, sagitta)), {}};
  const double from = radians(std::remainder(values.real(50, 0), 360.0));
  const double to = radians(std::remainder(values.real(51, 0), 360.0));
  return {sampled_arc(values.point(10), radius, from, to, sagitta), {}};
}

EntityCurve ellipse(const DxfEntity& entity, const std::string& file, double sagitta) {
  const DxfValues values(file, entity.tags);
  const Vec2 centre = values.point(10);
  const Vec2 major = values.point(11);
  const double ratio = values.real(40, 1);
  if (!(major.norm() > 0) || major.norm() > k_largest || !(ratio > 0) || ratio > 1) {
    fail_in_dxf(file, entity.line,
                "the axes of this ELLIPSE are " + shortest(major.norm()) + " and " + shortest(ratio) + " times that");
  }
  const Vec2 minor = turned_left(major) * (values.real(230, 1) < 0 ? -ratio : ratio);
  const double from = std::remainder(values.real(41, 0), k_two_pi);
  const double sweep_asked = values.real(42, k_two_pi) - values.real(41, 0);
  const bool full = std::abs(sweep_asked) >= k_two_pi - 1e-9;
  double to = std::remainder(values.real(42, k_two_pi), k_two_pi);
  if (to <= from) to += k_two_pi;
  if (full) to = from + k_two_pi;
  SampledCurve curve = sampled_arc(Vec2::Zero(), 1, from, to, sagitta / major.norm());
  for (Vec2& p : curve.points) p = centre + p.x() * major + p.y() * minor;
  return {full ? closed_by_full_turn(std::move(curve)) : std::move(curve), {}};
}

void check_spline(const DxfEntity& entity, const std::string& file, const BSpline& spline,
                  const std::vector<double>& weights) {
  const std::size_t poles = spline.poles.size();
  const auto order = static_cast<std::size_t>(spline.degree) + 1;
  const bool fits = spline.degree >= 1 && spline.degree <= 11 && poles >= order &&
                    spline.knots.size() == poles + order && std::is_sorted(spline.knots.begin(), spline.knots.end());
  if (!fits) {
    fail_in_dxf(file, entity.line,
                "this SPLINE of degree " + std::to_string(spline.degree) + " has " + std::to_string(poles) +
                    " control points and " + std::to_string(spline.knots.size()) +
                    " knots, which do not fit or are not in order");
  }
  const bool weighted =
      weights.empty() || (weights.size() == poles &&
                          std::all_of(weights.begin(), weights.end(), [](double w) { return w > 1e-9 && w < 1e9; }));
  if (!weighted) {
    fail_in_dxf(file, entity.line, "the weights of this SPLINE are not one positive number a control point");
  }
}

EntityCurve spline(const DxfEntity& entity, const std::string& file, double sagitta) {
  BSpline spline;
  spline.degree = DxfValues(file, entity.tags).integer(71, 3);
  std::vector<double> weights;
  for (const DxfTag& tag : entity.tags) {
    if (tag.code == 40) spline.knots.push_back(dxf_number(file, tag));
    if (tag.code == 41) weights.push_back(dxf_number(file, tag));
    if (tag.code == 10) spline.poles.emplace_back(dxf_number(file, tag), 0, 1);
    if (tag.code == 20 && !spline.poles.empty()) spline.poles.back().y() = dxf_number(file, tag);
  }
  if (spline.poles.empty()) return {std::nullopt, " without control points"};
  check_spline(entity, file, spline, weights);
  for (std::size_t i = 0; i < weights.size(); ++i) spline.poles[i] *= weights[i];
  return {sampled_spline(spline, sagitta, k_most_points), {}};
}

}  // namespace

EntityCurve curve_of(const DxfEntity& entity, const std::string& file, double sagitta) {
  if (entity.type == "LINE") {
    const DxfValues values(file, entity.tags);
    return {SampledCurve{{values.point(10), values.point(11)}, false}, {}};
  }
  if (entity.type == "LWPOLYLINE") return lwpolyline(entity, file, sagitta);
  if (entity.type == "POLYLINE") return polyline(entity, file, sagitta);
  if (entity.type == "CIRCLE" || entity.type == "ARC") return circle_or_arc(entity, file, sagitta);
  if (entity.type == "ELLIPSE") return ellipse(entity, file, sagitta);
  if (entity.type == "SPLINE") return spline(entity, file, sagitta);
  return {};
}

}  // namespace fusee
