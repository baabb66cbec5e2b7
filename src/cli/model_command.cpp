#include <cmath>
#include <filesystem>

#include "base/output_list.h"
#include "base/text.h"
#include "cli/as_built.h"
#include "cli/command.h"
#include "fusee/base.h"
#include "fusee/pipeline.h"

namespace fusee::cli {
namespace {

constexpr double k_smallest_limit_deg = 1e-6;
constexpr double k_most_ticks_per_turn = 1e8, k_most_zero_ticks = 1e9;

double whole_number(const Arguments& arguments, std::string_view option, double fallback, double most) {
  const double value = arguments.number(option, fallback, -most, most, "(a whole number)");
  if (value != std::floor(value))
    throw UsageError(std::string(option) + " must be a whole number; " + shortest(value) + " is none");
  return value;
}

/// The prefix of all names in joint_table.h; "" without --prefix.
std::string prefix_from(const Arguments& arguments) {
  const std::string prefix = arguments.text("--prefix").value_or("");
  constexpr std::size_t k_longest = 40;
  if (arguments.has("--prefix") && (prefix != formats::c_prefix(prefix) || prefix.size() > k_longest))
    throw UsageError(
        "--prefix must be a C identifier of at most 40 letters, digits and single '_'; '" + prefix + "' is not",
        "for example: --prefix " + formats::c_prefix(prefix));
  return prefix;
}

pipeline::ModelOptions model_options_from(const Arguments& arguments) {
  pipeline::ModelOptions options;
  options.most_error = radians(arguments.number("--max-error-deg", degrees(options.most_error), k_smallest_limit_deg,
                                                pipeline::k_largest_limit_deg, "deg"));
  options.most_table_error = radians(arguments.number("--max-table-error-deg", degrees(options.most_table_error),
                                                      k_smallest_limit_deg, pipeline::k_largest_limit_deg, "deg"));
  if (arguments.has("--ticks-per-turn")) {
    options.unit.per_turn = whole_number(arguments, "--ticks-per-turn", 0, k_most_ticks_per_turn);
    options.unit.ticks = true;
    options.unit.zero = whole_number(arguments, "--zero-ticks", 0, k_most_zero_ticks);
    if (std::abs(options.unit.per_turn) < 2)
      throw UsageError("--ticks-per-turn must be 2 or more, or -2 or less if counts fall as alpha grows");
  } else if (arguments.has("--zero-ticks")) {
    throw UsageError("--zero-ticks is the encoder's counts at home", "give --ticks-per-turn too");
  }
  options.declared = arguments.has("--declared");
  options.with_polynomial = !arguments.has("--no-polynomial");
  if (const auto given = arguments.text("--compensation")) {
    if (given->empty()) throw UsageError("--compensation takes a file, or the word none");
    options.compensation = *given == "none" ? std::filesystem::path() : std::filesystem::path(*given);
  } else if (options.declared) {
    options.compensation = std::filesystem::path();  // --declared ignores identified effects
  }
  options.prefix = prefix_from(arguments);
  options.force = arguments.has("--force");
  options.dry_run = arguments.has("--dry-run");
  options.folder = output_folder(arguments, "_model");
  return options;
}

/// An angle, rad, in degrees. Angles below 0.000001 deg are rounding errors, and are reported as 0.000001 deg.
std::string deg_text(double angle) {
  return angle < radians(1e-6) ? "0.000001 deg" : rounded(degrees(angle), 2) + " deg";
}

// ---- reply ----------------------------------------------------------------------------------------------------------

void add_changes(const std::string& file, const std::vector<pipeline::ModelChange>& changes, Reply& reply) {
  Json list = Json::array();
  for (const pipeline::ModelChange& change : changes) {
    const std::string words = "try " + change.words;
    reply.diagnostics.push_back(change.key.empty() ? make_diagnostic(Severity::note, words)  // an option
                                                   : about_file(Severity::note, file, words));
    Json entry = {{"text", change.words}};
    if (!change.key.empty()) {
      entry["key"] = change.key;
      entry["value"] = change.value;
    }
    list.push_back(entry);
  }
  reply.fields["advice"] = list;
}

/// Explains why there is no model; false if there is one.
bool explain_refusal(const pipeline::ModelResult& result, const pipeline::ModelOptions& options, Reply& reply) {
  const formats::ModelProduct& product = result.product;
  const auto refuse = [&](const std::string& words) {
    reply.diagnostics.push_back(about_file(Severity::error, product.file.path, words));
    reply.exit = Exit::infeasible;
    add_changes(product.file.path, result.changes, reply);
  };
  switch (result.ending) {
    case pipeline::ModelEnding::no_law:
      explain_without_law(product.file.path, *result.without_law, reply);
      return true;
    case pipeline::ModelEnding::no_equilibrium:
      refuse(
          "the identified joint has no equilibrium under its declared load. 'fusee analyze' shows "
          "where; --declared ignores the identified effects");
      return true;
    case pipeline::ModelEnding::polynomial_off:
      reply.fields["polynomial_error_deg"] = degrees(product.equality.error);
      refuse("the theta error of joint.xml would be " + deg_text(product.equality.error) +
             ": MuJoCo's polynomials end at degree 4, and --max-error-deg is " + rounded(degrees(options.most_error)));
      return true;
    case pipeline::ModelEnding::table_off:
      refuse("a table of " + std::to_string(model::k_most_pieces) + " pieces has an error above " +
             rounded(degrees(options.most_table_error)) + " deg (--max-table-error-deg)");
      return true;
    case pipeline::ModelEnding::done:
    case pipeline::ModelEnding::check_failed:
      break;
  }
  return false;
}

std::string model_summary(const pipeline::ModelResult& made, const pipeline::ModelOptions& options) {
  const formats::ModelProduct& product = made.product;
  const model::JointTable& table = product.table;
  std::string text = product.mechanism.name + ": the joint for other programs\n";
  std::string source = "of " + product.compensation + ", in both directions";
  if (product.curves.sensed.source == model::CurveSource::law) source = "of the target motion";
  if (product.curves.sensed.source == model::CurveSource::identified)
    source = "of the identified joint, in both directions";
  text += "  table             " + source + "\n";
  text += "  largest error of theta\n";
  if (product.with_polynomial)
    text += "    joint.xml       " + deg_text(product.equality.error) + " (polynomial of degree 4)\n";
  if (product.tendons) {
    const bool is_first = product.tendons->constrained == transmission::Side::left;
    const bool is_on_drum = product.tendons->tendons[is_first ? 0 : 1].drum > 0;
    text += "    joint_tendons.xml " + deg_text(product.tendons->error) + " (tendon " + (is_first ? "1" : "2") +
            (is_on_drum ? " on the drum)\n" : " over its pin)\n");
  }
  text += "    joint.urdf      " + deg_text(product.line.error) + " (a straight line; joint_ros2_control.urdf too)\n";
  text += "    joint_table.h   " + deg_text(std::max(table.errors.theta, table.errors.returned)) + " (" +
          std::to_string(table.pieces + 1) + " entries; joint_table.json too)\n";
  if (product.curves.physical.half_hysteresis > 0)
    text += "  simulators follow the mean of both directions, " + deg_text(product.curves.physical.half_hysteresis) +
            " from each at most\n";
  if (options.dry_run) return text + "  files             none written (--dry-run)\n";
  if (!made.published)
    return text + "  files             none written: " + options.folder.string() + " keeps its earlier run\n";
  return text + "  files             in " + options.folder.string() + "\n";
}

Json errors_json(const formats::ModelProduct& product) {
  Json json = Json::object();
  if (product.with_polynomial) json["joint.xml"] = degrees(product.equality.error);
  if (product.tendons) json["joint_tendons.xml"] = degrees(product.tendons->error);
  json["joint.urdf"] = json["joint_ros2_control.urdf"] = degrees(product.line.error);
  json["joint_table.h"] = json["joint_table.json"] =
      degrees(std::max(product.table.errors.theta, product.table.errors.returned));
  return json;
}

Reply run_model(const Arguments& arguments, Console&, const RunContext& context) {
  const pipeline::ModelOptions options = model_options_from(arguments);
  const MechanismFile file = read_mechanism(arguments.positionals().front(), arguments.settings(), *context.files);
  const pipeline::ModelResult made = pipeline::model(file, options, context);
  const formats::ModelProduct& product = made.product;
  Reply reply;
  reply.diagnostics = product.file.warnings;
  reply.units = file.mechanism.units;
  if (explain_refusal(made, options, reply)) return reply;
  for (const std::string& words : product.notes)
    reply.diagnostics.push_back(about_file(Severity::note, file.path, words));
  reply.text = model_summary(made, options);
  reply.fields["name"] = product.mechanism.name;
  reply.fields["folder"] = options.folder.string();
  reply.fields["published"] = made.published;
  reply.fields["theta_error_deg"] = errors_json(product);
  reply.fields["loop_deg"] = degrees(product.curves.physical.half_hysteresis);
  reply.fields["checks"] = to_json(product.checks);
  reply.fields["outputs"] = output_list(made.outputs);
  if (made.ending == pipeline::ModelEnding::check_failed) {
    reply.exit = Exit::check_failed;
    add_failures(product.checks, reply);
  }
  return reply;
}

}  // namespace

Command model_command() {
  return {
      "model",
      "SPEC",
      "the joint for simulators and firmware",
      "Writes the joint of SPEC for other programs: joint.xml and\n"
      "joint_tendons.xml for MuJoCo, joint.urdf, joint_ros2_control.urdf, and tables\n"
      "theta(alpha), alpha(theta), slope and holding torque as joint_table.h (C, 32-bit\n"
      "floats) and joint_table.json. Each states its error of theta(alpha), which is\n"
      "checked on the written file. A joint with [identified] is simulated in both\n"
      "directions, and its tables depend on the direction. A compensation.csv that\n"
      "'fusee calibrate' wrote next to SPEC is used if it exists.",
      {{"-o,--out", "DIR", "where the files go (default: out/<name of SPEC>_model)"},
       {"--max-error-deg", "DEG", "largest error of joint.xml (default 0.1)"},
       {"--max-table-error-deg", "DEG", "largest error of the tables (default 0.001)"},
       {"--ticks-per-turn", "N", "the motor angle in encoder counts, N a turn;\nnegative if they fall as alpha grows"},
       {"--zero-ticks", "N", "counts of the encoder at home (default 0)"},
       {"--compensation", "FILE", "make the tables from this compensation.csv;\nnone: ignore any such file"},
       {"--declared", "", "ignore identified effects"},
       {"--no-polynomial", "", "do not write joint.xml"},
       {"--prefix", "NAME", "prefix of names in joint_table.h (default: the\njoint's name)"}},
      {{"fusee model arm.toml", "files in out/arm_model"},
       {"fusee model arm.toml --ticks-per-turn 4096 --zero-ticks 2048", "tables in counts"},
       {"fusee model arm.toml --max-error-deg 0.02 --dry-run", "test a tighter limit without writing files"}},
      run_model};
}

}  // namespace fusee::cli
