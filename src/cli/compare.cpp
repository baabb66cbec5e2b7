#include <filesystem>
#include <optional>

#include "base/output_list.h"
#include "base/text.h"
#include "cli/command.h"
#include "cli/measured_columns.h"
#include "cli/table.h"
#include "fusee/export.h"
#include "fusee/pipeline.h"

namespace fusee::cli {
namespace {

std::vector<std::filesystem::path> runs_of(const Arguments& arguments, const std::string& option) {
  const std::vector<std::string> names = arguments.texts(option);
  if (names.empty())
    throw UsageError("compare requires " + option + " with at least one run",
                     "give SPEC first: fusee compare arm.toml --before a_1.csv a_2.csv --after b_1.csv");
  return {names.begin(), names.end()};
}

std::string changes_table(const formats::ComparisonProduct& product) {
  std::vector<std::vector<std::string>> rows;
  for (const formats::ChangeRow& row : formats::change_rows(product))
    rows.push_back({"  " + row.cause, row.change, row.interval, row.share});
  if (rows.empty()) return "";
  return "\n" + table({{"Cause"}, {"change"}, {"95 %"}, {"of the difference"}}, rows);
}

std::string difference_text(const calibration::Comparison& comparison) {
  const auto deg = [](double value) { return fixed(degrees(value), 4); };
  return "\n" + table({{"deg at the joint, rms"}, {"", Align::right}},
                      {{"  difference between the states", deg(comparison.difference.before)},
                       {"  unexplained by the changes", deg(comparison.difference.after)},
                       {"  noise floor", deg(comparison.changes.noise.rms)}});
}

std::string detectable_text(const calibration::Comparison& comparison) {
  std::vector<std::vector<std::string>> rows;
  for (const calibration::Detectable& one : comparison.changes.detectable)
    rows.push_back({"  " + one.name, fixed(degrees(one.smallest), 4)});
  if (rows.empty()) return "";
  return "\n" + table({{"Detectable size, deg rms"}, {"", Align::right}}, rows);
}

std::string summary(const formats::ComparisonProduct& product, bool verbose) {
  const calibration::Comparison& comparison = product.comparison;
  std::string text = wrapped(formats::comparison_words(product), "", "");
  if (comparison.verdict != calibration::ComparisonVerdict::changed &&
      comparison.verdict != calibration::ComparisonVerdict::no_change)
    return text;
  text += changes_table(product) + difference_text(comparison);
  return verbose ? text + detectable_text(comparison) : text;
}

std::string files_text(const pipeline::CompareResult& result, const std::string& folder) {
  if (result.outputs.empty()) return "";
  std::vector<std::vector<std::string>> rows;
  for (const OutputFile& file : result.outputs)
    rows.push_back({"  " + file.name, std::to_string(file.bytes.size()) + " B"});
  return "\n" + table({{result.published ? "Files" : "Would be written (--dry-run)"}, {"", Align::right}}, rows) +
         "  in " + folder + "\n";
}

Reply reply_of(const pipeline::CompareResult& result, const std::string& folder, bool verbose) {
  const formats::ComparisonProduct& product = result.product;
  Reply reply;
  reply.diagnostics = product.file.warnings;
  reply.units = product.file.mechanism.units;
  const measurement::Measurement& logs = product.measurement;
  add_log_notes(logs.runs, logs.sources, reply);
  add_log_notes(logs.runs, verbose ? logs.notes : formats::shortened_notes(logs.notes), reply);
  reply.fields = parse_json(formats::comparison_json(product));
  if (!result.outputs.empty()) {
    reply.fields["folder"] = folder;
    reply.fields["published"] = result.published;
    reply.fields["outputs"] = output_list(result.outputs);
  }
  if (product.comparison.verdict == calibration::ComparisonVerdict::not_comparable) {
    reply.exit = Exit::bad_input;
    reply.diagnostics.push_back(make_diagnostic(Severity::error, product.comparison.why));
    return reply;
  }
  reply.text = summary(product, verbose) + files_text(result, folder);
  return reply;
}

Reply run_compare(const Arguments& arguments, Console& console, const RunContext& context) {
  const std::filesystem::path spec = arguments.positionals().front();
  const auto before = runs_of(arguments, "--before"), after = runs_of(arguments, "--after");
  pipeline::CompareOptions options;
  options.columns = columns_from(arguments);
  options.folder = arguments.text("--out").value_or("");
  options.force = arguments.has("--force");
  options.dry_run = arguments.has("--dry-run");
  const pipeline::CompareResult result =
      pipeline::compare(read_mechanism(spec, arguments.settings(), *context.files), before, after, options, context);
  return reply_of(result, options.folder.string(), console.verbose());
}

}  // namespace

Command compare_command() {
  return {"compare",
          "SPEC",
          "what changed between two measured states of one joint",
          "Compares runs of one joint in two states, such as before and after it was\n"
          "retensioned, reprinted, warmed or worn. Identifies the joint before, and then\n"
          "the changes that the later runs show, in terms of the effects of\n"
          "'fusee calibrate'. Errors common to both states cancel, and the scatter of\n"
          "repeated runs is not a change. Runs are read as by calibrate. The exit code\n"
          "is 3 if the files are not two states of one joint.",
          with_reading_options({{"--before", "FILE...", "runs of the earlier state, one or more", true},
                                {"--after", "FILE...", "runs of the later state, one or more", true},
                                {"-o,--out", "DIR", "folder of comparison.json and report.html\n(default: no files)"}}),
          {{"fusee compare arm.toml --before run_1.csv --after run_2.csv", "what changed in between"},
           {"fusee compare arm.toml --before run_1.csv --after run_2.csv -o compared", "with a page"}},
          run_compare,
          "--before FILE... --after FILE..."};
}

}  // namespace fusee::cli
