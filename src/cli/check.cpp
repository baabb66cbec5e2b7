#include "cli/as_built.h"
#include "cli/command.h"
#include "fusee/pipeline.h"

namespace fusee::cli {
namespace {

std::string what_it_is(const Part& part) {
  if (const auto* mesh = std::get_if<TriangleMesh>(&part)) {
    return "a mesh of " + std::to_string(mesh->triangles.size()) + " triangles and " +
           std::to_string(mesh->vertices.size()) + " vertices";
  }
  const auto& drawing = std::get<Drawing>(part);
  return "a drawing (" + drawing.version + ") of " + std::to_string(drawing.paths.size()) + " paths";
}

Reply run_check(const Arguments& arguments, Console& console) {
  const std::string& file = arguments.positionals().front();
  console.progress("reading the file");
  const Part part = read_part(file);
  console.progress("checking");
  const std::vector<Check> checks = check_part(part);
  Reply reply;
  const bool ok = all_ok(checks);
  reply.text =
      file + ": " + what_it_is(part) + "\n\n" + checks_table(checks) + "\n" + (ok ? "valid" : "not valid") + "\n";
  reply.fields["file"] = file;
  reply.fields["kind"] = std::holds_alternative<Drawing>(part) ? "drawing" : "mesh";
  reply.fields["checks"] = to_json(checks);
  if (!ok) {
    reply.exit = Exit::check_failed;
    add_failures(checks, reply);
  }
  return reply;
}

}  // namespace

Command check_command() {
  return {"check",
          "FILE",
          "a mesh or drawing: valid, or what is wrong and where",
          "Checks a mesh (stl, obj, 3mf, off, ply, drc) or a drawing (dxf) from anywhere:\n"
          "is it a closed, sound solid, or closed, clean contours? Each check is shown with\n"
          "its value and its limit, and a failed one with the place of the fault.",
          {},
          {{"fusee check out/arm/pulley.stl", "is the mesh a solid that can be printed?"},
           {"fusee check out/arm/plates.dxf", "are all contours closed and free of crossings?"},
           {"fusee check out/arm/pulley.3mf --json", "the same for a script"}},
          run_check};
}

}  // namespace fusee::cli
