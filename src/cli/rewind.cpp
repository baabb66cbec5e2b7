#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/text.h"
#include "cli/as_built.h"
#include "cli/command.h"
#include "cli/table.h"
#include "fusee/pipeline.h"

namespace fusee::cli {
namespace {

/// Rows of the terminal table; --json and --verbose have all points.
constexpr std::size_t k_points_in_table = 13;

std::string points_table(const std::vector<profile::RewindPoint>& points, bool all) {
  const std::size_t rows = all ? points.size() : std::min(points.size(), k_points_in_table);
  std::vector<std::vector<std::string>> cells;
  for (std::size_t row = 0; row < rows; ++row) {
    const profile::RewindPoint& point = points[rows < 2 ? 0 : row * (points.size() - 1) / (rows - 1)];
    cells.push_back({fixed(degrees(point.alpha), 2), fixed(degrees(point.theta_declared), 3),
                     fixed(degrees(point.theta), 3), fixed(degrees(point.theta - point.theta_declared), 4),
                     fixed(point.excess, 4)});
  }
  return table({{"alpha_deg", Align::right},
                {"declared_deg", Align::right},
                {"theta_deg", Align::right},
                {"error_deg", Align::right},
                {"excess_mm", Align::right}},
               cells);
}

Json points_json(const std::vector<profile::RewindPoint>& points) {
  Json list = Json::array();
  for (const profile::RewindPoint& point : points) {
    list.push_back({{"alpha_deg", degrees(point.alpha)},
                    {"theta_declared_deg", degrees(point.theta_declared)},
                    {"theta_deg", degrees(point.theta)},
                    {"slack_mm", point.excess}});
  }
  return list;
}

// ---- placement ---------------------------------------------------------------------------------

std::string_view word(transmission::Side side) { return side == transmission::Side::left ? "P1" : "P2"; }

std::string grooves_text(const solid::Placement& placement) {
  std::string text;
  for (const solid::PlacedGroove& groove : placement.grooves)
    text += (text.empty() ? "" : ", ") + std::string(word(groove.side)) + " at z = " + fixed(groove.z, 3) + " mm";
  return text;
}

std::string turn_text(const solid::Placement& placement) {
  std::string text = placement.turned_over ? ", upside down" : "";
  // The angle of a round part is undetermined.
  if (placement.tells_turn) text += ", turned by " + trimmed_fixed(degrees(placement.turn), 3) + "° about it";
  return text;
}

/// Text such as "its axis at (12.3, -4) mm, turned by 90° about it; grooves P1 at z = …".
std::string placement_text(const solid::Placement& placement) {
  std::string text = "its axis at (" + trimmed_fixed(placement.axis.x(), 3) + ", " +
                     trimmed_fixed(placement.axis.y(), 3) + ") mm" + turn_text(placement) + "; " +
                     (placement.grooves.size() == 1 ? "groove " : "grooves ") + grooves_text(placement) +
                     "; floors within " + rounded(placement.deviation, 2) + " mm of the declared ones";
  if (placement.bore_off_axis > 0)
    text += "; the bore is " + rounded(placement.bore_off_axis, 2) +
            " mm off the grooves' axis, and the part turns about the bore";
  return text;
}

std::string place_text(const pipeline::RewoundPart& part) {
  std::string text;
  for (const solid::Placement& placement : part.placements)
    text += wrapped("found from its grooves: " + placement_text(placement), "  ", "  ");
  if (part.alone)
    text += wrapped("the file has only " + std::string(word(*part.alone)) + ": only tendon " +
                        (*part.alone == transmission::Side::left ? "1" : "2") +
                        " was wound, and the excess length is unknown",
                    "  ", "  ");
  return text;
}

void add_place_notes(const std::string& file, const pipeline::RewoundPart& part, Reply& reply) {
  const auto add = [&](Severity severity, const std::string& words, const std::string& hint) {
    Diagnostic diagnostic = about_file(severity, file, words);
    diagnostic.hint = hint;
    reply.diagnostics.push_back(diagnostic);
  };
  if (part.place == pipeline::PartPlace::found)
    add(Severity::note, "the part was moved after the build: its grooves were found elsewhere",
        "--as-is winds it in its present position");
  const auto may_be_mirrored = [](const solid::Placement& placement) {
    return placement.grooves.size() == 1 && placement.turned_over && placement.tells_turn;
  };
  if (std::any_of(part.placements.begin(), part.placements.end(), may_be_mirrored))
    add(Severity::warning,
        "a single groove upside down cannot be distinguished from a mirrored one: upside down is assumed",
        "check that the file is not mirrored");
  if (part.scale != 1)
    add(Severity::warning,
        "the part is " + rounded(100 * std::abs(part.scale - 1), 2) + " % " + (part.scale > 1 ? "larger" : "smaller") +
            " than the mechanism file's pulley",
        "scale the mesh by " + rounded(1 / part.scale, 4) + "; a slicer may have scaled it against shrinkage");
  if (part.place == pipeline::PartPlace::not_recognised)
    add(Severity::warning,
        "the grooves of this part do not fit those of the mechanism anywhere: it is wound in its present position",
        "check that it is the pulley of this mechanism file, with its axis along z");
}

Json placements_json(const pipeline::RewoundPart& part) {
  Json list = Json::array();
  for (const solid::Placement& placement : part.placements) {
    Json grooves = Json::array();
    for (const solid::PlacedGroove& groove : placement.grooves)
      grooves.push_back({{"pulley", word(groove.side)}, {"z_mm", groove.z}});
    list.push_back({{"axis_mm", {placement.axis.x(), placement.axis.y()}},
                    {"turned_deg", degrees(placement.turn)},
                    {"tells_turn", placement.tells_turn},
                    {"turned_over", placement.turned_over},
                    {"deviation_mm", placement.deviation},
                    {"bore_off_axis_mm", placement.bore_off_axis},
                    {"grooves", grooves}});
  }
  return list;
}

// ---- command -----------------------------------------------------------------------------------

/// Reads and rewinds a part; faults are reported with its file name.
pipeline::RewoundPart rewind_file(const joint::IdentifiedJoint& joint, const std::string& file, bool as_is,
                                  const RunContext& context) {
  context.begin_step("reading the part");
  const pipeline::Part part = pipeline::read_part(file, *context.files);
  context.begin_step("winding tendons on it");
  try {
    return as_is ? pipeline::RewoundPart{pipeline::rewind_part(joint, part), pipeline::PartPlace::as_made, {}}
                 : pipeline::rewind_moved_part(joint, part);
  } catch (const InputError& error) {
    std::vector<Diagnostic> diagnostics = error.diagnostics();
    for (Diagnostic& diagnostic : diagnostics) diagnostic.place.file = file;
    throw InputError(std::move(diagnostics));
  }
}

/// With only one tendon the excess length is unknown.
std::vector<Check> checks_of(const Mechanism& mechanism, const pipeline::RewoundPart& part,
                             const pipeline::AsBuiltLimits& limits) {
  std::vector<Check> checks = pipeline::as_built_checks(mechanism, part.as_built, limits);
  constexpr int k_theta_checks = 1;  // come first; the others are about the excess length
  if (part.alone) checks.erase(checks.begin() + k_theta_checks, checks.end());
  return checks;
}

std::string result_text(const pipeline::RewoundPart& part) {
  if (!part.alone) return as_built_text(part.as_built);
  return "theta within " + rounded(degrees(part.as_built.max_theta_error), 2) + " deg";
}

Reply run_rewind(const Arguments& arguments, Console& console, const RunContext& context) {
  const pipeline::AsBuiltLimits limits = limits_from(arguments);
  const MechanismFile spec = read_mechanism(arguments.positionals()[0], arguments.settings(), *context.files);
  pipeline::demand_tendons(spec, "wind");
  const std::string& file = arguments.positionals()[1];
  const joint::IdentifiedJoint joint = joint::identified_joint(spec.mechanism);
  const pipeline::RewoundPart part = rewind_file(joint, file, arguments.has("--as-is"), context);
  const std::vector<Check> checks = checks_of(joint.mechanism, part, limits);
  Reply reply;
  reply.diagnostics = spec.warnings;
  reply.units = spec.mechanism.units;
  add_place_notes(file, part, reply);
  reply.text = std::filesystem::path(file).filename().string() + ": " + result_text(part) + "\n" + place_text(part) +
               "\n" + points_table(part.as_built.points, console.verbose()) + "\n" + checks_table(checks);
  reply.fields["file"] = file;
  reply.fields["placements"] = placements_json(part);
  reply.fields["scale"] = part.scale;
  reply.fields["alone"] = part.alone ? Json(word(*part.alone)) : Json();
  reply.fields["as_built"] = to_json(part.as_built);
  reply.fields["checks"] = to_json(checks);
  reply.fields["points"] = points_json(part.as_built.points);
  if (!all_ok(checks)) {
    reply.exit = Exit::check_failed;
    add_failures(checks, reply);
  }
  return reply;
}

}  // namespace

Command rewind_command() {
  std::vector<Option> options = limit_options();
  options.push_back({"--as-is", "", "wind it in its present position, with the axis at\n(0, 0)"});
  return {"rewind",
          "SPEC FILE",
          "the joint angle of a finished part",
          "Winds two tendons on the grooves of a part (any mesh that 'fusee check'\n"
          "reads, or a dxf with the layers P1_FLOOR and P2_FLOOR), also one that was edited\n"
          "by hand, and compares the resulting joint angle with that of the mechanism\n"
          "file SPEC. A mesh that was moved, turned about its axis or turned over, for\n"
          "example by a slicer, is found by its grooves and moved back, with a note.\n"
          "A mirrored mesh, or one more than 2 % too large or small, is refused; a smaller\n"
          "difference of size is reported. A pulley of several turns is wound in its\n"
          "present position.",
          options,
          {{"fusee rewind arm.toml out/arm/pulley.stl", "check the mesh"},
           {"fusee rewind arm.toml out/arm/profile.dxf", "check the drawing"},
           {"fusee rewind arm.toml out/arm/pulley.stl --max-theta-error-deg 0.01", "with a tighter limit"},
           {"fusee rewind arm.toml out/arm/pulley.stl --as-is", "in its present position only"}},
          run_rewind};
}

}  // namespace fusee::cli
