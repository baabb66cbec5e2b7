/// \file
/// profile.dxf: the curves that the pulley is about, at true size about the axis, with marks that say how it sits at
/// home.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "export/drawings/cut_shapes.h"
#include "export/drawings/dxf_writer.h"
#include "export/drawings/plane_shapes.h"
#include "fusee/base/text.h"
#include "fusee/base/units.h"
#include "fusee/export/drawings.h"

namespace fusee {
namespace {

constexpr double k_text_height = 2.5;
constexpr double k_line_pitch = 4.5;

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

void add_contours(DxfDocument& drawing, const SynthesisResult& synthesis, double d, const BodyLayout& layout) {
  drawing.closed("P1_PITCH", parallel(synthesis.p1, 0));
  drawing.closed("P1_FLOOR", parallel(synthesis.p1, -0.5 * d));
  drawing.closed("P2_PITCH", parallel(synthesis.p2, 0));
  drawing.closed("P2_FLOOR", parallel(synthesis.p2, -0.5 * d));
  drawing.closed("BORE", layout.bore.outline);
  for (const Polygon& hole : layout.bore.screw_holes) drawing.closed("BORE", hole);
}

void add_axis_and_home(DxfDocument& drawing, double bore_radius, double radius) {
  const double arm = bore_radius + 2;
  drawing.open("MARK_AXIS", {{-arm, 0}, {arm, 0}});
  drawing.open("MARK_AXIS", {{0, -arm}, {0, arm}});
  // An arrow outside of everything, towards the joint.
  const double foot = radius + 3;
  const double tip = foot + 8;
  drawing.open("MARK_HOME", {{0, foot}, {0, tip}});
  drawing.open("MARK_HOME", {{-1.2, tip - 3}, {0, tip}, {1.2, tip - 3}});
  drawing.text("MARK_HOME", "HOME", {2.5, tip - 4}, k_text_height);
}

/// `angle` turned by whole turns into [0, 2π).
double positive(double angle) {
  const double rest = std::fmod(angle, k_two_pi);
  return rest < 0 ? rest + k_two_pi : rest;
}

/// The point of the outline whose outward normal points in direction `psi`.
Vec2 contact(const Outline& outline, double psi) {
  const std::size_t n = outline.points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const OutlinePoint& a = outline.points[i];
    const OutlinePoint& b = outline.points[(i + 1) % n];
    const double step = positive(b.psi - a.psi);
    const double part = positive(psi - a.psi);
    if (part < step) return a.position + part / step * (b.position - a.position);
  }
  return outline.points.front().position;
}

/// Where a tendon leaves its pulley at home, and its line from there towards the pin.
void add_take_off(DxfDocument& drawing, const Outline& outline, const TendonPoint& tendon, const char* name) {
  const Vec2 place = contact(outline, tendon.lower_normal);
  Vec2 up = turned_left(unit(tendon.lower_normal));
  if (up.y() < 0) up = -up;
  const Vec2 out = unit(tendon.lower_normal);
  drawing.open("MARK_TAKE_OFF", {place - 1.5 * out, place + 1.5 * out});
  drawing.open("MARK_TAKE_OFF", {place, place + 12 * up});
  drawing.text("MARK_TAKE_OFF", name, place + 12 * up + Vec2(out.x() < 0 ? -3.5 : 1.0, 0), k_text_height);
}

/// Ticks over the groove at both ends of the arc that tendons leave from.
void add_active_ends(DxfDocument& drawing, const Outline& outline, double d, double depth) {
  for (const std::size_t i : {outline.active_first, outline.active_last}) {
    const OutlinePoint& point = outline.points[i];
    drawing.open("MARK_TAKE_OFF",
                 {point.position - 0.5 * d * point.normal, point.position + (depth - 0.5 * d) * point.normal});
  }
}

void add_anchors(DxfDocument& drawing, const std::vector<Anchor>& anchors, const BodyLayout& layout) {
  for (const Anchor& anchor : anchors) {
    if (anchor.channel.size() > 2) drawing.closed("MARK_ANCHOR", anchor.channel);
    const double radius = pocket_radius(anchor, layout);
    if (radius > 0) drawing.closed("MARK_ANCHOR", circle_polygon(anchor.pocket, radius));
  }
}

void add_legend(DxfDocument& drawing, const std::vector<std::string>& lines) {
  const Box2d box = bounding_box(drawing.paths);
  double top = box.low.y() - 4 - k_text_height;
  const Vec2 square(box.low.x(), top + k_text_height - 10);
  drawing.closed("CHECK_10MM", rectangle(square, square + Vec2(10, 10)));
  for (const std::string& line : lines) {
    drawing.text("MARK_TEXT", line, {square.x() + 14, top}, k_text_height);
    top -= k_line_pitch;
  }
}

}  // namespace

std::string profile_dxf(const Product& product, DxfVersion version) {
  const Mechanism& mechanism = product.joint.mechanism;
  const SynthesisResult& synthesis = product.synthesis;
  const BodyLayout layout = layout_to_cut(product);
  const double d = mechanism.tendon.diameter;
  const std::vector<std::string> legend = {mechanism.name + ": axis at 0, 0 - home is +y, towards the joint - mm, 1:1",
                                           "floor = pitch curve - " + rounded(0.5 * d) + " mm (half of the tendon)",
                                           "true size: not scaled for a print's shrinkage", "the square is 10 mm wide"};
  DxfDocument drawing;
  drawing.remarks = legend;
  drawing.layers = layers();
  add_contours(drawing, synthesis, d, layout);
  add_axis_and_home(
      drawing, layout.bore.radius,
      std::max(circumradius(parallel(synthesis.p1, 0)), circumradius(parallel(synthesis.p2, 0))) + layout.groove_depth);
  if (const TransmissionPoint* home = synthesis.home()) {
    add_take_off(drawing, synthesis.p1, home->t1, "1");
    add_take_off(drawing, synthesis.p2, home->t2, "2");
  }
  add_active_ends(drawing, synthesis.p1, d, layout.groove_depth);
  add_active_ends(drawing, synthesis.p2, d, layout.groove_depth);
  add_anchors(drawing, product.pulley.anchors, layout);
  add_legend(drawing, legend);
  return dxf_text(drawing, version);
}

}  // namespace fusee
