#include "solid/bore.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "fusee/base/diagnostics.h"
#include "fusee/mechanism/catalogue.h"

namespace fusee {
namespace {

// Fewer corners make a small hole a polygon that no shaft of its diameter turns in.
constexpr int k_least_facets = 8;
// Sagitta of the arcs of D and keyway bores.
constexpr double k_arc_sagitta = 0.01;

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

void make_round(BoreLayout& bore, double diameter) {
  bore.circle = RoundHole{Vec2::Zero(), diameter};
  bore.outline = polyhole(diameter, Vec2::Zero());
}

// The hub of the horn sinks into a recess below; its own screw and those on the circle pass through.
void add_horn(BoreLayout& bore, const Horn& horn, double compensation) {
  const double centre_hole = horn.centre_hole + compensation;
  bore.horn_recess = horn.recess_depth;
  if (horn.recess_depth > 0) {
    make_round(bore, horn.hub_diameter + compensation);
    bore.screw_holes.push_back(polyhole(centre_hole, Vec2::Zero()));
  } else {
    make_round(bore, centre_hole);
  }
  for (int k = 0; k < horn.hole_count; ++k) {
    const Vec2 centre = 0.5 * horn.hole_circle * unit(k_two_pi * k / horn.hole_count);
    bore.screw_holes.push_back(polyhole(horn.hole_diameter + compensation, centre));
  }
}

void fit_shaft(BoreLayout& bore, const Body& body, double diameter, double compensation) {
  const double radius = 0.5 * (diameter + compensation);
  switch (body.bore) {
    case Bore::d:
      bore.outline = d_outline(radius, (body.bore_flat > 0 ? body.bore_flat : 0.9 * diameter) + compensation);
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
      bore.arc_points = bore.outline.size() - 2;  // without the key's ground
      return;
    case Bore::round:
    case Bore::horn:
      break;
  }
  make_round(bore, diameter + compensation);
}

}  // namespace

Polygon polyhole(double diameter, const Vec2& centre) {
  return tangent_polygon(0.5 * diameter, facets_of(diameter), 0.5 * k_pi, centre);
}

BoreLayout bore_layout(const Body& body, double diameter, double compensation) {
  BoreLayout bore;
  bore.kind = body.bore;
  if (body.bore == Bore::horn) {
    const Horn* horn = find_horn(body.horn);
    if (horn == nullptr) {
      throw InputError("", "body.horn: there is no servo horn \"" + body.horn + "\"",
                       "`fusee explain body.horn` lists them");
    }
    add_horn(bore, *horn, compensation);
  } else {
    fit_shaft(bore, body, diameter, compensation);
  }
  for (const Vec2& point : bore.outline) bore.radius = std::max(bore.radius, point.norm());
  return bore;
}

}  // namespace fusee
