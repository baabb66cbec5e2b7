#include "export/report/tables.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "export/report/calibration_words.h"
#include "export/report/svg.h"
#include "fusee/base.h"

namespace fusee::formats {
namespace {

/// '#' stands for 1 or 2, '@' for the pin of the same side, B or D. A name may end with one of these; the words may
/// contain both.
struct PlainName {
  std::string_view name;
  std::string_view words;
};

constexpr PlainName k_plain_names[] = {
    // profile: conditions of feasibility
    {"moment_arms", "No dead centre: both tendons have a moment arm about O"},
    {"law_grows_P#", "θ grows with α, as P# sees it"},
    {"radius_P#", "P#’s groove floor stays clear of the axis"},
    {"line_reaches_pin_@", "Pin @ lies beyond the tendon’s reach on P#"},
    {"line_reaches_mouth_#", "Sheath #’s exit lies beyond the tendon’s reach on P#"},
    {"tendon_on_pin_@", "Tendon # stays on pin @ (wrap angle)"},
    {"take_off_advances_P#", "The take-off point never turns back on P#"},
    {"convex_floor_P#", "P#’s groove floor is convex (its smallest radius)"},
    {"free_span_#", "Tendon # has a free span between P# and its pin"},
    {"one_turn_P#", "P# fits into one turn (space for anchors and closing arc)"},
    {"turns_P#", "Turns that the range winds on P#"},
    {"on_drum_all_the_way", "No tendon leaves the joint’s drum within the range"},
    {"sloped_paths_close", "The tendons keep their length along their sloped paths"},
    {"spare_turns_P#", "P#’s spare turns are convex (smallest radius of the floor)"},
    {"neighbouring_turns_P#", "Lead of P#: space for groove, rib and step from turn to turn"},
    {"fleet_angle_#", "Tendon #’s fleet angle, below that at which it touches the groove edge"},
    {"closing_arc_P#", "P#’s closing arc has space to turn"},
    // solid: conditions of the body
    {"groove_depth", "Depth of the grooves"},
    {"flange_thickness", "Thickness of the flanges"},
    {"elephant_foot", "Chamfer at the bed"},
    {"bore_wall_P#", "Wall between the bore and P#’s groove floor"},
    {"hub_wall", "Wall between the bore and the hub’s side"},
    {"hub_on_flange", "Radius of the hub, on the upper flange"},
    {"anchor_P#", "Space for the anchors of P#"},
    {"channel_width", "Width of the tie-off channels"},
    {"channel_height", "Material above the tie-off channels"},
    {"channel_floor", "Material below the tie-off channels"},
    {"set_screw", "Space for the set screw"},
    {"set_screw_wall", "Wall around the set screw’s nut"},
    {"set_screw_height", "Height for the set screw in the hub"},
    {"room", "Diameter of the part"},
    {"pin_clear_@", "Gap between the flanges and pin @"},
    {"mouth_clear_#", "Gap between the flanges and the exit of sheath #"},
    {"horn_recess", "Depth of the horn’s recess"},
    {"horn_holes", "Web between the horn’s holes"},
    // solid, export, pipeline: checks
    {"facets", "Facets"},
    {"indices_out_of_range", "Facets that refer to a missing vertex"},
    {"vertices_not_finite", "Vertices that are not finite numbers"},
    {"self_intersections", "Self-intersections"},
    {"euler_number", "Euler number (as many through holes as planned)"},
    {"volume_deviation", "Volume against the exact one, relative"},
    {"floor_deviation_P#", "P#’s groove floor against the exact curve"},
    {"wall_P#", "Thinnest wall in the plane of P#’s groove"},
    {"groove_depth_P#", "Depth of P#’s groove"},
    {"groove_width_P#", "Width of P#’s groove"},
    {"triangles", "As many triangles as in pulley.stl"},
    {"deviation", "Distance to pulley.stl"},
    {"undrawn_entities", "Entities that draw no curve"},
    {"contours_closed", "Contours left open"},
    {"ends_meet", "Gap between ends that should meet"},
    {"no_duplicate_lines", "Duplicate lines"},
    {"no_self_crossing", "Contours that cross themselves"},
    {"no_crossing_contours", "Contours that cross each other"},
    {"nothing_outside", "Contours outside the part or the sheet"},
    // pipeline: results of the tendons wound on the mesh
    {"theta_error", "Joint angle as built against the declared θ(α)"},
    {"excess_length", "Excess length or stretch of tendon 2 as built"},
    {"theta_error_reported", "Joint angle as built against the declared θ(α) (method “paper”: reported only)"},
    {"excess_length_reported", "Excess length or stretch of tendon 2 as built (method “paper”: reported only)"},
};

/// Beginnings of the names of checks of one file, and that file.
constexpr PlainName k_prefixes[] = {{"obj_", "pulley.obj"},
                                    {"3mf_", "pulley.3mf"},
                                    {"drc_", "pulley.drc"},
                                    {"profile_dxf_", "profile.dxf"},
                                    {"plates_dxf_", "plates.dxf"}};

/// "2" for "convex_floor_P2" and "tendon_on_pin_D" if they match `pattern`; ' ' without a wildcard; 0 if they do not
/// match.
char matched_side(std::string_view name, std::string_view pattern) {
  if (name == pattern) return ' ';
  if (name.size() != pattern.size() || name.substr(0, name.size() - 1) != pattern.substr(0, pattern.size() - 1))
    return 0;
  const std::string_view allowed = pattern.back() == '#' ? "12" : pattern.back() == '@' ? "BD" : "";
  const std::size_t found = allowed.find(name.back());
  return found == std::string_view::npos ? '\0' : "12"[found];
}

/// Index in k_prefixes of the file that a check is about; the size of k_prefixes if it is about none.
std::size_t file_index(std::string_view name) {
  const auto found = std::find_if(std::begin(k_prefixes), std::end(k_prefixes),
                                  [&](const PlainName& file) { return name.substr(0, file.name.size()) == file.name; });
  return static_cast<std::size_t>(found - std::begin(k_prefixes));
}

std::string_view without_file(std::string_view name) { return name.substr(k_prefixes[file_index(name)].name.size()); }

std::string with_side(std::string_view words, char side) {
  std::string text;
  for (const char c : words) text += c == '#' ? side : c == '@' ? (side == '1' ? 'B' : 'D') : c;
  return text;
}

std::string cell(std::string_view classes, const std::string& html) {
  return (classes.empty() ? std::string("<td>") : "<td class=\"" + std::string(classes) + "\">") + html + "</td>";
}

/// The relation to the limit that is required of the value. A Check and a Condition do not store it, but its value,
/// limit and outcome imply it.
std::string_view relation(double value, double limit, bool ok, std::string_view unit) {
  if (value == limit || !std::isfinite(value)) return "";
  if (!ok && unit == "1") return "";
  return (value < limit) == ok ? "≤ " : "≥ ";
}

std::string limit_words(double value, double limit, bool ok, std::string_view unit) {
  return std::string(relation(value, limit, ok, unit)) + safe_text(with_unit(limit, unit));
}

std::string name_cell(const std::string& words, const std::string& remark) {
  std::string html = safe_text(words);
  if (!remark.empty()) html += " <span class=\"where\">" + safe_text(remark) + "</span>";
  return cell("", html);
}

/// Checks under one heading, with readable names.
struct CheckGroup {
  std::string title;
  std::vector<Check> checks;
};

std::string row_start(bool ok) {
  return ok ? "<tr><td class=\"state\">✓</td>" : "<tr class=\"failed\"><td class=\"state\">✕</td>";
}

std::string group_table(const CheckGroup& group) {
  std::string html = "<div><h3>" + safe_text(group.title) +
                     "</h3><div class=\"scroll\"><table><thead><tr><th></th><th></th>"
                     "<th class=\"number\">Value</th><th class=\"number\">Limit</th></tr></thead><tbody>";
  for (const Check& check : group.checks) {
    html += row_start(check.ok) + name_cell(check.name, check.ok ? "" : check.where) +
            cell("number", safe_text(with_unit(check.value, check.unit))) +
            cell("number", limit_words(check.value, check.limit, check.ok, check.unit)) + "</tr>";
  }
  return html + "</tbody></table></div></div>";
}

}  // namespace

std::string plain_name(std::string_view name) {
  if (const std::size_t file = file_index(name); file < std::size(k_prefixes)) {
    return std::string(k_prefixes[file].words) + ": " + plain_name(without_file(name));
  }
  // Checks of a pulley that is printed as two parts.
  for (const std::string_view part : {"P1", "P2"}) {
    const std::string prefix = part == "P1" ? "p1_" : "p2_";
    if (name.starts_with(prefix)) return std::string(part) + ": " + plain_name(name.substr(prefix.size()));
  }
  for (const PlainName& known : k_plain_names) {
    if (const char side = matched_side(name, known.name)) return with_side(known.words, side);
  }
  return first_upper(open_words(std::string(name)));
}

std::string shown_unit(std::string_view unit) {
  if (unit == "deg") return "°";
  if (unit == "deg/deg") return "°/°";
  if (unit == "1") return "";
  return std::string(unit);
}

std::string with_unit(double value, std::string_view unit, int digits) {
  const std::string shown = shown_unit(unit);
  return readable_rounded(value, digits) + (shown.empty() || shown == "°" ? "" : "\u00a0") + shown;
}

std::string checks_tables(const std::vector<Check>& checks) {
  // In this order, then one group for each file.
  enum : std::size_t { k_failed, k_as_built, k_part, k_first_file };
  std::vector<CheckGroup> groups{{"Failed", {}}, {"As built", {}}, {"The part, in pulley.stl", {}}};
  for (const PlainName& file : k_prefixes) groups.push_back({std::string(file.words), {}});
  for (const Check& check : checks) {
    const std::size_t file = file_index(check.name);
    const bool has_file = file < std::size(k_prefixes);
    Check named = check;
    // The heading names the file, except in the group of failed checks.
    named.name = plain_name(check.ok && has_file ? without_file(check.name) : check.name);
    const bool is_as_built = check.name.rfind("theta_error", 0) == 0 || check.name.rfind("excess_length", 0) == 0;
    std::size_t group = k_part;
    if (!check.ok)
      group = k_failed;
    else if (is_as_built)
      group = k_as_built;
    else if (has_file)
      group = k_first_file + file;
    groups[group].checks.push_back(named);
  }
  std::string html = "<div class=\"groups\">";
  for (const CheckGroup& group : groups) {
    if (!group.checks.empty()) html += group_table(group);
  }
  html += "</div>";
  if (!groups.front().checks.empty()) return html;
  return "<details><summary>" + std::to_string(checks.size()) + " of " + std::to_string(checks.size()) +
         " passed</summary>" + html + "</details>";
}

std::string conditions_table(const std::vector<profile::Condition>& conditions, bool over_stroke) {
  std::string html = "<div class=\"scroll\"><table><thead><tr><th></th><th>Condition</th>";
  if (over_stroke) html += "<th class=\"number\">Tightest at α</th>";
  html +=
      "<th class=\"number\">Value</th><th class=\"number\">Limit</th><th "
      "class=\"number\">Margin</th></tr></thead><tbody>";
  for (const profile::Condition& condition : conditions) {
    // Some conditions have no numbers: there either is a dead centre or not.
    const bool has_no_numbers = condition.value == condition.limit;
    const double distance = std::abs(condition.value - condition.limit);
    html += row_start(condition.ok) + name_cell(plain_name(condition.name), condition.ok ? "" : condition.message);
    if (over_stroke)
      html += cell("number", has_no_numbers && condition.ok ? "" : readable(degrees(condition.alpha), 1) + "°");
    html += cell("number", has_no_numbers ? "" : safe_text(with_unit(condition.value, condition.unit, 4))) +
            cell("number",
                 has_no_numbers ? "" : limit_words(condition.value, condition.limit, condition.ok, condition.unit)) +
            cell("number",
                 has_no_numbers ? "" : safe_text(with_unit(condition.ok ? distance : -distance, condition.unit))) +
            "</tr>";
  }
  return html + "</tbody></table></div>";
}

}  // namespace fusee::formats
