#include "solid/bore.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "fusee/mechanism/catalogue.h"

namespace fusee {
namespace {

// Fewer corners make a small hole a polygon that no shaft of its diameter turns in.
constexpr int k_least_facets = 8;
// Sagitta of the arcs of D and keyway bores.
constexpr double k_arc_sagitta = 0.01;
// A recess is deeper by this (one printed layer) than what sinks into it, so that the pulley lies on the horn's face.
constexpr double k_recess_play = 0.2;
// A tooth's crest and the ground between two are flat over this share of the pitch: 0.1 mm of 0.74 mm on the shaft of a
// Futaba 3F servo (hugokernel/OpenSCAD_ServoArms). Sharper ones would be rounded by the printer.
constexpr double k_tooth_flat = 0.125;

int facets_of(double diameter) { return std::max(k_least_facets, static_cast<int>(std::lround(2.0 * diameter))); }

// Regular, tangent to the circle of radius `inner`, the middle of a side facing `direction`.
Polygon tangent_polygon(double inner, int sides, double direction, const Vec2& centre) {
  Polygon points;
  const double step = k_two_pi / sides;
  for (int k = 0; k < sides; ++k)
    points.push_back(centre + inner / std::cos(0.5 * step) * unit(direction + (k + 0.5) * step));
  return points;
}

// The circle's points from angle `from` counter-clockwise to angle `to`, both included.
Polygon arc(double radius, double from, double to) {
  const double finest = 2.0 * std::acos(1.0 - std::min(1.0, k_arc_sagitta / radius));
  const int steps = std::max(2, static_cast<int>(std::ceil((to - from) / finest)));
  Polygon points;
  for (int k = 0; k <= steps; ++k) points.push_back(radius * unit(from + (to - from) * k / steps));
  return points;
}

// `flat`: from the flat to the far side of the shaft.
Polygon d_outline(double radius, double flat) {
  const double height = std::clamp(flat - radius, -0.95 * radius, 0.95 * radius);
  const double half = std::acos(height / radius);
  return arc(radius, 0.5 * k_pi + half, 2.5 * k_pi - half);
}

// Keyways of DIN 6885-1 (ISO 773): up to which shaft, width, depth in the hub t2.
struct Key {
  double shaft, width, depth;
};
constexpr std::array<Key, 12> k_keys{{{8, 2, 1.0},
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
  const auto key =
      std::find_if(k_keys.begin(), k_keys.end() - 1, [diameter](const Key& row) { return diameter <= row.shaft; });
  const double radius = 0.5 * (diameter + compensation);
  const double half_width = std::min(0.5 * (key->width + compensation), 0.9 * radius);
  const double half = std::asin(half_width / radius);
  Polygon points = arc(radius, 0.5 * k_pi + half, 2.5 * k_pi - half);
  const double top = 0.5 * diameter + key->depth + 0.5 * compensation;
  points.emplace_back(half_width, top);
  points.emplace_back(-half_width, top);
  return points;
}

// A shaft's serration as a hole: straight flanks between the circles of crests and grounds, four corners a tooth.
Polygon toothed_outline(const Horn& horn, double compensation) {
  const double pitch = k_two_pi / horn.spline_teeth, half_flat = 0.5 * k_tooth_flat * pitch;
  const double crest = 0.5 * (horn.spline_diameter + compensation);  // of the shaft's teeth, which point outward
  Polygon points;
  for (int k = 0; k < horn.spline_teeth; ++k) {
    const double tooth = 0.5 * k_pi + k * pitch;
    // The shaft's crest touches the middle of the flat that stands over it, as a shaft touches a polyhole's side.
    for (const double side : {-1.0, 1.0})
      points.push_back(crest / std::cos(half_flat) * unit(tooth + side * half_flat));
    for (const double side : {-1.0, 1.0})
      points.push_back((crest - horn.spline_depth) * unit(tooth + 0.5 * pitch + side * half_flat));
  }
  return points;
}

// What sinks in from below: the horn's boss, or the servo's own shaft. Empty where the horn's face is flat.
Polygon sunk_outline(const Horn& horn, double compensation) {
  if (horn.spline_teeth > 0) return toothed_outline(horn, compensation);
  return horn.boss_height > 0 ? polyhole(horn.boss_diameter + compensation, Vec2::Zero()) : Polygon();
}

void add_horn(BoreLayout& bore, const Horn& horn, double compensation) {
  const Polygon sunk = sunk_outline(horn, compensation);
  const double depth = std::max(horn.boss_height, horn.spline_length);
  bore.spline_teeth = horn.spline_teeth;
  if (depth > 0) {
    bore.outline = sunk;
    bore.horn_recess = depth + k_recess_play;
    bore.screw_holes.push_back(polyhole(horn.centre_hole + compensation, Vec2::Zero()));
  } else {
    bore.outline = sunk.empty() ? polyhole(horn.centre_hole + compensation, Vec2::Zero()) : sunk;
  }
  for (int k = 0; k < horn.bolt_count; ++k) {
    const Vec2 centre = 0.5 * horn.bolt_circle * unit(horn.first_bolt + k_two_pi * k / horn.bolt_count);
    bore.screw_holes.push_back(polyhole(horn.bolt_hole + compensation, centre));
  }
}

Polygon outline_of(const Body& body, double diameter, double compensation) {
  const double radius = 0.5 * (diameter + compensation);
  switch (body.bore) {
    case Bore::d:
      return d_outline(radius, (body.bore_flat > 0 ? body.bore_flat : 0.9 * diameter) + compensation);
    case Bore::hex:
      return tangent_polygon(radius, 6, 0.5 * k_pi, Vec2::Zero());
    case Bore::square:
      return tangent_polygon(radius, 4, 0.5 * k_pi, Vec2::Zero());
    case Bore::keyway:
      return keyway_outline(diameter, compensation);
    case Bore::round:
    case Bore::horn:
      break;
  }
  return polyhole(diameter + compensation, Vec2::Zero());
}

}  // namespace

Polygon polyhole(double diameter, const Vec2& centre) {
  return tangent_polygon(0.5 * diameter, facets_of(diameter), 0.5 * k_pi, centre);
}

BoreLayout bore_layout(const Mechanism& mechanism, double diameter) {
  const double compensation = mechanism.material.hole_compensation;
  BoreLayout bore;
  bore.kind = mechanism.body.bore;
  if (bore.kind == Bore::horn)
    add_horn(bore, horn_of(mechanism), compensation);
  else
    bore.outline = outline_of(mechanism.body, diameter, compensation);
  for (const Vec2& point : bore.outline) bore.radius = std::max(bore.radius, point.norm());
  return bore;
}

double recess_roof_share(const BoreLayout& bore) {
  // What remains of the ceiling: less than a slicer sees.
  constexpr double k_ledge = 0.05;
  return std::min(1.0, (circumradius(bore.screw_holes.front()) + k_ledge) / distance_to_edges(bore.outline, Vec2::Zero()));
}

}  // namespace fusee
