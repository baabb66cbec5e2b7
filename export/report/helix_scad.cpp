// The rows of both grooves on one fan of directions, as src/coil lays them for the mesh, coarser; the program joins
// them.
#include "export/report/helix_scad.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "coil/run_out.h"
#include "coil/winding.h"
#include "export/report/scad_words.h"
#include "fusee/base/units.h"

namespace fusee {

using namespace scad;

namespace {

// OpenSCAD's exact arithmetic takes about a millisecond a point: fewer rows than the mesh has.
constexpr double k_climbing_sagitta = 0.02;

Fan coarse_fan(const Product& product) {
  const HelixProduct& helix = *product.helix;
  const BodyLayout& layout = product.pulley.layout;
  const RunOutSizes sizes = run_out_sizes(product.joint.mechanism, layout);
  const double half = 0.5 * layout.tendon_diameter;
  return make_fan(SpiralCurve(helix.synthesis.sides[0].spiral, helix.pulley.p1),
                  SpiralCurve(helix.synthesis.sides[1].spiral, helix.pulley.p2), layout.groove_depth - half, half,
                  k_climbing_sagitta, filled_length(sizes, layout));
}

std::string rows_array(const char* name, const Winding& winding, double half) {
  std::string text = fmt::format("{} = [", name);
  for (std::size_t j = 0; j < winding.rows.size(); ++j) {
    const WindingRow& row = winding.rows[j];
    const Vec2 floor = row.position - half * row.normal;
    text += (j == 0       ? "\n  "
             : j % 3 == 0 ? ",\n  "
                          : ", ") +
            fmt::format("[{}, {}, {}, {}]", decimal(floor.x()), decimal(floor.y()), decimal(degrees(row.turn)),
                        decimal(row.height));
  }
  return text + "];\n";
}

std::string spiral_arrays(const Fan& fan, double half) {
  return "// The groove floors from end to end: x, y, the direction in which the floor looks, degrees, and the height "
         "of "
         "the tendon's\n// centre line there. A turn has as many rows as the fan has columns.\n" +
         fmt::format("columns = {};\n", fan.columns()) +
         fmt::format("first_column1 = {};  // of P1's first row\nfirst_column2 = {};  // of P2's\n",
                     fan.p1.first_column, fan.p2.first_column) +
         fmt::format("filled1 = {};  // rows past P1's last end, with no groove\nfilled2 = {};  // before P2's first\n",
                     fan.p1.filled_back, fan.p2.filled_front) +
         rows_array("P1", fan.p1, half) + rows_array("P2", fan.p2, half) + "\n";
}

/// What a groove is like has to leave the ribs between its turns: it can only be made smaller.
std::string climbing_parameters(const Product& product) {
  const Mechanism& mechanism = product.joint.mechanism;
  const BodyLayout& layout = product.pulley.layout;
  return fmt::format(
             R"(// {} - a compound pulley for two tendons that are wound several times, in mm.
// Made by fusee. Bottom to top: flange, helical groove P1, middle flange, helical groove P2, flange, hub. The axis is z, the joint
// lies towards +y. Change the numbers here or in the Customizer; the groove floors (P1, P2 below) make the joint follow its law
// and stay as they are.

/* [Bore] */
)",
             on_one_line(mechanism.name)) +
         bore_and_hub(product) + "\n/* [Groove] */\n" +
         slider_text({"groove_depth", "lip above the groove's floor: no deeper, for the ribs between the turns",
                      layout.groove_depth, 0.5, 0.1, layout.groove_depth}) +
         slider_text({"groove_angle", "between the walls, degrees: no wider", degrees(mechanism.body.groove_angle), 0,
                      1, degrees(mechanism.body.groove_angle)}) +
         tie_offs_and_printing(product);
}

std::string climbing_numbers(const Product& product) {
  const Mechanism& mechanism = product.joint.mechanism;
  const BodyLayout& layout = product.pulley.layout;
  const RunOutSizes sizes = run_out_sizes(mechanism, layout);
  const double compensation = mechanism.material.hole_compensation;
  return "/* [Hidden] */\n" + hidden("tendon", mechanism.tendon.diameter, "its diameter") +
         fmt::format("groove_shape = \"{}\";\n", name_of(mechanism.body.groove)) +
         hidden("seat_ratio", mechanism.body.seat_ratio, "seat radius of a u groove per tendon diameter") +
         hidden("flange_thickness", layout.flange_thickness, "of the lower and the upper one") +
         hidden("min_wall", layout.min_wall, "no wall is thinner") +
         hidden("z_middle", layout.z_middle, "lower edge of the middle flange") +
         hidden("z_mate", layout.z_mate, "its upper edge") + hidden("z_top", layout.z_top, "of the upper flange") +
         hidden("mouth_radius", sizes.mouth_radius, "of a channel where it leaves the groove") +
         hidden("mouth_outward", sizes.mouth_outward, "of its middle, from the tendon's") +
         hidden("bend_radius", sizes.bend_radius, "of a tendon on its way to the knot") +
         bore_numbers(layout.bore, compensation) + screw_numbers(layout, compensation) +
         fmt::format("print_scale = {:.9f};  // a print shrinks by as much\n\n", layout.scale);
}

}  // namespace

std::string helix_scad(const Product& product) {
  return climbing_parameters(product) + climbing_numbers(product) +
         spiral_arrays(coarse_fan(product), 0.5 * product.joint.mechanism.tendon.diameter) +
         program_for("several turns");
}

}  // namespace fusee
