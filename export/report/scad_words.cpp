#include "export/report/scad_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/text.h"
#include "export/report/report_parts.h"
#include "fusee/base.h"
#include "solid/bore.h"

namespace fusee::formats::scad {
namespace {

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
double shaft_diameter(const solid::BoreLayout& bore, double compensation) {
  const double radius =
      bore.arc_points > 0 ? bore.outline.front().norm() : distance_to_edges(bore.outline, Vec2::Zero());
  return 2 * radius - compensation;
}

std::string tick_box(const char* name, const char* words, bool value) {
  return fmt::format("// {}\n{} = {};\n", words, name, value);
}

/// The further parameters of a D bore or a keyway.
std::string flat_sliders(const solid::BoreLayout& bore, double compensation) {
  const double radius = 0.5 * shaft_diameter(bore, compensation);
  const double top = bore.outline.back().y() - 0.5 * compensation;  // y of the flat, or of the keyway's far side
  if (bore.kind == Bore::d)
    return slider_text({"bore_flat", "from the flat to the far side of the shaft", top + radius, 0.5, 0.1, 40});
  if (bore.kind != Bore::keyway) return "";
  const double width = 2 * std::abs(bore.outline.back().x()) - compensation;
  return slider_text({"key_width", "of the keyway", width, 0.5, 0.1, 20}) +
         slider_text({"key_depth", "of the keyway, from the shaft's edge", top - radius, 0, 0.1, 10});
}

std::string directions_text(const Polygon& points) {
  std::vector<std::string> angles;
  for (const Vec2& point : points) angles.push_back(decimal(degrees(elementary::atan2(point.y(), point.x()))));
  return fmt::format("{}", fmt::join(angles, ", "));
}

}  // namespace

std::string decimal(double value) { return trimmed_fixed(value, 5); }

std::string point_text(const Vec2& p) { return "[" + decimal(p.x()) + ", " + decimal(p.y()) + "]"; }

std::string points_text(const Polygon& points) {
  std::string text = "[";
  for (std::size_t i = 0; i < points.size(); ++i)
    text += (i == 0 ? "" : i % 8 == 0 ? ",\n    " : ", ") + point_text(points[i]);
  return text + "]";
}

const char* name_of(Groove groove) { return groove == Groove::u ? "u" : groove == Groove::v ? "v" : "flat"; }

// A slider snaps its number to its steps, so the steps are fine enough to contain the part's own number. 0.001 mm is
// finer than any manufacture.
std::string slider_text(const Slider& slider) {
  const double value = std::round(slider.value * 1000) / 1000;
  const auto is_between_steps = [&](double step) { return std::abs(std::remainder(value - slider.low, step)) > 1e-9; };
  double step = slider.step;
  for (const double finer : {0.01, 0.001}) {
    if (is_between_steps(step)) step = finer;
  }
  return fmt::format("// {}\n{} = {}; // [{}:{}:{}]\n", slider.words, slider.name, decimal(value),
                     decimal(std::min(slider.low, value)), decimal(step),
                     decimal(std::max(slider.high, std::ceil(value))));
}

std::string hidden(const char* name, double value, const char* words) {
  return fmt::format("{} = {};  // {}\n", name, decimal(value), words);
}

std::string bore_and_hub(const Product& product) {
  const Mechanism& mechanism = product.joint.mechanism;
  const solid::BodyLayout& layout = product.pulley.layout;
  const solid::SetScrewLayout& screw = layout.set_screw;
  std::string text;
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
  return text;
}

std::string tie_offs_and_printing(const Product& product) {
  const Mechanism& mechanism = product.joint.mechanism;
  const solid::BodyLayout& layout = product.pulley.layout;
  std::string text;
  text += "\n/* [Tie-offs] */\n";
  text +=
      slider_text({"channel_width", "of the tendons' channels, holes and slots", layout.channel_width, 0.3, 0.05, 5});
  text += slider_text({"knot_pocket", "diameter, 0: none", 2 * layout.pocket_radius, 0, 0.1, 20});
  text += "// corners of round things\nfacets = 24; // [12:4:96]\n";
  text += "\n/* [Printing] */\n";
  text += tick_box("supports", "the printer makes supports, so downward faces may be flat", mechanism.print.supports);
  text += slider_text({"overhang_deg", "least slope of a downward face above the horizontal",
                       degrees(mechanism.print.overhang), 20, 1, 75});
  text += slider_text({"elephant_foot", "chamfer at the print bed", layout.elephant_foot, 0, 0.05, 2}) + "\n";
  return text;
}

std::string screw_numbers(const solid::BodyLayout& layout, double compensation) {
  const solid::SetScrewLayout& screw = layout.set_screw;
  const double bore_edge = 0.5 * (shaft_diameter(layout.bore, compensation) + compensation);
  const double nut_from_bore = screw.nut_trap ? screw.nut_distance - bore_edge : 0;
  constexpr double k_most_hub_wall = 1.5;  // mm; a hub with a thicker wall grows only if less would remain
  const double hub_wall =
      layout.hub_radius > 0
          ? std::clamp(layout.hub_radius - bore_edge - nut_from_bore - 0.5 * screw.nut_thickness, 0.0, k_most_hub_wall)
          : layout.min_wall;
  return (screw.present ? "" : "set_screw = false;\n") + std::string(screw.nut_trap ? "" : "nut_trap = false;\n") +
         hidden("screw_hole", screw.hole_diameter, "diameter") +
         hidden("screw_angle", degrees(screw.angle), "direction, degrees") +
         hidden("nut_width", screw.nut_width, "across flats") +
         hidden("nut_thickness", screw.nut_thickness, "along the screw") +
         hidden("nut_from_bore", nut_from_bore, "from the bore's edge to the middle of the nut") +
         hidden("hub_wall", hub_wall, "the hub grows with the bore so that this is left outside of it and of the nut");
}

std::string bore_numbers(const solid::BoreLayout& bore, double compensation) {
  std::string text;
  if (bore.kind == Bore::horn) text += hidden("bore", shaft_diameter(bore, compensation), "of the horn");
  const Polygon rim = bore.horn_recess > 0 ? solid::recess_cone(bore).rim : bore.outline;
  text += fmt::format("bore_shape = \"{}\";\n", name_of(bore.kind));
  text += hidden("horn_recess", bore.horn_recess, "depth of a servo horn's pocket; 0: the bore goes through");
  text += fmt::format("horn_rays = [{}];  // degrees: where the pocket's cone has corners\n",
                      bore.horn_recess > 0 ? directions_text(rim) : "");
  text += fmt::format("horn_teeth = {};  // outline around a servo's toothed shaft\n",
                      bore.spline_teeth > 0 ? points_text(rim) : "[]");
  std::vector<std::string> holes;
  for (const Polygon& outline : bore.screw_holes) {
    const solid::RoundHole hole = solid::circle_within(outline);
    holes.push_back(fmt::format("[{}, {}, {}]", decimal(hole.centre.x()), decimal(hole.centre.y()),
                                decimal(hole.diameter - compensation)));
  }
  return text + fmt::format("horn_holes = [{}];  // of its screws: x, y, diameter\n", fmt::join(holes, ", "));
}

// A line that begins with the mark states which turns the following lines are for. Lines before the first are for both.
std::string program_for(std::string_view turns) {
  constexpr std::string_view k_mark = "//= ";
  std::string program;
  std::string_view rest = embedded::pulley_scad;
  bool is_for_turns = true;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('\n'), rest.size() - 1) + 1;
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(end);
    if (line.starts_with(k_mark)) {
      const std::string_view section_turns = line.substr(k_mark.size(), line.size() - k_mark.size() - 1);
      is_for_turns = section_turns == "both" || section_turns == turns;
    } else if (is_for_turns) {
      program += line;
    }
  }
  return program;
}

}  // namespace fusee::formats::scad
