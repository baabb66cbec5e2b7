/// \file
/// profile.dxf: the curves of the pulley at true size about the axis, with marks of its home position. Curves of
/// multi-turn pulleys are polylines in space.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "export/drawings/cut_shapes.h"
#include "export/drawings/dxf_writer.h"
#include "export/drawings/fitted_arcs.h"
#include "export/drawings/plane_shapes.h"
#include "fusee/base.h"
#include "fusee/export.h"
#include "solid/bore.h"

namespace fusee::formats {
namespace {

constexpr double k_label_height = 2.5;  // mm
constexpr double k_label_pitch = 4.5;   // mm
/// Largest distance of the arcs from the outline's points, mm: a twentieth of the outline's tolerance.
constexpr double k_arc_tolerance = 0.0005;

/// Name and AutoCAD colour index of each layer. Marks and the check square are neither plotted nor cut (false).
std::vector<DxfLayer> layers() {
  return {{"P1_PITCH", 1},
          {"P2_PITCH", 5},
          {"P1_FLOOR", 30},
          {"P2_FLOOR", 4},
          {"BORE", 3},
          {"MARK_AXIS", 8, false},
          {"MARK_HOME", 6, false},
          {"MARK_TAKE_OFF", 2, false},
          {"MARK_ANCHOR", 9, false},
          {"MARK_TEXT", 8, false},
          {"CHECK_10MM", 8, false}};
}

/// A circle if the pulley is round, otherwise arcs.
void add_curve(DxfDocument& drawing, const char* layer, const profile::Outline& outline, double distance) {
  if (const auto circle = circle_about_axis(profile::parallel(outline, distance))) {
    drawing.add_closed(layer, circle_contour(*circle));
  } else {
    drawing.add_closed_arcs(layer, fitted_arcs(outline, distance, k_arc_tolerance));
  }
}

void add_contours(DxfDocument& drawing, const profile::SynthesisResult& synthesis, double tendon_diameter,
                  const solid::BodyLayout& layout) {
  add_curve(drawing, "P1_PITCH", synthesis.p1, 0);
  add_curve(drawing, "P1_FLOOR", synthesis.p1, -0.5 * tendon_diameter);
  add_curve(drawing, "P2_PITCH", synthesis.p2, 0);
  add_curve(drawing, "P2_FLOOR", synthesis.p2, -0.5 * tendon_diameter);
  drawing.add_closed("BORE", bore_contour(layout.bore));
  for (const Polygon& hole : layout.bore.screw_holes)
    drawing.add_closed("BORE", circle_contour(solid::circle_within(hole)));
}

/// A cross on the axis, and an arrow towards the joint outside `radius`, which contains all curves. All lengths are mm.
void add_axis_and_home(DxfDocument& drawing, double bore_radius, double radius) {
  const double arm = bore_radius + 2;
  drawing.add_open("MARK_AXIS", {{-arm, 0}, {arm, 0}});
  drawing.add_open("MARK_AXIS", {{0, -arm}, {0, arm}});
  const double foot = radius + 3;
  const double tip = foot + 8;
  drawing.add_open("MARK_HOME", {{0, foot}, {0, tip}});
  drawing.add_open("MARK_HOME", {{-1.2, tip - 3}, {0, tip}, {1.2, tip - 3}});
  drawing.add_text("MARK_HOME", "HOME", {2.5, tip - 4}, k_label_height);
}

/// `angle` plus whole turns, in [0, 2π).
double within_turn(double angle) {
  const double remainder = std::fmod(angle, k_two_pi);
  return remainder < 0 ? remainder + k_two_pi : remainder;
}

/// The point of the outline whose outward normal points in direction `psi`.
Vec2 contact_point(const profile::Outline& outline, double psi) {
  const std::size_t n = outline.points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const profile::OutlinePoint& a = outline.points[i];
    const profile::OutlinePoint& b = outline.points[(i + 1) % n];
    const double turn_of_edge = within_turn(b.psi - a.psi);
    const double turn_to_psi = within_turn(psi - a.psi);
    if (turn_to_psi < turn_of_edge) return a.position + turn_to_psi / turn_of_edge * (b.position - a.position);
  }
  return outline.points.front().position;
}

/// The take-off of a tendon at home, and its line towards the pin. `normal`: direction of the outward normal, rad.
void add_take_off(DxfDocument& drawing, const Vec2& take_off, double normal, const char* name) {
  Vec2 up = turned_left(unit(normal));
  if (up.y() < 0) up = -up;
  const Vec2 out = unit(normal);
  constexpr double k_length = 12;  // mm
  drawing.add_open("MARK_TAKE_OFF", {take_off - 1.5 * out, take_off + 1.5 * out});
  drawing.add_open("MARK_TAKE_OFF", {take_off, take_off + k_length * up});
  drawing.add_text("MARK_TAKE_OFF", name, take_off + k_length * up + Vec2(out.x() < 0 ? -3.5 : 1.0, 0), k_label_height);
}

/// Ticks over the grooves at both ends of the active arcs. If both pulleys are alike, ticks of P1 and P2 may coincide,
/// and the line is drawn once.
void add_active_ends(DxfDocument& drawing, const profile::SynthesisResult& synthesis, double tendon_diameter,
                     double groove_depth) {
  constexpr double k_same = 1e-6;  // mm
  std::vector<Vec2> drawn;         // start points of drawn ticks
  for (const profile::Outline* outline : {&synthesis.p1, &synthesis.p2}) {
    for (const std::size_t i : {outline->active_first, outline->active_last}) {
      const profile::OutlinePoint& point = outline->points[i];
      const Vec2 from = point.position - 0.5 * tendon_diameter * point.normal;
      const auto is_there = [&from](const Vec2& other) { return (other - from).norm() < k_same; };
      if (std::any_of(drawn.begin(), drawn.end(), is_there)) continue;
      drawn.push_back(from);
      drawing.add_open("MARK_TAKE_OFF", {from, point.position + (groove_depth - 0.5 * tendon_diameter) * point.normal});
    }
  }
}

void add_anchors(DxfDocument& drawing, const std::vector<solid::Anchor>& anchors, const solid::BodyLayout& layout) {
  for (const solid::Anchor& anchor : anchors) {
    if (anchor.channel.size() > 2) drawing.add_closed("MARK_ANCHOR", anchor.channel);
    const double radius = solid::pocket_radius(anchor, layout);
    if (radius > 0) drawing.add_closed("MARK_ANCHOR", circle_contour({anchor.pocket, 2 * radius}));
  }
}

/// The lines of the legend below all paths, to the right of a check square of 10 mm. All lengths are mm.
void add_legend(DxfDocument& drawing, const std::vector<std::string>& lines) {
  const Box2d box = bounding_box(drawing.paths);
  double top = box.low.y() - 4 - k_label_height;
  const Vec2 square(box.low.x(), top + k_label_height - 10);
  drawing.add_closed("CHECK_10MM", rectangle(square, square + Vec2(10, 10)));
  for (const std::string& line : lines) {
    drawing.add_text("MARK_TEXT", line, {square.x() + 14, top}, k_label_height);
    top -= k_label_pitch;
  }
}

// Several turns -----------------------------------------------------------------------------------------------------

std::vector<DxfLayer> spiral_layers() {
  std::vector<DxfLayer> all = {{"P1_SPIRAL", 1}, {"P2_SPIRAL", 5},        {"P1_SPARE", 9},
                               {"P2_SPARE", 9},  {"P1_SPIRAL_FLOOR", 30}, {"P2_SPIRAL_FLOOR", 4}};
  for (const DxfLayer& layer : layers())
    if (!layer.name.starts_with('P')) all.push_back(layer);
  return all;
}

/// Rows `first` to `last` of a spiral, `outward` (mm) of the pitch curve.
std::vector<Vec3> helical_line(const helix::Spiral& spiral, const helical_solid::SpiralPlace& place, std::size_t first,
                               std::size_t last, double outward) {
  std::vector<Vec3> points;
  for (std::size_t i = first; i <= last; ++i) {
    const helix::SpiralRow& row = spiral.rows[i];
    const Vec2 plan = Vec2(row.x, row.y) + outward * unit(row.turn);
    points.emplace_back(plan.x(), plan.y(), place.height(row.z));
  }
  return points;
}

void add_spiral(DxfDocument& drawing, const std::string& pulley, const helix::HelixSide& side,
                const helical_solid::SpiralPlace& place, double tendon_radius) {
  const helix::Spiral& spiral = side.spiral;
  const std::size_t last = spiral.rows.size() - 1;
  const auto curve = [&](const char* layer, std::size_t from, std::size_t to, double outward) {
    if (from < to) drawing.add_in_space(pulley + layer, helical_line(spiral, place, from, to, outward));
  };
  curve("_SPIRAL", spiral.first_used, spiral.last_used, 0);
  curve("_SPARE", 0, spiral.first_used, 0);
  curve("_SPARE", spiral.last_used, last, 0);
  curve("_SPIRAL_FLOOR", 0, last, -tendon_radius);
}

/// The row of the take-off at home.
const helix::SpiralRow& home_row(const helix::HelixSide& side, std::size_t home) {
  const double z = side.stroke[home].z;
  return *std::min_element(
      side.spiral.rows.begin(), side.spiral.rows.end(),
      [z](const helix::SpiralRow& a, const helix::SpiralRow& b) { return std::abs(a.z - z) < std::abs(b.z - z); });
}

/// Largest distance of a spiral from the axis, mm.
double reach_of(const helix::Spiral& spiral) {
  double reach = 0;
  for (const helix::SpiralRow& row : spiral.rows) reach = std::max(reach, elementary::hypot(row.x, row.y));
  return reach;
}

void add_home_take_offs(DxfDocument& drawing, const Product& product) {
  const transmission::TransmissionPoint* home = product.synthesis.home();
  if (home == nullptr) return;
  const auto index = static_cast<std::size_t>(home - product.synthesis.stroke.data());
  for (const std::size_t i : {0, 1}) {
    const helix::SpiralRow& row = home_row(product.helix->synthesis.sides.at(i), index);
    add_take_off(drawing, {row.x, row.y}, row.turn, i == 0 ? "1" : "2");
  }
}

/// Both spirals in space, above the part's lower face. Their plan view is the plane curve.
std::string spirals_dxf(const Product& product, DxfVersion version) {
  const Mechanism& mechanism = product.joint.mechanism;
  const HelixProduct& helix = *product.helix;
  const double tendon_radius = 0.5 * mechanism.tendon.diameter;
  const auto& sides = helix.synthesis.sides;
  const solid::BoreLayout bore = solid::bore_of_shaft(mechanism, product.pulley.layout.bore);
  const std::vector<std::string> legend = {
      mechanism.name + ": axis at 0, 0 - home is +y, towards the joint - mm, 1:1",
      "z: height above the part's lower face; P1 " + rounded(sides[0].turns, 3) + " turns, lead " +
          rounded(sides[0].lead, 3) + "; P2 " + rounded(sides[1].turns, 3) + " turns, lead " +
          rounded(sides[1].lead, 3) + ", and spare turns",
      "floor = pitch curve - " + rounded(tendon_radius) + " mm (half of the tendon)",
      "true size: not scaled for a print's shrinkage", "the square is 10 mm wide"};
  DxfDocument drawing;
  drawing.remarks = legend;
  drawing.layers = spiral_layers();
  add_spiral(drawing, "P1", sides[0], helix.pulley.p1, tendon_radius);
  add_spiral(drawing, "P2", sides[1], helix.pulley.p2, tendon_radius);
  drawing.add_closed("BORE", bore_contour(bore));
  for (const Polygon& hole : bore.screw_holes) drawing.add_closed("BORE", circle_contour(solid::circle_within(hole)));
  add_axis_and_home(
      drawing, bore.radius,
      std::max(reach_of(sides[0].spiral), reach_of(sides[1].spiral)) + product.pulley.layout.groove_depth);
  add_home_take_offs(drawing, product);
  for (const helical_solid::HelicalAnchor& anchor : helix.pulley.anchors)
    drawing.add_closed("MARK_ANCHOR", circle_contour({anchor.pocket.head<2>(), 2 * anchor.pocket_radius}));
  add_legend(drawing, legend);
  return dxf_text(drawing, version);
}

}  // namespace

std::string profile_dxf(const Product& product, DxfVersion version) {
  if (product.helix) return spirals_dxf(product, version);
  const Mechanism& mechanism = product.joint.mechanism;
  const profile::SynthesisResult& synthesis = product.synthesis;
  const solid::BodyLayout layout = layout_to_cut(product);
  const double tendon_diameter = mechanism.tendon.diameter;
  const std::vector<std::string> legend = {
      mechanism.name + ": axis at 0, 0 - home is +y, towards the joint - mm, 1:1",
      "floor = pitch curve - " + rounded(0.5 * tendon_diameter) + " mm (half of the tendon)",
      "true size: not scaled for a print's shrinkage", "the square is 10 mm wide"};
  DxfDocument drawing;
  drawing.remarks = legend;
  drawing.layers = layers();
  add_contours(drawing, synthesis, tendon_diameter, layout);
  add_axis_and_home(
      drawing, layout.bore.radius,
      std::max(circumradius(profile::parallel(synthesis.p1, 0)), circumradius(profile::parallel(synthesis.p2, 0))) +
          layout.groove_depth);
  if (const transmission::TransmissionPoint* home = synthesis.home()) {
    add_take_off(drawing, contact_point(synthesis.p1, home->t1.lower_normal), home->t1.lower_normal, "1");
    add_take_off(drawing, contact_point(synthesis.p2, home->t2.lower_normal), home->t2.lower_normal, "2");
  }
  add_active_ends(drawing, synthesis, tendon_diameter, layout.groove_depth);
  add_anchors(drawing, product.pulley.anchors, layout);
  add_legend(drawing, legend);
  return dxf_text(drawing, version);
}

}  // namespace fusee::formats
