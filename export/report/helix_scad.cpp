// The rows of both grooves on one fan of directions, coarser than the mesh of src/helical_solid. The OpenSCAD program
// joins them.
#include "export/report/helix_scad.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "export/report/scad_words.h"
#include "fusee/base.h"
#include "helical_solid/helical_plan.h"
#include "helical_solid/winding.h"

namespace fusee::formats {

using namespace scad;

namespace {

// OpenSCAD's exact arithmetic takes about a millisecond per point, so there are fewer rows than in the mesh.
constexpr double k_helical_sagitta = 0.02;  // mm

/// The anchor at the lower face (P1) or the upper face (P2).
const helical_solid::HelicalAnchor& anchor_of(const Product& product, transmission::Side side) {
  const std::vector<helical_solid::HelicalAnchor>& all = product.helix->pulley.anchors;
  return *std::find_if(all.begin(), all.end(),
                       [side](const helical_solid::HelicalAnchor& anchor) { return anchor.side == side; });
}

helical_solid::Fan coarse_fan(const Product& product) {
  const HelixProduct& helix = *product.helix;
  const solid::BodyLayout& layout = product.pulley.layout;
  const double tendon_radius = 0.5 * layout.tendon_diameter;
  // Length of the groove beyond its end that stays filled, for the channel and its pocket.
  double filled = 0;
  for (const helical_solid::HelicalAnchor& anchor : helix.pulley.anchors)
    filled = std::max(filled, anchor.bend_radius + 2.0 * anchor.pocket_radius + layout.min_wall);
  return helical_solid::make_fan(helical_solid::SpiralCurve(helix.synthesis.sides[0].spiral, helix.pulley.p1),
                                 helical_solid::SpiralCurve(helix.synthesis.sides[1].spiral, helix.pulley.p2),
                                 layout.groove_depth - tendon_radius, tendon_radius, k_helical_sagitta, filled);
}

std::string run_out_array(const Product& product) {
  std::string text =
      "// The run-out of each groove's end: bend radius, middle of the knot pocket, its depth.\nrun_outs = [";
  for (const transmission::Side side : {transmission::Side::left, transmission::Side::right}) {
    const helical_solid::HelicalAnchor& anchor = anchor_of(product, side);
    text += fmt::format("{}[{}, {}, {}]", side == transmission::Side::left ? "" : ", ", decimal(anchor.bend_radius),
                        point_text(anchor.pocket.head<2>()), decimal(anchor.pocket_depth));
  }
  return text + "];\n\n";
}

std::string rows_array(const char* name, const helical_solid::Winding& winding, double tendon_radius) {
  std::string text = fmt::format("{} = [", name);
  for (std::size_t j = 0; j < winding.rows.size(); ++j) {
    const helical_solid::WindingRow& row = winding.rows[j];
    const Vec2 floor = row.position - tendon_radius * row.normal;
    text += (j == 0       ? "\n  "
             : j % 3 == 0 ? ",\n  "
                          : ", ") +
            fmt::format("[{}, {}, {}, {}]", decimal(floor.x()), decimal(floor.y()), decimal(degrees(row.turn)),
                        decimal(row.height));
  }
  return text + "];\n";
}

std::string groove_edges_text(const char* name, const helical_solid::Winding& winding) {
  return fmt::format("{} = [{}, {}];", name, decimal(winding.bulge_low), decimal(winding.bulge_high));
}

/// `fan`: the coarse rows to write. `part_fan`: that of the written part, which has the projections of its groove edges.
std::string spiral_arrays(const helical_solid::Fan& fan, const helical_solid::Fan& part_fan, double tendon_radius) {
  return "// The groove floors from end to end: x, y, direction of the outward normal, degrees, and the height "
         "of the tendon's\n// centre line there. A turn has as many rows as the fan has columns.\n" +
         fmt::format("columns = {};\n", fan.columns()) +
         fmt::format("first_column1 = {};  // of P1's first row\nfirst_column2 = {};  // of P2's\n",
                     fan.p1.first_column, fan.p2.first_column) +
         fmt::format("filled1 = {};  // rows past P1's last end, with no groove\nfilled2 = {};  // before P2's first\n",
                     fan.p1.filled_back, fan.p2.filled_front) +
         groove_edges_text("edge_bulges1", part_fan.p1) +
         "  // initial projection of these rows' lower and upper groove edges\n" +
         groove_edges_text("edge_bulges2", part_fan.p2) + "\n" + rows_array("P1", fan.p1, tendon_radius) +
         rows_array("P2", fan.p2, tendon_radius) + "\n";
}

/// The groove's dimensions can only be reduced, because the ribs between its turns must remain.
std::string helical_parameters(const Product& product) {
  const Mechanism& mechanism = product.joint.mechanism;
  const solid::BodyLayout& layout = product.pulley.layout;
  return fmt::format(
             R"(// {} - a compound pulley for two tendons that are wound several times, in mm.
// Made by fusee. Bottom to top: flange, helical groove P1, middle flange, helical groove P2, flange, hub. The axis is
// z, the joint lies towards +y. Change the numbers here or in the Customizer; the groove floors (P1, P2 below) make the
// joint follow its law and stay as they are.

/* [Bore] */
)",
             cleaned_line(mechanism.name)) +
         bore_and_hub(product) + "\n/* [Groove] */\n" +
         slider_text({"groove_depth",
                      "height of the groove edge above the groove's floor: no deeper, for the ribs between the turns",
                      layout.groove_depth, 0.5, 0.1, layout.groove_depth}) +
         slider_text({"groove_angle", "between the walls, degrees: no wider", degrees(mechanism.body.groove_angle), 0,
                      1, degrees(mechanism.body.groove_angle)}) +
         tie_offs_and_printing(product);
}

std::string helical_numbers(const Product& product) {
  const Mechanism& mechanism = product.joint.mechanism;
  const solid::BodyLayout& layout = product.pulley.layout;
  const double compensation = mechanism.material.hole_compensation;
  return "/* [Hidden] */\n" + hidden("tendon", mechanism.tendon.diameter, "its diameter") +
         fmt::format("groove_shape = \"{}\";\n", name_of(mechanism.body.groove)) +
         hidden("seat_ratio", mechanism.body.seat_ratio, "seat radius of a u groove per tendon diameter") +
         hidden("flange_thickness", layout.flange_thickness, "of the lower and the upper one") +
         hidden("min_wall", layout.min_wall, "no wall is thinner") +
         hidden("z_middle", layout.z_middle, "lower edge of the middle flange") +
         hidden("z_mate", layout.z_mate, "its upper edge") + hidden("z_top", layout.z_top, "of the upper flange") +
         bore_numbers(layout.bore, compensation) + screw_numbers(layout, compensation) +
         fmt::format("print_scale = {:.9f};  // a print shrinks by as much\n\n", layout.scale);
}

}  // namespace

std::string helix_scad(const Product& product) {
  return helical_parameters(product) + helical_numbers(product) +
         spiral_arrays(coarse_fan(product), product.helix->pulley.plan->fan,
                       0.5 * product.joint.mechanism.tendon.diameter) +
         run_out_array(product) + program_for("several turns");
}

}  // namespace fusee::formats
