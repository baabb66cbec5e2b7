#include "base/text.h"
#include "cli/as_built.h"
#include "cli/command.h"
#include "cli/strict.h"
#include "fusee/joint.h"
#include "fusee/mechanism_file.h"
#include "fusee/pipeline.h"

namespace fusee::cli {
namespace {

std::string description_of(const pipeline::Part& part) {
  if (const auto* mesh = std::get_if<solid::TriangleMesh>(&part)) {
    return "a mesh of " + std::to_string(mesh->triangles.size()) + " triangles and " +
           std::to_string(mesh->vertices.size()) + " vertices";
  }
  const auto& drawing = std::get<formats::Drawing>(part);
  return "a drawing (" + drawing.version + ") of " + std::to_string(drawing.paths.size()) + " paths";
}

/// Sizes of a part outside of this range nearly always mean another unit.
constexpr double k_least_plausible = 3.0, k_most_plausible = 1000.0;  // mm

std::string extent_text(const Vec3& extent, bool is_flat, double factor) {
  std::string text = rounded(factor * extent.x()) + " × " + rounded(factor * extent.y());
  if (!is_flat) text += " × " + rounded(factor * extent.z());
  return text + " mm";
}

std::string size_text(const pipeline::PartSize& size) {
  if (!size.extent) return "size: none, the part is empty";
  if (size.contours)
    return "size " + extent_text(*size.extent, true, 1) + ", " + std::to_string(*size.contours) + " closed " +
           (*size.contours == 1 ? "path, marks included" : "paths, marks included");
  const std::string extent = "size " + extent_text(*size.extent, false, 1);
  return extent +
         (size.volume ? ", volume " + rounded(*size.volume / 1000.0) + " cm³" : ", no volume: the mesh is not closed");
}

/// Files have no unit, or a wrong one; the size shows it.
void add_unit_warning(const std::string& file, const pipeline::PartSize& size, Reply& reply) {
  if (!size.extent) return;
  const bool is_flat = size.contours.has_value();
  const double largest = size.extent->maxCoeff();
  const auto size_scaled_by = [&](double factor) { return extent_text(*size.extent, is_flat, factor); };
  std::string guess;
  if (largest > 0 && largest < k_least_plausible)
    guess = "it looks like inches (× 25.4 = " + size_scaled_by(25.4) + ") or metres (× 1000 = " + size_scaled_by(1000) +
            ")";
  if (largest > k_most_plausible)
    guess = "it looks like millimetres read as inches (÷ 25.4 = " + size_scaled_by(1 / 25.4) +
            ") or as metres (÷ 1000 = " + size_scaled_by(0.001) + ")";
  if (guess.empty()) return;
  Diagnostic warning = about_file(Severity::warning, file, "in mm it measures " + size_scaled_by(1) + ": " + guess);
  warning.hint = "export it in millimetres, or scale it in the slicer or cutter";
  reply.diagnostics.push_back(warning);
}

/// Unusual entities that are harmless here but may not be in other programs.
void add_remarks(const std::string& file, const pipeline::Part& part, Reply& reply) {
  const auto* drawing = std::get_if<formats::Drawing>(&part);
  if (drawing == nullptr) return;
  for (const formats::DrawingRemark& remark : drawing->remarks) {
    const std::string others = remark.count > 1 ? " (" + std::to_string(remark.count) + " such entities)" : "";
    reply.diagnostics.push_back({Severity::warning, {file, remark.line, 0}, remark.text + others, {}});
  }
}

void add_size(const pipeline::PartSize& size, Reply& reply) {
  if (size.extent) {
    reply.fields["size_mm"] = {size.extent->x(), size.extent->y()};
    if (!size.contours) reply.fields["size_mm"].push_back(size.extent->z());
  }
  if (size.volume) reply.fields["volume_mm3"] = *size.volume;
  if (size.contours) reply.fields["contours"] = *size.contours;
}

/// Warns about a valid mesh whose grooves are those of the mechanism's pulley in another size.
void add_scale_warning(const DeclaredMechanism& mechanism, const std::string& file, const pipeline::Part& part,
                       Reply& reply) {
  if (!std::holds_alternative<solid::TriangleMesh>(part)) return;
  const auto add_note = [&](const std::string& reason) {
    reply.diagnostics.push_back(
        about_file(Severity::note, file, "its size is not compared with the mechanism's pulley: " + reason));
  };
  double scale = 1;
  try {
    const pipeline::RewoundPart rewound = pipeline::rewind_moved_part(joint::identified_joint(mechanism), part);
    if (rewound.place == pipeline::PartPlace::not_recognised) return add_note("its grooves are others");
    scale = rewound.scale;
  } catch (const InputError& error) {
    return add_note(error.diagnostics().front().message);
  }
  reply.fields["scale"] = scale;
  if (scale == 1) return;
  Diagnostic warning = about_file(Severity::warning, file,
                                  "it is " + rounded(100 * std::abs(scale - 1), 2) + " % " +
                                      (scale > 1 ? "larger" : "smaller") + " than the mechanism file's pulley");
  warning.hint = "'fusee rewind' reports the error of the joint angle";
  reply.diagnostics.push_back(warning);
}

/// Adds the test of the room that --mechanism states, or a note that gives the reason why there is none.
void add_room(const Arguments& arguments, const pipeline::Part& part, const RunContext& context,
              std::vector<Check>& checks, Reply& reply) {
  const std::optional<std::string> path = arguments.text("--mechanism");
  if (!path) return;
  const MechanismFile spec = read_mechanism(*path, arguments.settings(), *context.files);
  pipeline::demand_tendons(spec, "make this part for");
  reply.diagnostics = spec.warnings;
  reply.fields["mechanism"] = *path;
  if (all_ok(checks)) add_scale_warning(spec.mechanism, arguments.positionals().front(), part, reply);
  if (const std::optional<Check> room = pipeline::room_check(spec.mechanism, part)) {
    checks.push_back(*room);
    return;
  }
  const bool is_drawing = std::holds_alternative<formats::Drawing>(part);
  reply.diagnostics.push_back(about_file(
      Severity::note, *path,
      is_drawing ? "the room is not tested: the outlines of a drawing do not lie about the pulley's axis; test the mesh"
                 : "the room is not tested: the file has no body.room_diameter_mm"));
}

Reply run_check(const Arguments& arguments, Console&, const RunContext& context) {
  const std::string& file = arguments.positionals().front();
  context.begin_step("reading the file");
  const pipeline::Part part = pipeline::read_part(file, *context.files);
  context.begin_step("checking");
  std::vector<Check> checks = pipeline::check_part(part);
  const pipeline::PartSize size = pipeline::size_of(part, checks);
  Reply reply;
  add_room(arguments, part, context, checks, reply);
  const bool ok = all_ok(checks);
  reply.text = file + ": " + description_of(part) + "\n" + size_text(size) + "\n\n" + checks_table(checks) + "\n" +
               (ok ? "valid" : "not valid") + "\n";
  reply.fields["file"] = file;
  reply.fields["kind"] = std::holds_alternative<formats::Drawing>(part) ? "drawing" : "mesh";
  add_size(size, reply);
  reply.fields["checks"] = to_json(checks);
  add_unit_warning(file, size, reply);
  add_remarks(file, part, reply);
  if (!ok) {
    reply.exit = Exit::check_failed;
    add_failures(checks, reply);
  }
  apply_strict(arguments, reply);
  return reply;
}

}  // namespace

Command check_command() {
  return {"check",
          "FILE",
          "validity of a mesh or drawing",
          "Checks a mesh (stl, obj, 3mf, off, ply, drc) or a drawing (dxf) from anywhere:\n"
          "a closed, valid solid, or closed contours without crossings. Each check has a\n"
          "value and a limit, and a failed one the place of the fault. A faulty facet or a\n"
          "duplicate line fails one check and is omitted from the others. Reports size and\n"
          "volume, and warns if the size suggests inches or metres. With --mechanism it\n"
          "also tests that the part, after the print has shrunk, fits into the mechanism's\n"
          "body.room_diameter_mm about the z axis, and warns if it has another size than\n"
          "the mechanism's pulley.",
          {{"--mechanism", "SPEC.toml", "also test the room and the size of this mechanism"}, strict_option()},
          {{"fusee check out/arm/pulley.stl", "is the mesh a solid that can be printed?"},
           {"fusee check out/arm/plates.dxf", "are all contours closed and free of crossings?"},
           {"fusee check out/arm/pulley.stl --mechanism arm.toml", "does it fit into its room?"},
           {"fusee check out/arm/pulley.3mf --json", "for a script"}},
          run_check};
}

}  // namespace fusee::cli
