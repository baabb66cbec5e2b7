#include <set>

#include "fusee/joint.h"
#include "fusee/pipeline.h"
#include "pipeline/law_table_copy.h"
#include "pipeline/multi_turn.h"

namespace fusee::pipeline {
namespace {

/// Run files that a calibration may write for the next measurements.
constexpr int k_most_next_runs = 9;
/// Run files that an earlier calibration may have written.
constexpr int k_most_earlier_runs = 99;

/// Files to read: the fitted runs, then the held-out ones. A run that is given twice is read twice, and refused.
struct RunFiles {
  std::vector<std::filesystem::path> all;
  std::size_t fitted = 0;  ///< number of fitted runs
};

RunFiles run_files(const std::vector<std::filesystem::path>& runs, const std::vector<std::filesystem::path>& hold_out) {
  RunFiles files;
  std::set<std::filesystem::path> held_out, seen;
  for (const auto& run : hold_out) held_out.insert(run.lexically_normal());
  for (const auto& run : runs) {
    if (held_out.count(run.lexically_normal()) == 0) files.all.push_back(run);
  }
  files.fitted = files.all.size();
  for (const auto& run : hold_out) {
    if (seen.insert(run.lexically_normal()).second) files.all.push_back(run);
  }
  return files;
}

/// State of a calibration.
struct CalibrationContext {
  const MechanismFile& file;
  const CalibrateOptions& options;
  CalibrateResult& result;
  const RunContext& run;
};

std::vector<std::string> names_from(const measurement::Measurement& measurement, std::size_t first) {
  std::vector<std::string> names;
  for (std::size_t i = first; i < measurement.runs.size(); ++i) names.push_back(measurement.runs[i].name);
  return names;
}

/// Reads the runs, and computes calibration, input errors and correction. A corrected file describes the joint with its
/// identified effects: only further effects are identified.
void read_and_calibrate(const CalibrationContext& context, const RunFiles& runs) {
  formats::CalibrationProduct& product = context.result.product;
  const DeclaredMechanism& declared = context.file.mechanism;
  const DeclaredMechanism expected = joint::expected_joint(declared);
  context.run.begin_step("reading the runs");
  const measurement::Measurement as_read = measurement::read_measurement(
      runs.all, measurement::expecting(expected, context.options.columns), *context.run.files);
  product.measurement = as_read;
  measurement::compare_with_declared(expected, product.measurement);
  calibration::CalibrationOptions options;
  options.hold_out = names_from(product.measurement, runs.fitted);
  options.context = context.run;
  options.audit = context.options.audit;
  options.search_effects = !calibration::is_input_error_obvious(declared, as_read);
  product.calibration = calibration::calibrate(expected, product.measurement, options);
  context.run.begin_step("checking for input errors");
  product.input_errors = calibration::find_input_errors(declared, as_read, product.calibration);
  const std::string check_first = "an input error in the file or the log may explain the data: check it first";
  const bool is_clean = product.input_errors.empty();
  if (!is_clean) calibration::reject_curve(product.measurement, check_first, product.calibration);
  context.run.begin_step("computing the correction");
  product.correction.identified = declared.identified;
  product.correction.why_no_pulley_file = product.correction.why_no_table =
      is_clean ? "the data are inconclusive" : check_first;
  if (is_clean && product.calibration.verdict != calibration::CalibrationVerdict::not_testable)
    product.correction = correction::correct(declared, product.measurement, product.calibration);
  product.rehearsal = correction::rehearse(expected, product.measurement, product.calibration);
}

std::vector<OutputFile> outputs_of(const formats::CalibrationProduct& product, const std::string& declared,
                                   FileAccess& files) {
  std::vector<OutputFile> outputs;
  outputs.push_back({"calibration.json", formats::calibration_json(product)});
  if (law_table_name(product.file.mechanism)) outputs.push_back(law_table_copy(product.file, files));
  if (product.correction.why_no_pulley_file.empty())
    outputs.push_back({"corrected.toml", correction::corrected_toml(declared, product.file.mechanism,
                                                                    product.calibration, product.correction)});
  if (product.correction.why_no_table.empty())
    outputs.push_back({"compensation.csv", correction::compensation_csv(product.correction)});
  outputs.push_back({"report.html", formats::calibration_report_html(product)});
  for (OutputFile& file : formats::next_files(product)) outputs.push_back(std::move(file));
  outputs.push_back({"manifest.json", formats::calibration_manifest_json(product, outputs)});
  return outputs;
}

std::vector<std::string> output_names(const MechanismFile& file) {
  std::vector<std::string> names = {"calibration.json", "corrected.toml", "compensation.csv", "report.html",
                                    "manifest.json"};
  if (const auto table = law_table_name(file.mechanism)) names.push_back(*table);
  return names;
}

/// Adds the names of files for `runs` next measurements, the first of which is number `first_run`.
std::vector<std::string> with_next(std::vector<std::string> names, int first_run, int runs) {
  for (const std::string& name : formats::next_file_names(first_run, runs)) names.push_back(name);
  return names;
}

int first_free_run_beside(const RunFiles& files) {
  std::vector<std::string> names;
  for (const auto& run : files.all) names.push_back(run.filename().string());
  return formats::first_free_run(names);
}

void publish(const CalibrationContext& context, OutputFolder& folder) {
  for (const OutputFile& output : context.result.outputs) folder.stage(output);
  folder.publish(context.result.product.file.warnings);
  context.result.published = true;
}

}  // namespace

CalibrateResult calibrate(const MechanismFile& file, const std::vector<std::filesystem::path>& runs,
                          const CalibrateOptions& options, const RunContext& run) {
  CalibrateResult result;
  result.product.file = with_plausibility_warnings_and_turns(file);
  const CalibrationContext context{file, options, result, run};
  OutputFolder target(options.folder, options.force, run);
  const RunFiles files = run_files(runs, options.hold_out);
  // Before the work, so that a refusal costs no time.
  target.claim(with_next(output_names(file), first_free_run_beside(files), k_most_next_runs));
  const DeclaredText declared = declared_text(file, *run.files);
  result.rewritten = declared.rewritten;
  read_and_calibrate(context, files);
  result.outputs = outputs_of(result.product, declared.text, *run.files);
  // An earlier calibration may have left a correction or run files that this one does not write.
  target.withdraw(with_next(output_names(file), 1, k_most_earlier_runs));
  if (!options.dry_run) publish(context, target);
  return result;
}

}  // namespace fusee::pipeline
