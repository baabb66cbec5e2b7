#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>

#include "base/output_list.h"
#include "base/text.h"
#include "cli/calibration_summary.h"
#include "cli/command.h"
#include "cli/measured_columns.h"
#include "cli/table.h"
#include "fusee/pipeline.h"

namespace fusee::cli {
namespace {

// ---- options --------------------------------------------------------------------------------------------------------

std::vector<std::filesystem::path> paths(const std::vector<std::string>& names) { return {names.begin(), names.end()}; }

std::vector<std::filesystem::path> runs_from(const Arguments& arguments) {
  std::vector<std::filesystem::path> runs = paths(arguments.positionals());
  runs.erase(runs.begin());
  std::set<std::filesystem::path> held_out;
  for (const auto& name : paths(arguments.texts("--hold-out"))) held_out.insert(name.lexically_normal());
  if (std::all_of(runs.begin(), runs.end(),
                  [&](const auto& run) { return held_out.count(run.lexically_normal()) > 0; }))
    throw UsageError("every run is held out: no run remains for the fit", "remove --hold-out for one of them");
  return runs;
}

// ---- command --------------------------------------------------------------------------------------------------------

std::string files_text(const std::vector<OutputFile>& outputs, const std::string& folder, bool published) {
  std::vector<std::vector<std::string>> rows;
  for (const OutputFile& file : outputs) rows.push_back({"  " + file.name, std::to_string(file.bytes.size()) + " B"});
  return "\n" + table({{published ? "Files" : "Would be written (--dry-run)"}, {"", Align::right}}, rows) + "  in " +
         folder + "\n";
}

void add_notes(const pipeline::CalibrateResult& result, bool verbose, Reply& reply) {
  const measurement::Measurement& logs = result.product.measurement;
  reply.diagnostics = result.product.file.warnings;
  add_log_notes(logs.runs, logs.sources, reply);
  add_log_notes(logs.runs, verbose ? logs.notes : formats::shortened_notes(logs.notes), reply);
  if (result.rewritten)
    reply.diagnostics.push_back(make_diagnostic(
        Severity::note,
        "corrected.toml includes the values of --set and has every key; comments of the file are omitted"));
}

pipeline::CalibrateOptions calibrate_options_from(const Arguments& arguments) {
  pipeline::CalibrateOptions options;
  options.columns = columns_from(arguments);
  options.hold_out = paths(arguments.texts("--hold-out"));
  options.folder = output_folder(arguments, "_calibration");
  options.force = arguments.has("--force");
  options.dry_run = arguments.has("--dry-run");
  options.audit = !arguments.has("--no-audit");
  return options;
}

Reply run_calibrate(const Arguments& arguments, Console& console, const RunContext& context) {
  const std::filesystem::path spec = arguments.positionals().front();
  const pipeline::CalibrateOptions options = calibrate_options_from(arguments);
  const std::vector<std::filesystem::path> runs = runs_from(arguments);
  const MechanismFile file = read_mechanism(spec, arguments.settings(), *context.files);
  const pipeline::CalibrateResult result = pipeline::calibrate(file, runs, options, context);
  Reply reply;
  reply.units = file.mechanism.units;
  add_notes(result, console.verbose(), reply);
  reply.text = calibration_summary(result.product, console.verbose()) +
               files_text(result.outputs, options.folder.string(), result.published);
  reply.fields = parse_json(formats::calibration_json(result.product));
  reply.fields["folder"] = options.folder.string();
  reply.fields["published"] = result.published;
  reply.fields["outputs"] = output_list(result.outputs);
  return reply;
}

}  // namespace

Command calibrate_command() {
  return {"calibrate",
          "SPEC RUN.csv...",
          "measured data: errors, causes, a better pulley",
          "Compares measured runs of a joint (CSV with alpha_deg,theta_deg and, if logged,\n"
          "time_s,load_N,temperature_C; other units by name, as theta_rad, time_ms,\n"
          "load [kg], or by --unit; or MCAP files and bags of ROS 2 with joint states of\n"
          "motor and joint) with the mechanism file SPEC. Determines the\n"
          "residual, and identifies the effects that also explain held-out data, with\n"
          "equally likely alternatives. Writes corrected.toml (fusee build makes its\n"
          "pulley), compensation.csv (motor angles in both directions),\n"
          "calibration.json, report.html and next/ (the next measurements: a page for\n"
          "the bench and run files to fill in). The exit code is 0 if the data are\n"
          "readable, whatever the verdict, also for not_testable; unreadable data\n"
          "exit with 3.",
          with_reading_options({{"-o,--out", "DIR", "where the files go\n(default: out/<name of SPEC>_calibration)"},
                                {"--hold-out", "FILE", "a run for validation only; repeatable", true},
                                {"--no-audit", "", "skip the false-positive estimate"}}),
          {{"fusee calibrate arm.toml run_1.csv run_2.csv", "files in out/arm_calibration; open its report.html"},
           {"fusee calibrate arm.toml run_1.csv --hold-out run_2.csv", "validate with run_2.csv alone"},
           {"fusee calibrate jaw.toml jaw.csv --column load=tau_out_Nm", "the load has another name"},
           {"fusee calibrate arm.toml log.csv --ticks-per-turn alpha=4096", "alpha_deg has encoder counts"},
           {"fusee calibrate arm.toml run_1.mcap --column alpha=/joint_states/m1", "a recording of ROS 2"}},
          run_calibrate};
}

}  // namespace fusee::cli
