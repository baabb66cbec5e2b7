/// \file
/// pulley.scad: the part as an OpenSCAD program that a person can read and change. Written here are the parameters at
/// its top and its arrays: the groove floors, and where tendons are tied off. The program itself is the file
/// pulley.scad beside this one: it computes all else by the same formulas as src/solid, which it must agree with.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "export/report/report_parts.h"
#include "fusee/base/text.h"
#include "fusee/base/units.h"
#include "fusee/export/report.h"
#include "solid/body.h"
#include "solid/bore.h"
#include "solid/mouths.h"

namespace fusee {
namespace {

// OpenSCAD's exact arithmetic takes about a millisecond a point: fewer points than the mesh has, and no edge further
// from the curve than this.
constexpr double k_sagitta = 0.015;
constexpr double k_widest_turn = radians(4);

std::string decimal(double value) { return trimmed_fixed(value, 5); }

// A comment must stay one, whatever the mechanism is called.
std::string on_one_line(const std::string& text) {
  std::string line;
  for (const char c : text) line += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  return line;
}

std::string point_text(const Vec2& p) { return "[" + decimal(p.x()) + ", " + decimal(p.y()) + "]"; }

std::string points_text(const Polygon& points) {
  std::string text = "[";
  for (std::size_t i = 0; i < points.size(); ++i)
    text += (i == 0 ? "" : i % 8 == 0 ? ",\n    " : ", ") + point_text(points[i]);
  return text + "]";
}

/// Points that stay: the furthest from the axis and all extremes in x and y, for neither a round flange nor the box
/// must shrink, and between them as many as both curves need.
std::vector<std::size_t> kept_points(const Outline& p1, const Outline& p2, const FlangeRims& rims) {
  const std::size_t n = p1.points.size();
  std::set<std::size_t> fixed_points{0};
  for (const Polygon& curve : {rims.lip1, rims.lip2, rims.middle}) {
    const auto keep_furthest = [&](const auto& reach) {
      const auto furthest = std::max_element(curve.begin(), curve.end(),
                                             [&](const Vec2& a, const Vec2& b) { return reach(a) < reach(b); });
      fixed_points.insert(static_cast<std::size_t>(furthest - curve.begin()));
    };
    for (const Vec2& direction : {Vec2(1, 0), Vec2(-1, 0), Vec2(0, 1), Vec2(0, -1)})
      keep_furthest([&](const Vec2& point) { return point.dot(direction); });
    keep_furthest([](const Vec2& point) { return point.norm(); });
  }
  const auto too_far = [&](std::size_t from, std::size_t to) {
    const double turn = p1.points[to].psi - p1.points[from].psi;
    const double chord = std::max((p1.points[to].position - p1.points[from].position).norm(),
                                  (p2.points[to].position - p2.points[from].position).norm());
    return turn > k_widest_turn || chord * turn / 8 > k_sagitta;
  };
  std::vector<std::size_t> kept{0};
  for (std::size_t i = 1; i < n; ++i) {
    const bool last_chance = i + 1 < n && too_far(kept.back(), i + 1);
    if (fixed_points.count(i) || last_chance) kept.push_back(i);
  }
  return kept;
}

std::string floor_array(const char* name, const Outline& outline, double d, const std::vector<std::size_t>& kept) {
  const Polygon floor = parallel(outline, -0.5 * d);
  std::string text = fmt::format("{} = [", name);
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const Vec2& p = floor[kept[k]];
    text += (k == 0       ? "\n  "
             : k % 4 == 0 ? ",\n  "
                          : ", ") +
            fmt::format("[{}, {}, {}]", decimal(p.x()), decimal(p.y()), decimal(degrees(outline.points[kept[k]].psi)));
  }
  return text + "];\n";
}

/// How far the flanges stand outside the lips: body.h chooses it.
struct RimMargins {
  double lower = 0, middle = 0, upper = 0;
};

RimMargins rim_margins(const FlangeRims& rims, const Outline& p1, const Outline& p2, double lip, Flange kind) {
  const double r1 = circumradius(rims.lip1), r2 = circumradius(rims.lip2);
  if (kind == Flange::round)
    return {circumradius(rims.lower) - r1, circumradius(rims.middle) - std::max(r1, r2), circumradius(rims.upper) - r2};
  const Vec2& n = p1.points[0].normal;
  const double h1 = p1.points[0].position.dot(n), h2 = p2.points[0].position.dot(n);
  const double blend = 0.5;
  const double around = std::max(h1, h2) + blend * std::log1p(std::exp(-std::abs(h1 - h2) / blend)) + lip;
  return {0, rims.middle[0].dot(n) - around, 0};
}

const char* name_of(Groove groove) { return groove == Groove::u ? "u" : groove == Groove::v ? "v" : "flat"; }

const char* name_of(Bore bore) {
  switch (bore) {
    case Bore::round:
      return "round";
    case Bore::d:
      return "d";
    case Bore::hex:
      return "hex";
    case Bore::square:
      return "square";
    case Bore::keyway:
      return "keyway";
    case Bore::horn:
      return "horn";
  }
  return "round";
}

/// The shaft's diameter (across flats) that a bore's outline was made for.
double shaft_diameter(const BoreLayout& bore, double compensation) {
  const double radius =
      bore.arc_points > 0 ? bore.outline.front().norm() : distance_to_edges(bore.outline, Vec2::Zero());
  return 2 * radius - compensation;
}

/// A number of the Customizer with its slider, in mm or degrees.
struct Slider {
  const char* name;
  const char* words;  ///< what the Customizer says above it
  double value, low, step, high;
};

// A slider moves its number onto its steps: they are made so fine that the part's own number is one of them.
// 0.001 mm is finer than anything that makes the part.
std::string slider_text(const Slider& slider) {
  const double value = std::round(slider.value * 1000) / 1000;
  const auto between = [&](double step) { return std::abs(std::remainder(value - slider.low, step)) > 1e-9; };
  double step = slider.step;
  for (const double finer : {0.01, 0.001}) {
    if (between(step)) step = finer;
  }
  return fmt::format("// {}\n{} = {}; // [{}:{}:{}]\n", slider.words, slider.name, decimal(value),
                     decimal(std::min(slider.low, value)), decimal(step),
                     decimal(std::max(slider.high, std::ceil(value))));
}

std::string tick_box(const char* name, const char* words, bool value) {
  return fmt::format("// {}\n{} = {};\n", words, name, value);
}

/// What else a D or a keyway is made of.
std::string flat_sliders(const BoreLayout& bore, double compensation) {
  const double radius = 0.5 * shaft_diameter(bore, compensation);
  const double top = bore.outline.back().y() - 0.5 * compensation;
  if (bore.kind == Bore::d)
    return slider_text({"bore_flat", "from the flat to the far side of the shaft", top + radius, 0.5, 0.1, 40});
  if (bore.kind != Bore::keyway) return "";
  const double width = 2 * std::abs(bore.outline.back().x()) - compensation;
  return slider_text({"key_width", "of the keyway", width, 0.5, 0.1, 20}) +
         slider_text({"key_depth", "of the keyway, from the shaft's edge", top - radius, 0, 0.1, 10});
}

/// What of the shaft and the screw this part has none of is no parameter, but a number that the program reads.
std::string parameters(const Product& product) {
  const Mechanism& mechanism = product.joint.mechanism;
  const Body& body = mechanism.body;
  const BodyLayout& layout = product.pulley.layout;
  const SetScrewLayout& screw = layout.set_screw;
  std::string text = fmt::format(
      R"(// {} - a compound pulley for two tendons, in mm.
// Made by fusee. Bottom to top: flange, groove P1, middle flange, groove P2, flange, hub. The axis is z, the joint lies towards +y.
// Change the numbers here or in the Customizer; the groove floors (P1, P2 below) make the joint follow its law and stay as they are.
// The engraved letters and marks of the printed part are left out.

/* [View] */
// the part as it is in use, or what goes to the printer, each as it lies there
show = "assembled"; // [assembled, print{}]

/* [Bore] */
)",
      on_one_line(mechanism.name), layout.parts == Parts::two ? ", P1, P2" : "");
  if (layout.bore.kind != Bore::horn)
    text += slider_text(
        {"bore",
         layout.bore.circle
             ? "shaft diameter; the hole is a polygon around it, for a printer's corners cut inside of a curve"
             : "shaft diameter (across flats for hex and square)",
         shaft_diameter(layout.bore, mechanism.material.hole_compensation), 1, 0.1, 40});
  text += flat_sliders(layout.bore, mechanism.material.hole_compensation);
  text += slider_text({"hole_compensation",
                       "added to the diameter of the bore and of a horn's holes: what a printer takes off it",
                       mechanism.material.hole_compensation, 0, 0.05, 1});
  text += "\n/* [Hub] */\n";
  text += slider_text({"hub_diameter", "0: no hub", 2 * layout.hub_radius, 0, 0.1, 100});
  text += slider_text({"hub_height", "above the upper flange, 0: no hub", layout.z_hub - layout.z_top, 0, 0.5, 40});
  if (screw.present) text += tick_box("set_screw", "a screw through the hub onto the shaft", true);
  if (screw.nut_trap) text += tick_box("nut_trap", "a pocket for the set screw's nut", true);
  text += "\n/* [Groove] */\n";
  text += slider_text({"groove_depth", "lip above the groove's floor", layout.groove_depth, 0.5, 0.1, 20});
  text += slider_text({"groove_angle", "between the walls, degrees", degrees(body.groove_angle), 0, 1, 120});
  text += fmt::format("// cross-section of the groove's ground\ngroove_shape = \"{}\"; // [u, v, flat]\n",
                      name_of(body.groove));
  text += "\n/* [Flanges] */\n";
  text += slider_text({"flange_thickness", "of each of the three", layout.flange_thickness, 0.4, 0.1, 10});
  text += "\n/* [Tie-offs] */\n";
  text +=
      slider_text({"channel_width", "of the tendons' channels, holes and slots", layout.channel_width, 0.3, 0.05, 5});
  text += slider_text({"knot_pocket", "diameter, 0: none", 2 * layout.pocket_radius, 0, 0.1, 20});
  text += "// corners of round things\nfacets = 24; // [12:4:96]\n";
  text += "\n/* [Printing] */\n";
  text += tick_box("supports", "the printer makes supports, and nothing is made steep to need none",
                   mechanism.print.supports);
  text += slider_text({"overhang_deg", "the flattest slope above the horizontal that a face looking down may have",
                       degrees(mechanism.print.overhang), 20, 1, 75});
  text += slider_text({"elephant_foot", "chamfer at the print bed", layout.elephant_foot, 0, 0.05, 2}) + "\n";
  return text;
}

/// A number that the program reads and no slider moves.
std::string hidden(const char* name, double value, const char* words) {
  return fmt::format("{} = {};  // {}\n", name, decimal(value), words);
}

std::string flange_numbers(const Product& product, const FlangeRims& rims) {
  const Mechanism& mechanism = product.joint.mechanism;
  const Flange kind = mechanism.body.flange;
  const BodyLayout& layout = product.pulley.layout;
  const double lip = layout.groove_depth - 0.5 * mechanism.tendon.diameter;
  const RimMargins margins = rim_margins(rims, product.synthesis.p1, product.synthesis.p2, lip, kind);
  // Of 45°, as high as it is wide.
  const auto ledge = [](const Polygon& inner, const Polygon& outer) { return cone_height(inner, outer, radians(45)); };
  const double roof = std::max(layout.p2.below_width(), layout.p2.above_width());
  return fmt::format("flange_shape = \"{}\";  // follow: along the groove; round\n",
                     kind == Flange::follow ? "follow" : "round") +
         hidden("lower_margin", margins.lower, "how far the flanges stand outside of the groove's lip") +
         hidden("middle_margin", margins.middle, "the middle one outside of both") +
         hidden("upper_margin", margins.upper, "the same of the upper one") +
         hidden("lower_ledge", ledge(rims.lip1, rims.lower), "how far they stand out over it where that is most") +
         hidden("middle_ledge", ledge(rims.lip1, rims.middle), "the middle one over P1's") +
         hidden("upper_ledge", ledge(rims.lip2, rims.upper), "the upper one over P2's") +
         hidden("mouth_rise", mouth_rise(layout) + roof - 0.5 * layout.channel_width,
                "of a channel's ceiling, up to where it cuts the groove's lip") +
         hidden("min_wall", layout.min_wall, "no wall is thinner");
}

std::string screw_numbers(const BodyLayout& layout, double compensation) {
  const SetScrewLayout& screw = layout.set_screw;
  const double bore_edge = 0.5 * (shaft_diameter(layout.bore, compensation) + compensation);
  const double nut_from_bore = screw.nut_trap ? screw.nut_distance - bore_edge : 0;
  const double hub_wall =
      layout.hub_radius > 0
          ? std::clamp(layout.hub_radius - bore_edge - nut_from_bore - 0.5 * screw.nut_thickness, 0.0, 1.5)
          : layout.min_wall;
  return (screw.present ? "" : "set_screw = false;\n") + std::string(screw.nut_trap ? "" : "nut_trap = false;\n") +
         hidden("screw_hole", screw.hole_diameter, "diameter") +
         hidden("screw_angle", degrees(screw.angle), "direction, degrees") +
         hidden("nut_width", screw.nut_width, "across flats") +
         hidden("nut_thickness", screw.nut_thickness, "along the screw") +
         hidden("nut_from_bore", nut_from_bore, "from the bore's edge to the middle of the nut") +
         hidden("hub_wall", hub_wall, "the hub grows with the bore so that this is left outside of it and of the nut");
}

std::string directions_text(const Polygon& points) {
  std::vector<std::string> angles;
  for (const Vec2& point : points) angles.push_back(decimal(degrees(std::atan2(point.y(), point.x()))));
  return fmt::format("{}", fmt::join(angles, ", "));
}

std::string bore_numbers(const BoreLayout& bore, double compensation) {
  std::string text;
  if (bore.kind == Bore::horn) text += hidden("bore", shaft_diameter(bore, compensation), "of the horn");
  const Polygon rim = bore.horn_recess > 0 ? recess_cone(bore).rim : bore.outline;
  text += fmt::format("bore_shape = \"{}\";\n", name_of(bore.kind));
  text += hidden("horn_recess", bore.horn_recess, "depth of a servo horn's pocket; 0: the bore goes through");
  text += fmt::format("horn_rays = [{}];  // degrees: where the pocket's cone has corners\n",
                      bore.horn_recess > 0 ? directions_text(rim) : "");
  text += fmt::format("horn_teeth = {};  // outline around a servo's toothed shaft\n",
                      bore.spline_teeth > 0 ? points_text(rim) : "[]");
  std::vector<std::string> holes;
  for (const Polygon& outline : bore.screw_holes) {
    const RoundHole hole = circle_within(outline);
    holes.push_back(fmt::format("[{}, {}, {}]", decimal(hole.centre.x()), decimal(hole.centre.y()),
                                decimal(hole.diameter - compensation)));
  }
  return text + fmt::format("horn_holes = [{}];  // of its screws: x, y, diameter\n", fmt::join(holes, ", "));
}

std::string dowel_numbers(const BodyLayout& layout) {
  const DowelLayout& dowels = layout.dowels;
  return fmt::format("dowels = {};  // pins that locate P1 and P2 on each other\n", points_text(dowels.places)) +
         hidden("dowel_pin", dowels.pin_diameter, "diameter") +
         hidden("dowel_end", dowels.places.empty() ? 0 : dowels.z_end - layout.z_p2,
                "of its hole at most, above groove P2's middle");
}

std::string hidden_numbers(const Product& product, const FlangeRims& rims) {
  const Mechanism& mechanism = product.joint.mechanism;
  const BodyLayout& layout = product.pulley.layout;
  const double compensation = mechanism.material.hole_compensation;
  return "/* [Hidden] */\n" +
         hidden("parts", layout.parts == Parts::two ? 2 : 1, "as it is printed: 2: P1 and P2 apart") +
         hidden("tendon", mechanism.tendon.diameter, "its diameter") +
         hidden("seat_ratio", mechanism.body.seat_ratio, "seat radius of a u groove per tendon diameter") +
         flange_numbers(product, rims) + bore_numbers(layout.bore, compensation) + screw_numbers(layout, compensation) +
         dowel_numbers(layout) +
         fmt::format("print_scale = {};  // a print shrinks by as much\n\n", fixed(layout.scale, 9));
}

/// `name = [row, row …];`, a row a line.
std::string array_text(const char* name, const char* words, const std::vector<std::string>& rows) {
  return fmt::format("\n// {}\n{} = [{}{}];\n", words, name, rows.empty() ? "" : "\n  ", fmt::join(rows, ",\n  "));
}

int groove_of(const Anchor& anchor) { return anchor.side == Side::left ? 1 : 2; }

/// From where the channel begins to run straight into its pocket, to the end of its inner edge.
Vec2 straight_run(const Polygon& inner, const Vec2& pocket) {
  const Vec2 outward = (pocket - inner.back()).normalized();
  const auto first = std::find_if(inner.begin(), inner.end(), [&](const Vec2& point) {
    return std::abs((point - inner.back()).dot(outward)) < 1e-6;
  });
  return inner.back() - *first;
}

/// The mouth runs along the outer edge and back along the inner one.
std::string channel_text(const Anchor& anchor) {
  const auto half = static_cast<std::ptrdiff_t>(anchor.mouth.size() / 2);
  const Polygon outer(anchor.mouth.begin(), anchor.mouth.begin() + half);
  const Polygon inner(anchor.mouth.rbegin(), anchor.mouth.rbegin() + half);
  return fmt::format("[{}, {},\n   {},\n   {},\n   {}]", groove_of(anchor), point_text(anchor.pocket),
                     points_text(outer), points_text(inner), point_text(straight_run(inner, anchor.pocket)));
}

std::string face_hole_text(const Anchor& anchor, const Outline& outline) {
  const auto nearest =
      std::min_element(outline.points.begin(), outline.points.end(), [&](const OutlinePoint& a, const OutlinePoint& b) {
        return (a.position - anchor.exit).squaredNorm() < (b.position - anchor.exit).squaredNorm();
      });
  return fmt::format("[{}, {}, {}, {}, {}, {}]", groove_of(anchor), point_text(anchor.seat->hole),
                     decimal(degrees(nearest->psi)), decimal(anchor.seat->radius), decimal(anchor.seat->depth),
                     decimal(anchor.seat->length));
}

std::string tail_slot_text(const Anchor& anchor) {
  const TailSlot& slot = *anchor.tail;
  return fmt::format("[{}, {}, {}, {}, {}]", groove_of(anchor), point_text(slot.from), point_text(slot.to),
                     decimal(slot.depth), decimal(slot.roof));
}

std::string clamp_pilot_text(const Anchor& anchor, double compensation) {
  const TailSlot& slot = *anchor.tail;
  return fmt::format("[{}, {}, {}, {}]", groove_of(anchor), point_text(slot.to),
                     decimal(slot.pilot_diameter - compensation), decimal(slot.pilot_depth));
}

std::string tie_off_arrays(const Product& product) {
  std::vector<std::string> channels, holes, slots, pilots;
  for (const Anchor& anchor : product.pulley.anchors) {
    if (anchor.seat) {
      const bool left = anchor.side == Side::left;
      holes.push_back(face_hole_text(anchor, left ? product.synthesis.p1 : product.synthesis.p2));
    } else {
      channels.push_back(channel_text(anchor));
    }
    if (!anchor.tail) continue;
    slots.push_back(tail_slot_text(anchor));
    if (anchor.tail->pilot_diameter > 0)
      pilots.push_back(clamp_pilot_text(anchor, product.joint.mechanism.material.hole_compensation));
  }
  return "\n// Where tendons are tied off, each with its groove (1 or 2) first." +
         array_text(
             "channels",
             "middle of the knot pocket, outer edge, inner edge, both from the groove inwards, and their straight end",
             channels) +
         array_text("face_holes",
                    "slots to the face: the round end's middle, the way out, countersink's radius and depth, length",
                    holes) +
         array_text("tail_slots", "slot for the tendon's tail in the face: from, to, depth, its gable's height",
                    slots) +
         array_text("clamp_pilots", "hole of the tail's screw: place, diameter, depth below the face", pilots) + "\n";
}

std::string floor_arrays(const Product& product, const FlangeRims& rims) {
  const SynthesisResult& synthesis = product.synthesis;
  const double d = product.joint.mechanism.tendon.diameter;
  const std::vector<std::size_t> kept = kept_points(synthesis.p1, synthesis.p2, rims);
  return "// The groove floors: x, y, and the direction in which the floor looks there, degrees. Point i of both looks "
         "the same way.\n" +
         floor_array("P1", synthesis.p1, d, kept) + floor_array("P2", synthesis.p2, d, kept);
}

}  // namespace

std::string scad_text(const Product& product) {
  const Mechanism& mechanism = product.joint.mechanism;
  const FlangeRims rims = flange_rims(product.synthesis.p1, product.synthesis.p2, mechanism.tendon.diameter,
                                      product.pulley.layout.groove_depth, mechanism.body.flange);
  return parameters(product) + hidden_numbers(product, rims) + floor_arrays(product, rims) + tie_off_arrays(product) +
         std::string(embedded::pulley_scad);
}

}  // namespace fusee
