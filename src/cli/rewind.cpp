#include "cli/as_built.h"
#include "cli/command.h"
#include "cli/table.h"
#include "fusee/base/text.h"
#include "fusee/pipeline.h"

namespace fusee::cli {
namespace {

/// Rows of the table for a person; --json and --verbose give every point.
constexpr std::size_t k_short_table = 13;

std::string points_table(const std::vector<RewindPoint>& points, bool all) {
  const std::size_t rows = all ? points.size() : std::min(points.size(), k_short_table);
  std::vector<std::vector<std::string>> cells;
  for (std::size_t row = 0; row < rows; ++row) {
    const RewindPoint& point = points[rows < 2 ? 0 : row * (points.size() - 1) / (rows - 1)];
    cells.push_back({fixed(degrees(point.alpha), 2), fixed(degrees(point.theta_declared), 3),
                     fixed(degrees(point.theta), 3), fixed(degrees(point.theta - point.theta_declared), 4),
                     fixed(point.slack, 4)});
  }
  return table({{"alpha_deg", Align::right},
                {"declared_deg", Align::right},
                {"theta_deg", Align::right},
                {"error_deg", Align::right},
                {"slack_mm", Align::right}},
               cells);
}

Json points_json(const std::vector<RewindPoint>& points) {
  Json list = Json::array();
  for (const RewindPoint& point : points) {
    list.push_back({{"alpha_deg", degrees(point.alpha)},
                    {"theta_declared_deg", degrees(point.theta_declared)},
                    {"theta_deg", degrees(point.theta)},
                    {"slack_mm", point.slack}});
  }
  return list;
}

/// What is wrong with the part is said of its file.
RewindResult rewind_file(const JointAsItIs& joint, const std::string& file, Console& console) {
  console.progress("reading the part");
  const Part part = read_part(file);
  console.progress("winding tendons on it");
  try {
    return rewind_part(joint, part);
  } catch (const InputError& error) {
    std::vector<Diagnostic> diagnostics = error.diagnostics();
    for (Diagnostic& diagnostic : diagnostics) diagnostic.place.file = file;
    throw InputError(std::move(diagnostics));
  }
}

Reply run_rewind(const Arguments& arguments, Console& console) {
  const AsBuiltLimits limits = limits_from(arguments);
  const MechanismFile spec = read_mechanism(arguments.positionals()[0], arguments.settings());
  const std::string& file = arguments.positionals()[1];
  const JointAsItIs joint = as_it_is(spec.mechanism);
  const RewindResult as_built = rewind_file(joint, file, console);
  const std::vector<Check> checks = as_built_checks(joint.mechanism, as_built, limits);
  Reply reply;
  reply.diagnostics = spec.warnings;
  reply.text = file + ": " + as_built_text(as_built) + "\n\n" + points_table(as_built.points, console.verbose()) +
               "\n" + checks_table(checks);
  reply.fields["file"] = file;
  reply.fields["as_built"] = to_json(as_built);
  reply.fields["checks"] = to_json(checks);
  reply.fields["points"] = points_json(as_built.points);
  if (!all_ok(checks)) {
    reply.exit = Exit::check_failed;
    add_failures(checks, reply);
  }
  return reply;
}

}  // namespace

Command rewind_command() {
  return {"rewind",
          "SPEC FILE",
          "the joint angle that a made part gives",
          "Winds two tendons on the grooves of a made part (any mesh that 'fusee check'\n"
          "reads, or a dxf with the layers P1_FLOOR and P2_FLOOR), also one that was edited\n"
          "by hand, and compares the joint angle that they give with that of the mechanism\n"
          "file SPEC.",
          limit_options(),
          {{"fusee rewind arm.toml out/arm/pulley.stl", "is the printed part right?"},
           {"fusee rewind arm.toml out/arm/profile.dxf", "is the drawing right?"},
           {"fusee rewind arm.toml out/arm/pulley.stl --max-theta-error-deg 0.01", "with a tighter limit"}},
          run_rewind};
}

}  // namespace fusee::cli
