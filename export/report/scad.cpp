/// \file
/// pulley.scad: the part as an OpenSCAD program that a person can read and change. This file writes its parameters and
/// arrays: the groove floors and the tie-offs. The program itself is the file pulley.scad in this folder. It uses the
/// formulas of src/solid and must agree with them.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/text.h"
#include "export/report/helix_scad.h"
#include "export/report/report.h"
#include "export/report/scad_words.h"
#include "fusee/base.h"
#include "solid/body.h"
#include "solid/bore.h"
#include "solid/channel_entries.h"

namespace fusee::formats {

using namespace scad;

namespace {

// OpenSCAD's exact arithmetic takes about a millisecond per point. There are fewer points than in the mesh, with edges
// within this distance of the curve, mm.
constexpr double k_sagitta = 0.015;
constexpr double k_widest_turn = radians(4);

/// Indices of points to keep: the furthest from the axis and all extremes in x and y, so that neither a round flange
/// nor the bounding box shrinks, and between them as many as both curves require.
std::vector<std::size_t> kept_points(const profile::Outline& p1, const profile::Outline& p2,
                                     const solid::FlangeRims& rims) {
  const std::size_t n = p1.points.size();
  std::set<std::size_t> fixed_points{0};
  for (const Polygon& curve : {rims.groove_edge1, rims.groove_edge2, rims.middle}) {
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
    const double sagitta = chord * turn / 8;  // of a circular arc with a small turn
    return turn > k_widest_turn || sagitta > k_sagitta;
  };
  std::vector<std::size_t> kept{0};
  for (std::size_t i = 1; i < n; ++i) {
    const bool last_chance = i + 1 < n && too_far(kept.back(), i + 1);
    if (fixed_points.count(i) || last_chance) kept.push_back(i);
  }
  return kept;
}

std::string floor_array(const char* name, const profile::Outline& outline, double tendon_diameter,
                        const std::vector<std::size_t>& kept) {
  const Polygon floor = profile::parallel(outline, -0.5 * tendon_diameter);
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

/// Margins of the flanges outside the groove edges, mm. solid/body.h chooses them.
struct RimMargins {
  double lower = 0, middle = 0, upper = 0;
};

RimMargins rim_margins(const solid::FlangeRims& rims, const profile::Outline& p1, const profile::Outline& p2,
                       double groove_edge, Flange kind) {
  const double r1 = circumradius(rims.groove_edge1), r2 = circumradius(rims.groove_edge2);
  if (kind == Flange::round)
    return {circumradius(rims.lower) - r1, circumradius(rims.middle) - std::max(r1, r2), circumradius(rims.upper) - r2};
  // The program draws the middle flange around the smooth maximum of both support functions, as around_both() in
  // solid/body.cpp does. Its margin is what the rim has beyond that, in the direction of the first normal.
  const Vec2& n = p1.points[0].normal;
  const double h1 = p1.points[0].position.dot(n), h2 = p2.points[0].position.dot(n);
  const double blend = 0.5;  // as in pulley.scad and solid/body.cpp, mm
  const double around =
      std::max(h1, h2) + blend * elementary::log1p(elementary::exp(-std::abs(h1 - h2) / blend)) + groove_edge;
  return {0, rims.middle[0].dot(n) - around, 0};
}

/// Features of shaft and screw that the part lacks become fixed numbers instead of parameters.
std::string parameters(const Product& product) {
  const Mechanism& mechanism = product.joint.mechanism;
  const Body& body = mechanism.body;
  const solid::BodyLayout& layout = product.pulley.layout;
  std::string text = fmt::format(
      R"(// {} - a compound pulley for two tendons, in mm.
// Made by fusee. Bottom to top: flange, groove P1, middle flange, groove P2, flange, hub. The axis is z, the joint lies
// towards +y. Change the numbers here or in the Customizer; the groove floors (P1, P2 below) make the joint follow its
// law and stay as they are. The engraved letters and marks of the printed part are omitted.

/* [View] */
// the part as it is in use, or the parts to print, in print orientation
show = "assembled"; // [assembled, print{}]

/* [Bore] */
)",
      cleaned_line(mechanism.name), layout.parts == Parts::two ? ", P1, P2" : "");
  text += bore_and_hub(product);
  text += "\n/* [Groove] */\n";
  text += slider_text(
      {"groove_depth", "height of the groove edge above the groove's floor", layout.groove_depth, 0.5, 0.1, 20});
  text += slider_text({"groove_angle", "between the walls, degrees", degrees(body.groove_angle), 0, 1, 120});
  text += fmt::format("// cross-section of the groove's floor\ngroove_shape = \"{}\"; // [u, v, flat]\n",
                      name_of(body.groove));
  text += "\n/* [Flanges] */\n";
  text += slider_text({"flange_thickness", "of each of the three", layout.flange_thickness, 0.4, 0.1, 10});
  return text + tie_offs_and_printing(product);
}

std::string flange_numbers(const Product& product, const solid::FlangeRims& rims) {
  const Mechanism& mechanism = product.joint.mechanism;
  const Flange kind = mechanism.body.flange;
  const solid::BodyLayout& layout = product.pulley.layout;
  const double groove_edge = layout.groove_depth - 0.5 * mechanism.tendon.diameter;
  const RimMargins margins = rim_margins(rims, product.synthesis.p1, product.synthesis.p2, groove_edge, kind);
  // A ledge at 45°, as high as it is wide.
  const auto ledge = [](const Polygon& inner, const Polygon& outer) {
    return solid::cone_height(inner, outer, radians(45));
  };
  const double ceiling = std::max(layout.p2.below_width(), layout.p2.above_width());
  return fmt::format("flange_shape = \"{}\";  // follow: along the groove; round\n",
                     kind == Flange::follow ? "follow" : "round") +
         hidden("lower_margin", margins.lower, "how far the flanges project outside the groove edge") +
         hidden("middle_margin", margins.middle, "the middle one outside of both") +
         hidden("upper_margin", margins.upper, "the upper one") +
         hidden("lower_ledge", ledge(rims.groove_edge1, rims.lower), "their largest projection over it") +
         hidden("middle_ledge", ledge(rims.groove_edge1, rims.middle), "the middle one over P1's") +
         hidden("upper_ledge", ledge(rims.groove_edge2, rims.upper), "the upper one over P2's") +
         hidden("entry_rise", solid::entry_rise(layout) + ceiling - 0.5 * layout.channel_width,
                "of a channel's ceiling, up to the groove edge") +
         hidden("min_wall", layout.min_wall, "no wall is thinner");
}

std::string dowel_numbers(const solid::BodyLayout& layout) {
  const solid::DowelLayout& dowels = layout.dowels;
  return fmt::format("dowels = {};  // pins that locate P1 and P2 on each other\n", points_text(dowels.places)) +
         hidden("dowel_pin", dowels.pin_diameter, "diameter") +
         hidden("dowel_end", dowels.places.empty() ? 0 : dowels.z_end - layout.z_p2,
                "of its hole at most, above groove P2's middle");
}

std::string hidden_numbers(const Product& product, const solid::FlangeRims& rims) {
  const Mechanism& mechanism = product.joint.mechanism;
  const solid::BodyLayout& layout = product.pulley.layout;
  const double compensation = mechanism.material.hole_compensation;
  return "/* [Hidden] */\n" +
         hidden("parts", layout.parts == Parts::two ? 2 : 1, "number of printed parts: 2: P1 and P2 separately") +
         hidden("tendon", mechanism.tendon.diameter, "its diameter") +
         hidden("seat_ratio", mechanism.body.seat_ratio, "seat radius of a u groove per tendon diameter") +
         flange_numbers(product, rims) + bore_numbers(layout.bore, compensation) + screw_numbers(layout, compensation) +
         dowel_numbers(layout) +
         fmt::format("print_scale = {};  // a print shrinks by as much\n\n", fixed(layout.scale, 9));
}

/// `name = [row, row …];`, one row on each line.
std::string array_text(const char* name, const char* words, const std::vector<std::string>& rows) {
  return fmt::format("\n// {}\n{} = [{}{}];\n", words, name, rows.empty() ? "" : "\n  ", fmt::join(rows, ",\n  "));
}

int groove_of(const solid::Anchor& anchor) { return anchor.side == transmission::Side::left ? 1 : 2; }

/// Vector from the start of the channel's straight section to the end of its inner edge.
Vec2 straight_run(const Polygon& inner, const Vec2& pocket) {
  const Vec2 outward = (pocket - inner.back()).normalized();
  const auto first = std::find_if(inner.begin(), inner.end(), [&](const Vec2& point) {
    return std::abs((point - inner.back()).dot(outward)) < 1e-6;
  });
  return inner.back() - *first;
}

/// The entry's outline runs along the outer edge and back along the inner one.
std::string channel_text(const solid::Anchor& anchor) {
  const auto half = static_cast<std::ptrdiff_t>(anchor.entry.size() / 2);
  const Polygon outer(anchor.entry.begin(), anchor.entry.begin() + half);
  const Polygon inner(anchor.entry.rbegin(), anchor.entry.rbegin() + half);
  return fmt::format("[{}, {},\n   {},\n   {},\n   {}]", groove_of(anchor), point_text(anchor.pocket),
                     points_text(outer), points_text(inner), point_text(straight_run(inner, anchor.pocket)));
}

std::string face_hole_text(const solid::Anchor& anchor, const profile::Outline& outline) {
  const auto nearest =
      std::min_element(outline.points.begin(), outline.points.end(),
                       [&](const profile::OutlinePoint& a, const profile::OutlinePoint& b) {
                         return (a.position - anchor.exit).squaredNorm() < (b.position - anchor.exit).squaredNorm();
                       });
  return fmt::format("[{}, {}, {}, {}, {}, {}]", groove_of(anchor), point_text(anchor.seat->hole),
                     decimal(degrees(nearest->psi)), decimal(anchor.seat->radius), decimal(anchor.seat->depth),
                     decimal(anchor.seat->length));
}

std::string tail_slot_text(const solid::Anchor& anchor) {
  const solid::TailSlot& slot = *anchor.tail;
  return fmt::format("[{}, {}, {}, {}, {}]", groove_of(anchor), point_text(slot.from), point_text(slot.to),
                     decimal(slot.depth), decimal(slot.ceiling));
}

std::string clamp_pilot_text(const solid::Anchor& anchor, double compensation) {
  const solid::TailSlot& slot = *anchor.tail;
  return fmt::format("[{}, {}, {}, {}]", groove_of(anchor), point_text(slot.to),
                     decimal(slot.pilot_diameter - compensation), decimal(slot.pilot_depth));
}

std::string tie_off_arrays(const Product& product) {
  std::vector<std::string> channels, holes, slots, pilots;
  for (const solid::Anchor& anchor : product.pulley.anchors) {
    if (anchor.seat) {
      const bool left = anchor.side == transmission::Side::left;
      holes.push_back(face_hole_text(anchor, left ? product.synthesis.p1 : product.synthesis.p2));
    } else {
      channels.push_back(channel_text(anchor));
    }
    if (!anchor.tail) continue;
    slots.push_back(tail_slot_text(anchor));
    if (anchor.tail->pilot_diameter > 0)
      pilots.push_back(clamp_pilot_text(anchor, product.joint.mechanism.material.hole_compensation));
  }
  return "\n// Tie-offs of the tendons, each with its groove (1 or 2) first." +
         array_text(
             "channels",
             "middle of the knot pocket, outer edge, inner edge, both from the groove inwards, and their straight end",
             channels) +
         array_text("face_holes",
                    "slots to the face: the round end's middle, the way out, countersink's radius and depth, length",
                    holes) +
         array_text("tail_slots",
                    "slot for the tendon's tail in the face: from, to, depth, height of its peaked ceiling", slots) +
         array_text("clamp_pilots", "hole of the tail's screw: place, diameter, depth below the face", pilots) + "\n";
}

std::string floor_arrays(const Product& product, const solid::FlangeRims& rims) {
  const profile::SynthesisResult& synthesis = product.synthesis;
  const double tendon_diameter = product.joint.mechanism.tendon.diameter;
  const std::vector<std::size_t> kept = kept_points(synthesis.p1, synthesis.p2, rims);
  return "// The groove floors: x, y, and direction of the outward normal, degrees. Point i of both has the same "
         "normal.\n" +
         floor_array("P1", synthesis.p1, tendon_diameter, kept) +
         floor_array("P2", synthesis.p2, tendon_diameter, kept);
}

}  // namespace

std::string scad_text(const Product& product) {
  if (product.helix) return helix_scad(product);
  const Mechanism& mechanism = product.joint.mechanism;
  const solid::FlangeRims rims =
      solid::flange_rims(product.synthesis.p1, product.synthesis.p2, mechanism.tendon.diameter,
                         product.pulley.layout.groove_depth, mechanism.body.flange);
  return parameters(product) + hidden_numbers(product, rims) + floor_arrays(product, rims) + tie_off_arrays(product) +
         program_for("one turn");
}

}  // namespace fusee::formats
