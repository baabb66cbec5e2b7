/// \file
/// pulley.scad: the part as an OpenSCAD program that a person can read and change. Its arrays are the two groove
/// floors; all else is computed from the parameters at its top, by the same formulas as src/solid, which this program
/// must agree with.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "fusee/base/text.h"
#include "fusee/base/units.h"
#include "fusee/export/report.h"
#include "solid/body.h"

namespace fusee {
namespace {

// OpenSCAD's exact arithmetic takes about a millisecond a point: fewer points than the mesh has, and no edge further
// from the curve than this.
constexpr double k_sagitta = 0.015;
constexpr double k_widest_turn = radians(8);

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

/// Points that stay: all extremes in x and y, for the box must not shrink, and between them as many as both curves
/// need.
std::vector<std::size_t> kept_points(const Outline& p1, const Outline& p2, const Polygon& middle) {
  const std::size_t n = p1.points.size();
  std::set<std::size_t> fixed_points{0};
  for (const Polygon& curve : {parallel(p1, 0), parallel(p2, 0), middle}) {
    for (const Vec2& direction : {Vec2(1, 0), Vec2(-1, 0), Vec2(0, 1), Vec2(0, -1)}) {
      const auto furthest = std::max_element(curve.begin(), curve.end(), [&](const Vec2& a, const Vec2& b) {
        return a.dot(direction) < b.dot(direction);
      });
      fixed_points.insert(static_cast<std::size_t>(furthest - curve.begin()));
    }
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
  const bool arcs = bore.kind == Bore::d || bore.kind == Bore::keyway;
  double radius = distance_to_edges(bore.outline, Vec2::Zero());
  if (arcs)
    radius = std::min_element(bore.outline.begin(), bore.outline.end(), [](const Vec2& a, const Vec2& b) {
               return a.norm() < b.norm();
             })->norm();
  return 2 * radius - compensation;
}

std::string parameters(const Product& product) {
  const Mechanism& mechanism = product.joint.mechanism;
  const Body& body = mechanism.body;
  const BodyLayout& layout = product.pulley.layout;
  std::string text = fmt::format(
      R"(// {} - a compound pulley for two tendons, in mm.
// Made by fusee. Bottom to top: flange, groove P1, middle flange, groove P2, flange, hub. The axis is z, the joint lies towards +y.
// Change the numbers here or in the Customizer; the groove floors (P1, P2 below) make the joint follow its law and stay as they are.
// The engraved letters and marks of the printed part are left out.

/* [Bore] */
// shaft diameter (across flats for hex and square)
bore = {}; // [1:0.1:40]
// what a printer takes off a hole's diameter
hole_compensation = {}; // [0:0.05:1]

/* [Hub] */
// 0: none
hub_diameter = {}; // [0:0.1:100]
hub_height = {}; // [0:0.5:40]
set_screw = {};
nut_trap = {};

/* [Groove] */
// lip above the groove's floor
groove_depth = {}; // [0.5:0.1:20]
// between the walls, degrees
groove_angle = {}; // [0:1:120]
groove_shape = "{}"; // [u, v, flat]

/* [Flanges] */
flange_thickness = {}; // [0.4:0.1:10]
// chamfer at the print bed
elephant_foot = {}; // [0:0.05:2]

/* [Tie-offs] */
channel_width = {}; // [0.3:0.05:5]
knot_pocket = {}; // [0:0.1:20]
// corners of round things
facets = 24; // [12:4:96]

)",
      on_one_line(mechanism.name), decimal(shaft_diameter(layout.bore, mechanism.material.hole_compensation)),
      decimal(mechanism.material.hole_compensation), decimal(2 * layout.hub_radius),
      decimal(layout.z_hub - layout.z_top), layout.set_screw.present ? "true" : "false",
      layout.set_screw.nut_trap ? "true" : "false", decimal(layout.groove_depth), decimal(degrees(body.groove_angle)),
      name_of(body.groove), decimal(layout.flange_thickness), decimal(layout.elephant_foot),
      decimal(layout.channel_width), decimal(2 * layout.pocket_radius));
  return text;
}

std::string hidden_numbers(const Product& product) {
  const Mechanism& mechanism = product.joint.mechanism;
  const BodyLayout& layout = product.pulley.layout;
  const SynthesisResult& synthesis = product.synthesis;
  const double d = mechanism.tendon.diameter;
  const FlangeRims rims = flange_rims(synthesis.p1, synthesis.p2, d, layout.groove_depth, mechanism.body.flange);
  const RimMargins margins =
      rim_margins(rims, synthesis.p1, synthesis.p2, layout.groove_depth - 0.5 * d, mechanism.body.flange);
  const BoreLayout& bore = layout.bore;
  const double bore_top = std::max_element(bore.outline.begin(), bore.outline.end(), [](const Vec2& a, const Vec2& b) {
                            return a.y() < b.y();
                          })->y();
  const SetScrewLayout& screw = layout.set_screw;
  const double middle = 0.5 * (layout.z_top + layout.z_hub);
  const double bore_edge =
      0.5 * (shaft_diameter(bore, mechanism.material.hole_compensation) + mechanism.material.hole_compensation);
  const double nut_from_bore = screw.nut_trap ? screw.nut_distance - bore_edge : 0;
  const double hub_wall =
      std::clamp(layout.hub_radius - bore_edge - nut_from_bore - 0.5 * screw.nut_thickness, 0.0, 1.5);
  std::string text = fmt::format(
      R"(/* [Hidden] */
tendon = {};          // its diameter
seat_ratio = {};      // seat radius of a u groove per tendon diameter
flange_shape = "{}";  // follow: along the groove; round
lower_margin = {};    // how far the flanges stand outside of the groove's lip
middle_margin = {};
upper_margin = {};
bore_shape = "{}";
bore_top = {};        // d: the flat, keyway: the key's ground, from the axis
key_width = {};
screw_hole = {};      // diameter
screw_angle = {};     // direction, degrees
screw_lift = {};      // above the middle of the hub
nut_width = {};       // across flats
nut_thickness = {};
nut_from_bore = {};   // from the bore's edge to the middle of the nut
hub_wall = {};        // the hub grows with the bore so that this is left outside of it and of the nut
print_scale = {};     // a print shrinks by as much

)",
      decimal(d), decimal(mechanism.body.seat_ratio), mechanism.body.flange == Flange::follow ? "follow" : "round",
      decimal(margins.lower), decimal(margins.middle), decimal(margins.upper), name_of(bore.kind), decimal(bore_top),
      decimal(bore.kind == Bore::keyway ? 2 * bore.outline.back().cwiseAbs().x() : 0), decimal(screw.hole_diameter),
      decimal(degrees(screw.angle)), decimal(screw.present ? screw.z - middle : 0), decimal(screw.nut_width),
      decimal(screw.nut_thickness), decimal(nut_from_bore), decimal(hub_wall), fixed(layout.scale, 9));
  text += "horn_recess = " + decimal(bore.horn_recess) +
          ";     // depth of a servo horn's pocket; 0: the bore goes through\n";
  text += "horn_teeth = " + (bore.spline_teeth > 0 ? points_text(bore.outline) : "[]") +
          ";     // outline around a servo's toothed shaft\n";
  text += "horn_holes = [";
  for (std::size_t k = 0; k < bore.screw_holes.size(); ++k)
    text += (k == 0 ? "" : ",\n  ") + points_text(bore.screw_holes[k]);
  return text + "];\n\n";
}

/// Countersink, slot and pilot of a tie-off, each [] where there is none.
std::string at_face_text(const Anchor& anchor) {
  const auto& tail = anchor.tail;
  const std::string seat =
      anchor.seat ? fmt::format("[{}, {}]", decimal(anchor.seat->radius), decimal(anchor.seat->depth)) : "[]";
  const std::string slot = tail ? fmt::format("[{}, {}]", points_text(tail->outline()), decimal(tail->depth)) : "[]";
  const std::string pilot =
      tail && tail->pilot_diameter > 0
          ? fmt::format("[{}, {}, {}, {}]", decimal(tail->to.x()), decimal(tail->to.y()), decimal(tail->pilot_diameter),
                        decimal(tail->pilot_depth))
          : "[]";
  return seat + ", " + slot + ", " + pilot;
}

std::string arrays(const Product& product) {
  const SynthesisResult& synthesis = product.synthesis;
  const double d = product.joint.mechanism.tendon.diameter;
  const FlangeRims rims = flange_rims(synthesis.p1, synthesis.p2, d, product.pulley.layout.groove_depth,
                                      product.joint.mechanism.body.flange);
  const std::vector<std::size_t> kept = kept_points(synthesis.p1, synthesis.p2, rims.middle);
  std::string text =
      "// The groove floors: x, y, and the direction in which the floor looks there, degrees. Point i of both looks "
      "the same way.\n";
  text += floor_array("P1", synthesis.p1, d, kept);
  text += floor_array("P2", synthesis.p2, d, kept);
  text +=
      "\n// Where tendons are tied off: groove (1 or 2), middle of the knot pocket, outline of channel and "
      "pocket,\n// countersink of a hole to the face in their place [radius, depth], slot for the tail [outline, depth], "
      "pilot of its screw [x, y, diameter, depth].\ntie_offs = [";
  bool first = true;
  for (const Anchor& anchor : product.pulley.anchors) {
    text += fmt::format("{}\n  [{}, {}, {}, {}]", first ? "" : ",", anchor.side == Side::left ? 1 : 2,
                        point_text(anchor.pocket), points_text(anchor.channel), at_face_text(anchor));
    first = false;
  }
  return text + "];\n\n";
}

constexpr std::string_view k_program = R"SCAD(
// ---- the groove's cross-section: [outward from the floor, along the axis from the groove's middle], one half ----
lean = groove_angle / 2;
seat = max(0.5, seat_ratio) * tendon;
seat_steps = max(1, ceil((90 - lean) / (2 * acos(1 / (1 + 0.01 / seat)))));
seat_step = (90 - lean) / seat_steps;
seat_corner = seat / cos(seat_step / 2);
ground =
  groove_shape == "u" ? [for (k = [0 : seat_steps - 1]) [k == 0 ? 0 : seat - seat_corner * cos((k + 0.5) * seat_step), seat_corner * sin((k + 0.5) * seat_step)]] :
  groove_shape == "v" ? [[0, tendon / 2 * tan(45 - lean / 2)]] :
  [[0, 0.7 * tendon]];
below_lip = [for (k = [0 : len(ground) - 1]) if (k == 0 || ground[k][0] < groove_depth) ground[k]];
last = below_lip[len(below_lip) - 1];
section = concat(below_lip, [[groove_depth, last[1] + (groove_depth - last[0]) * tan(lean)]]);
half_width = section[len(section) - 1][1];

// ---- heights ----
z_p1 = flange_thickness + half_width;
z_p2 = z_p1 + 2 * half_width + flange_thickness;
z_top = z_p2 + half_width + flange_thickness;
has_hub = hub_diameter > 0 && hub_height > 0;
bore_edge = (bore + hole_compensation) / 2;
nut_room = set_screw && nut_trap ? nut_from_bore + nut_thickness / 2 : 0;
hub_radius = max(hub_diameter / 2, bore_edge + nut_room + hub_wall);
z_hub = z_top + (has_hub ? hub_height : 0);

// ---- outlines: curves parallel to a floor, circles, and the middle flange around both grooves ----
n = len(P1);
function parallel(P, out) = [for (p = P) [p[0] + out * cos(p[2]), p[1] + out * sin(p[2])]];
function circle_like(r) = [for (p = P1) r * [cos(p[2]), sin(p[2])]];
function reach(P, out) = max([for (p = parallel(P, out)) norm(p)]);
// how far a floor reaches in its own direction, and along it
function support(p) = p[0] * cos(p[2]) + p[1] * sin(p[2]);
function aside(p) = -p[0] * sin(p[2]) + p[1] * cos(p[2]);
blend = 0.5;
function around_both(out) = [for (i = [0 : n - 1]) let (
    s1 = support(P1[i]), s2 = support(P2[i]), most = max(s1, s2),
    w1 = exp((s1 - most) / blend), w2 = exp((s2 - most) / blend),
    h = most + blend * ln(w1 + w2) + out,
    t = (w1 * aside(P1[i]) + w2 * aside(P2[i])) / (w1 + w2),
    a = P1[i][2]) [h * cos(a) - t * sin(a), h * sin(a) + t * cos(a)]];

is_round = flange_shape == "round";
lower_reach = reach(P1, groove_depth) + lower_margin;
lower = is_round ? circle_like(lower_reach) : parallel(P1, groove_depth);
lower_foot = is_round ? circle_like(lower_reach - elephant_foot) : parallel(P1, groove_depth - elephant_foot);
middle = is_round ? circle_like(max(reach(P1, groove_depth), reach(P2, groove_depth)) + middle_margin)
                  : around_both(groove_depth + middle_margin);
upper = is_round ? circle_like(reach(P2, groove_depth) + upper_margin) : parallel(P2, groove_depth);

// ---- the body: rings [z, outline] from bottom to top, skinned ----
function groove_rings(P, z) = concat(
  [for (k = [len(section) - 1 : -1 : 0]) [z - section[k][1], parallel(P, section[k][0])]],
  [for (k = [0 : len(section) - 1]) [z + section[k][1], parallel(P, section[k][0])]]);
rings = concat(
  elephant_foot > 0 ? [[0, lower_foot]] : [],
  [[elephant_foot, lower]],
  is_round ? [[z_p1 - half_width, lower]] : [],
  groove_rings(P1, z_p1),
  [[z_p1 + half_width, middle], [z_p2 - half_width, middle]],
  groove_rings(P2, z_p2),
  is_round ? [[z_p2 + half_width, upper]] : [],
  [[z_top, upper]],
  has_hub ? [[z_top, circle_like(hub_radius)], [z_hub, circle_like(hub_radius)]] : []);

module skin(rings) {
  count = len(rings);
  points = [for (r = rings) for (p = r[1]) [p[0], p[1], r[0]]];
  sides = [for (k = [0 : count - 2]) for (i = [0 : n - 1]) let (j = (i + 1) % n, a = k * n, b = a + n)
    each [[a + i, b + j, a + j], [a + i, b + i, b + j]]];
  bottom = [for (i = [0 : n - 1]) i];
  top = [for (i = [n - 1 : -1 : 0]) (count - 1) * n + i];
  polyhedron(points, concat(sides, [bottom, top]));
}

// ---- what is cut out ----
// A hole whose flat sides touch the circle from outside: prints to size.
module polyhole(d, sides) {
  rotate(90 + 180 / sides) circle(r = d / 2 / cos(180 / sides), $fn = sides);
}

module bore_outline() {
  d = bore + hole_compensation;
  if (len(horn_teeth) > 0) polygon(horn_teeth);
  else if (bore_shape == "hex") polyhole(d, 6);
  else if (bore_shape == "square") polyhole(d, 4);
  else if (bore_shape == "d") intersection() { circle(d = d, $fn = 96); translate([-d, -2 * d + bore_top]) square(2 * d); }
  else if (bore_shape == "keyway") { circle(d = d, $fn = 96); translate([-key_width / 2, 0]) square([key_width, bore_top]); }
  else polyhole(d, max(8, round(2 * d)));
}

module bore_hole() {
  translate([0, 0, -1]) linear_extrude(1 + (horn_recess > 0 ? horn_recess : z_hub + 1)) bore_outline();
  for (hole = horn_holes) translate([0, 0, -1]) linear_extrude(z_hub + 2) polygon(hole);
}

// The channel in the groove's plane, and the pocket from the nearer face up to it.
module channel(t) {
  z = t[0] == 1 ? z_p1 : z_p2;
  translate([0, 0, z - channel_width / 2]) linear_extrude(channel_width) polygon(t[2]);
  low = t[0] == 1 ? -1 : z - channel_width / 2;
  high = t[0] == 1 ? z + channel_width / 2 : z_hub + 1;
  translate([t[1][0], t[1][1], low]) cylinder(d = knot_pocket, h = high - low, $fn = facets);
}

// Seen from its face, which lies at 0 and looks down: a countersunk hole to the groove.
module face_hole(t, to_groove) {
  translate([0, 0, -z_hub]) linear_extrude(z_hub + to_groove + channel_width / 2) polygon(t[2]);
  translate([t[1][0], t[1][1], -z_hub + z_top - 1]) cylinder(r = t[3][0], h = z_hub - z_top + 1, $fn = facets);
  hull() {
    translate([t[1][0], t[1][1], -0.01]) cylinder(r = t[3][0], h = 0.01, $fn = facets);
    translate([0, 0, t[3][1]]) linear_extrude(0.01) polygon(t[2]);
  }
}

// What lies flush in the face, seen in the same way: the tail, and its screw.
module tail(t) {
  if (len(t[4]) > 0) translate([0, 0, -1]) linear_extrude(t[4][1] + 1) polygon(t[4][0]);
  if (len(t[5]) > 0) translate([t[5][0], t[5][1], 0]) cylinder(d = t[5][2], h = t[5][3], $fn = facets);
}

module tie_off(t) {
  on_p1 = t[0] == 1;
  if (len(t[3]) == 0) channel(t);
  translate([0, 0, on_p1 ? 0 : z_top]) mirror([0, 0, on_p1 ? 0 : 1]) {
    if (len(t[3]) > 0) face_hole(t, on_p1 ? z_p1 : z_top - z_p2);
    tail(t);
  }
}

// Round below, a roof above: it prints lying down without support.
module screw_hole() {
  z = (z_top + z_hub) / 2 + screw_lift;
  translate([0, 0, z]) rotate([0, 0, screw_angle]) rotate([90, 0, 90]) linear_extrude(hub_radius + 1) {
    circle(d = screw_hole, $fn = facets);
    rotate(45) square(screw_hole / 2);
  }
  if (nut_trap) rotate([0, 0, screw_angle])
    translate([bore_edge + nut_from_bore - nut_thickness / 2, -nut_width / 2, z - nut_width / sqrt(3)])
      cube([nut_thickness, nut_width, z_hub - z + nut_width / sqrt(3) + 1]);
}

// One difference: what is cut out is put together first, for that is small and quick.
scale(print_scale) difference() {
  skin(rings);
  union() {
    bore_hole();
    for (t = tie_offs) tie_off(t);
    if (set_screw && has_hub) screw_hole();
  }
}
)SCAD";

}  // namespace

std::string scad_text(const Product& product) {
  return parameters(product) + hidden_numbers(product) + arrays(product) + std::string(k_program.substr(1));
}

}  // namespace fusee
