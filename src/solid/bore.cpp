#include "solid/bore.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.h"
#include "fusee/base.h"
#include "mechanism/catalogue.h"
#include "solid/condition_list.h"

namespace fusee::solid {
namespace {

// Holes are polygons around the shaft, with two sides per millimetre of diameter (nophead's polyholes) and at least
// this many: the corners of eight sides stand out by 8 % of the radius, those of three by 100 %.
constexpr int k_least_facets = 8;
// Largest sagitta of the arcs of D and keyway bores, mm.
constexpr double k_arc_sagitta = 0.01;
// A recess is one printed layer deeper than the part that sinks into it, so that the pulley lies on the horn's face. mm
constexpr double k_recess_play = 0.2;
// Fraction of the pitch over which a tooth's crest and ground are flat: 0.1 mm of 0.74 mm on the shaft of a Futaba 3F
// servo (hugokernel/OpenSCAD_ServoArms). The printer would round sharper ones.
constexpr double k_tooth_flat = 0.125;

int facets_of(double diameter) { return std::max(k_least_facets, static_cast<int>(std::lround(2.0 * diameter))); }

// A regular polygon tangent to the circle of radius `inner`, with the middle of a side facing `direction`.
Polygon tangent_polygon(double inner, int sides, double direction, const Vec2& centre) {
  Polygon points;
  const double step = k_two_pi / sides;
  for (int k = 0; k < sides; ++k)
    points.push_back(centre + inner / elementary::cos(0.5 * step) * unit(direction + (k + 0.5) * step));
  return points;
}

// The circle's points from angle `from` counter-clockwise to angle `to`, both included.
Polygon arc(double radius, double from, double to) {
  const double finest = 2.0 * elementary::acos(1.0 - std::min(1.0, k_arc_sagitta / radius));
  const int steps = std::max(2, static_cast<int>(std::ceil((to - from) / finest)));
  Polygon points;
  for (int k = 0; k <= steps; ++k) points.push_back(radius * unit(from + (to - from) * k / steps));
  return points;
}

// Width over the flat of an automatic D shaft, relative to its diameter.
constexpr double k_automatic_flat = 0.9;

// `flat`: distance from the flat to the far side of the shaft. Impossible distances are reported as a condition. Here
// they are only limited, so that there is an outline.
Polygon d_outline(double radius, double flat) {
  // Height of the flat above the axis, and half the angle that it subtends there.
  const double height = std::clamp(flat - radius, -0.95 * radius, 0.95 * radius);
  const double half_angle = elementary::acos(height / radius);
  return arc(radius, 0.5 * k_pi + half_angle, 2.5 * k_pi - half_angle);
}

// A keyway of DIN 6885-1 (ISO 773): largest shaft diameter, width, depth t2 in the hub. mm
struct Keyway {
  double shaft, width, depth;
};
constexpr std::array<Keyway, 12> k_keyways{{{8, 2, 1.0},
                                            {10, 3, 1.4},
                                            {12, 4, 1.8},
                                            {17, 5, 2.3},
                                            {22, 6, 2.8},
                                            {30, 8, 3.3},
                                            {38, 10, 3.3},
                                            {44, 12, 3.3},
                                            {50, 14, 3.8},
                                            {58, 16, 4.3},
                                            {65, 18, 4.4},
                                            {75, 20, 4.9}}};

Polygon keyway_outline(double diameter, double compensation) {
  // A shaft thicker than all of the table gets the last keyway.
  const auto keyway = std::find_if(k_keyways.begin(), k_keyways.end() - 1,
                                   [diameter](const Keyway& row) { return diameter <= row.shaft; });
  const double radius = 0.5 * (diameter + compensation);
  // Limited on the thinnest shafts, so that there is an outline.
  const double half_width = std::min(0.5 * (keyway->width + compensation), 0.9 * radius);
  const double half_angle = elementary::asin(half_width / radius);
  Polygon points = arc(radius, 0.5 * k_pi + half_angle, 2.5 * k_pi - half_angle);
  const double top = 0.5 * diameter + keyway->depth + 0.5 * compensation;
  points.emplace_back(half_width, top);
  points.emplace_back(-half_width, top);
  return points;
}

void make_round(BoreLayout& bore, double diameter) {
  bore.circle = RoundHole{Vec2::Zero(), diameter};
  bore.outline = polyhole(diameter, Vec2::Zero());
}

// The outline for a toothed shaft: straight flanks between the circles of crests and grounds, four corners a tooth.
Polygon toothed_outline(const Horn& horn, double compensation) {
  const double pitch = k_two_pi / horn.spline_teeth, half_flat = 0.5 * k_tooth_flat * pitch;
  const double crest = 0.5 * (horn.spline_diameter + compensation);  // radius of the crests of the shaft's teeth
  Polygon points;
  for (int k = 0; k < horn.spline_teeth; ++k) {
    const double tooth = 0.5 * k_pi + k * pitch;  // direction of the tooth
    // The shaft's crest touches the middle of the flat above it, as a shaft touches a polyhole's side.
    for (const double side : {-1.0, 1.0})
      points.push_back(crest / elementary::cos(half_flat) * unit(tooth + side * half_flat));
    for (const double side : {-1.0, 1.0})
      points.push_back((crest - horn.spline_depth) * unit(tooth + 0.5 * pitch + side * half_flat));
  }
  return points;
}

void add_horn(BoreLayout& bore, const Horn& horn, double compensation) {
  const double depth = std::max(horn.boss_height, horn.spline_length);
  bore.spline_teeth = horn.spline_teeth;
  // The horn's boss or the servo's own shaft sinks in from below. With a flat horn only its screw passes.
  if (horn.spline_teeth > 0)
    bore.outline = toothed_outline(horn, compensation);
  else
    make_round(bore, (horn.boss_height > 0 ? horn.boss_diameter : horn.centre_hole) + compensation);
  if (depth > 0) {
    bore.horn_recess = depth + k_recess_play;
    bore.screw_holes.push_back(polyhole(horn.centre_hole + compensation, Vec2::Zero()));
  }
  for (int k = 0; k < horn.bolt_count; ++k) {
    const Vec2 centre = 0.5 * horn.bolt_circle * unit(horn.first_bolt + k_two_pi * k / horn.bolt_count);
    bore.screw_holes.push_back(polyhole(horn.bolt_hole + compensation, centre));
  }
}

void fit_shaft(BoreLayout& bore, const Body& body, double diameter, double compensation) {
  const double radius = 0.5 * (diameter + compensation);
  switch (body.bore) {
    case Bore::d:
      bore.outline =
          d_outline(radius, (body.bore_flat > 0 ? body.bore_flat : k_automatic_flat * diameter) + compensation);
      bore.arc_points = bore.outline.size();
      return;
    case Bore::hex:
      bore.outline = tangent_polygon(radius, 6, 0.5 * k_pi, Vec2::Zero());
      return;
    case Bore::square:
      bore.outline = tangent_polygon(radius, 4, 0.5 * k_pi, Vec2::Zero());
      return;
    case Bore::keyway:
      bore.outline = keyway_outline(diameter, compensation);
      bore.arc_points = bore.outline.size() - 2;  // without the keyway's ground
      return;
    case Bore::round:
    case Bore::horn:
      break;
  }
  make_round(bore, diameter + compensation);
}

// Largest angle, seen from the axis, between corners of two polygons that count as on one ray, rad: 0.03 mm at 3 mm, a
// third of a tooth's flat.
constexpr double k_same_ray = 0.01;

double angle_of(const Vec2& point) { return elementary::atan2(point.y(), point.x()); }

bool on_one_ray(const Vec2& a, const Vec2& b) {
  return std::abs(elementary::atan2(cross(a, b), a.dot(b))) < k_same_ray;
}

bool has_corner_on_ray(const Polygon& polygon, const Vec2& ray) {
  return std::any_of(polygon.begin(), polygon.end(), [&ray](const Vec2& corner) { return on_one_ray(corner, ray); });
}

// The exit of a ray from the axis out of a polygon that is star-shaped about it. The ray t · ray meets the line of side
// a b at t = cross(a, b)/cross(ray, b − a).
Vec2 exit_of_ray(const Polygon& polygon, const Vec2& ray) {
  for (const Vec2& corner : polygon) {
    if (on_one_ray(corner, ray)) return corner;
  }
  const auto next = [&polygon](std::size_t i) { return polygon[(i + 1) % polygon.size()]; };
  std::size_t i = 0;
  while (i < polygon.size() && !(cross(polygon[i], ray) > 0 && cross(ray, next(i)) > 0)) ++i;
  demand(i < polygon.size(), fmt::format("no side of {} on the ray of ({}, {})", polygon.size(), ray.x(), ray.y()));
  return ray * (cross(polygon[i], next(i)) / cross(ray, next(i) - polygon[i]));
}

Polygon exits_of_rays(const Polygon& polygon, const Polygon& rays) {
  Polygon points;
  for (const Vec2& ray : rays) points.push_back(exit_of_ray(polygon, ray));
  return points;
}

}  // namespace

Polygon polyhole(double diameter, const Vec2& centre) {
  return tangent_polygon(0.5 * diameter, facets_of(diameter), 0.5 * k_pi, centre);
}

BoreLayout bore_layout(const Mechanism& mechanism, double diameter) {
  const double compensation = mechanism.material.hole_compensation;
  BoreLayout bore;
  bore.kind = mechanism.body.bore;
  bore.shaft = diameter;
  if (bore.kind == Bore::horn)
    add_horn(bore, horn_of(mechanism), compensation);
  else
    fit_shaft(bore, mechanism.body, diameter, compensation);
  for (const Vec2& point : bore.outline) bore.radius = std::max(bore.radius, point.norm());
  return bore;
}

BoreLayout bore_of_shaft(Mechanism mechanism, const BoreLayout& made) {
  mechanism.material.hole_compensation = 0;
  return bore_layout(mechanism, made.shaft);
}

std::optional<profile::Condition> flat_off_shaft(const Body& body, double shaft) {
  if (body.bore != Bore::d || body.bore_flat <= 0) return std::nullopt;
  const bool outside = body.bore_flat > shaft;
  if (!outside && body.bore_flat > 0.5 * shaft) return std::nullopt;
  ConditionList list;
  list.add(
      "bore_flat", body.bore_flat, outside ? shaft : 0.5 * shaft, false,
      fmt::format("a D shaft of {0} mm (body.bore_diameter_mm) must measure more than {1} mm and at most {0} mm from "
                  "its flat to its far side (body.bore_flat_mm, now {2} mm)",
                  rounded(shaft), rounded(0.5 * shaft), rounded(body.bore_flat)));
  return list.release().front();
}

RecessCone recess_cone(const BoreLayout& bore) {
  const Polygon& hole = bore.screw_holes.front();
  Polygon rays = bore.outline;
  for (const Vec2& corner : hole) {
    if (!has_corner_on_ray(bore.outline, corner)) rays.push_back(corner);
  }
  std::sort(rays.begin(), rays.end(), [](const Vec2& a, const Vec2& b) { return angle_of(a) < angle_of(b); });
  RecessCone cone{exits_of_rays(bore.outline, rays), exits_of_rays(hole, rays)};
  for (std::size_t i = 0; i < rays.size(); ++i)
    cone.travel = std::max(cone.travel, (cone.rim[i] - cone.hole[i]).norm());
  return cone;
}

}  // namespace fusee::solid
