#include "export/drawings/entity_curves.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.h"
#include "fusee/base.h"

namespace fusee::formats {
namespace {

constexpr double k_largest = 1e9;  // radius or axis, in units of the file

EntityCurve nothing_drawn(std::string skipped_kind, const DxfEntity& entity, const std::string& why) {
  return {std::nullopt, std::move(skipped_kind), "this " + std::string(entity.type) + " draws nothing: " + why};
}

EntityCurve lwpolyline(const DxfEntity& entity, const std::string& file, const DrawingPlacement& place,
                       double sagitta) {
  std::vector<BulgeVertex> vertices;
  for (const DxfTag& tag : entity.tags) {
    if (tag.code == 10) vertices.push_back({{dxf_number(file, tag), 0}, 0});
    if (vertices.empty()) continue;
    if (tag.code == 20) vertices.back().place.y() = dxf_number(file, tag);
    if (tag.code == 42) vertices.back().bulge = dxf_number(file, tag);
  }
  return {sampled_bulges(vertices, DxfValues(file, entity.tags).integer(70, 0) & 1, sagitta, place)};
}

EntityCurve polyline(const DxfEntity& entity, const std::string& file, const DrawingPlacement& place, double sagitta) {
  const int flags = DxfValues(file, entity.tags).integer(70, 0);
  constexpr int k_closed_flag = 1, k_polygon_mesh = 16, k_polyface_mesh = 64, k_control_frame = 16;
  if (flags & (k_polygon_mesh | k_polyface_mesh)) return {std::nullopt, " mesh"};
  std::vector<BulgeVertex> vertices;
  for (const std::vector<DxfTag>& tags : entity.vertices) {
    const DxfValues vertex(file, tags);
    if (vertex.integer(70, 0) & k_control_frame) continue;  // of a spline, whose curve has vertices of its own
    vertices.push_back({vertex.point(10), vertex.real(42, 0)});
  }
  return {sampled_bulges(vertices, flags & k_closed_flag, sagitta, place)};
}

EntityCurve circle_or_arc(const DxfEntity& entity, const std::string& file, const DrawingPlacement& place,
                          double sagitta) {
  const DxfValues values(file, entity.tags);
  const double radius = values.real(40, 0);
  if (radius == 0) return nothing_drawn(" of no size", entity, "its radius is 0");
  if (!(radius > 0) || radius > k_largest) {
    fail_in_dxf(file, entity.line, "the radius of this " + std::string(entity.type) + " is " + shortest(radius),
                "it must be above 0");
  }
  EllipticArc arc{values.point(10), radius * Vec2::UnitX(), radius * Vec2::UnitY(), 0, k_two_pi};
  if (entity.type == "ARC") {
    arc.from = radians(std::remainder(values.real(50, 0), 360.0));
    arc.to = radians(std::remainder(values.real(51, 0), 360.0));
    if (arc.to <= arc.from) arc.to += k_two_pi;
  }
  return {sampled_arc(arc.placed(place), sagitta)};
}

/// Rounding may make the ratio of the axes exceed 1, and it is negative if the minor axis points the other way. A ratio
/// well above 1 violates the format but defines an ellipse nevertheless.
EntityCurve ellipse(const DxfEntity& entity, const std::string& file, const DrawingPlacement& place, double sagitta) {
  constexpr double k_rounding = 1e-6;
  const DxfValues values(file, entity.tags);
  const Vec2 major = values.point(11);
  const double ratio = values.real(40, 1);
  if (major.norm() == 0 || ratio == 0) return nothing_drawn(" of no size", entity, "one of its axes is 0");
  if (!(std::max(1.0, std::abs(ratio)) * major.norm() <= k_largest)) {
    fail_in_dxf(file, entity.line,
                "the axes of this ELLIPSE are " + shortest(major.norm()) + " and " + shortest(ratio) + " times that");
  }
  EllipticArc arc{values.point(10), major, turned_left(major) * (values.real(230, 1) < 0 ? -ratio : ratio)};
  arc.from = std::remainder(values.real(41, 0), k_two_pi);
  const double declared_sweep = values.real(42, k_two_pi) - values.real(41, 0);
  arc.to = std::remainder(values.real(42, k_two_pi), k_two_pi);
  if (arc.to <= arc.from) arc.to += k_two_pi;
  if (std::abs(declared_sweep) >= k_two_pi - 1e-9) arc.to = arc.from + k_two_pi;
  EntityCurve drawn{sampled_arc(arc.placed(place), sagitta)};
  if (std::abs(ratio) > 1 + k_rounding) {
    drawn.remark = "the ratio of the axes of this ELLIPSE is " + shortest(ratio) +
                   ", above 1: programs that keep to the format may refuse it";
  }
  return drawn;
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
  const bool has_valid_weights =
      weights.empty() || (weights.size() == poles &&
                          std::all_of(weights.begin(), weights.end(), [](double w) { return w > 1e-9 && w < 1e9; }));
  if (!has_valid_weights) {
    fail_in_dxf(file, entity.line, "the weights of this SPLINE are not one positive number a control point");
  }
}

EntityCurve spline(const DxfEntity& entity, const std::string& file, const DrawingPlacement& place, double sagitta) {
  BSpline spline;
  spline.degree = DxfValues(file, entity.tags).integer(71, 3);
  std::vector<double> weights;
  for (const DxfTag& tag : entity.tags) {
    if (tag.code == 40) spline.knots.push_back(dxf_number(file, tag));
    if (tag.code == 41) weights.push_back(dxf_number(file, tag));
    if (tag.code == 10) spline.poles.emplace_back(dxf_number(file, tag), 0, 1);
    if (tag.code == 20 && !spline.poles.empty()) spline.poles.back().y() = dxf_number(file, tag);
  }
  if (spline.poles.empty())
    return {std::nullopt, " without control points",
            "this SPLINE has no control points and is not read: export it as a polyline"};
  check_spline(entity, file, spline, weights);
  for (Vec3& pole : spline.poles) pole.head<2>() = place(pole.head<2>());
  for (std::size_t i = 0; i < weights.size(); ++i) spline.poles[i] *= weights[i];
  return {sampled_spline(spline, sagitta, k_most_points)};
}

}  // namespace

EntityCurve curve_of(const DxfEntity& entity, const std::string& file, const DrawingPlacement& place, double sagitta) {
  if (entity.type == "LINE") {
    const DxfValues values(file, entity.tags);
    return {SampledCurve{{place(values.point(10)), place(values.point(11))}, false}};
  }
  if (entity.type == "LWPOLYLINE") return lwpolyline(entity, file, place, sagitta);
  if (entity.type == "POLYLINE") return polyline(entity, file, place, sagitta);
  if (entity.type == "CIRCLE" || entity.type == "ARC") return circle_or_arc(entity, file, place, sagitta);
  if (entity.type == "ELLIPSE") return ellipse(entity, file, place, sagitta);
  if (entity.type == "SPLINE") return spline(entity, file, place, sagitta);
  constexpr auto k_outlines =
      std::to_array<std::string_view>({"MLINE", "REGION", "BODY", "3DSOLID", "SURFACE", "TRACE"});
  if (std::find(k_outlines.begin(), k_outlines.end(), entity.type) != k_outlines.end())
    return {std::nullopt, "", "this " + std::string(entity.type) + " is not read: explode it to lines and arcs"};
  return {};
}

}  // namespace fusee::formats
