#include "fusee/joint.h"
#include "fusee/pipeline.h"
#include "pipeline/multi_turn.h"

namespace fusee::pipeline {
namespace {

using Paths = std::vector<std::filesystem::path>;

std::vector<OutputFile> outputs_of(const formats::ComparisonProduct& product) {
  std::vector<OutputFile> outputs = {{"comparison.json", formats::comparison_json(product)},
                                     {"report.html", formats::comparison_report_html(product)}};
  outputs.push_back({"manifest.json", formats::comparison_manifest_json(product, outputs)});
  return outputs;
}

/// Reads the runs of both states, and compares the states with expected_joint() of the file.
void read_and_compare(const MechanismFile& file, const Paths& before, const Paths& after, const CompareOptions& options,
                      const RunContext& context, formats::ComparisonProduct& product) {
  context.begin_step("reading the runs");
  const DeclaredMechanism expected = joint::expected_joint(file.mechanism);
  Paths both = before;
  both.insert(both.end(), after.begin(), after.end());
  product.measurement = measurement::read_measurement(both, expected, options.columns, *context.files);
  product.runs_before = before.size();
  const calibration::ComparedRuns runs{measurement::read_measurement(before, expected, options.columns, *context.files),
                                       measurement::read_measurement(after, expected, options.columns, *context.files),
                                       product.measurement};
  product.comparison = calibration::compare_states(expected, runs, {.context = context});
}

void publish(OutputFolder& folder, CompareResult& result) {
  for (const OutputFile& output : result.outputs) folder.stage(output);
  folder.publish(result.product.file.warnings);
  result.published = true;
}

}  // namespace

CompareResult compare(const MechanismFile& file, const std::vector<std::filesystem::path>& before,
                      const std::vector<std::filesystem::path>& after, const CompareOptions& options,
                      const RunContext& context) {
  CompareResult result;
  result.product.file = with_plausibility_warnings_and_turns(file);
  std::optional<OutputFolder> target;
  if (!options.folder.empty()) {
    target.emplace(options.folder, options.force, context);
    // Before the work, so that a refusal costs no time.
    target->claim({"comparison.json", "report.html", "manifest.json"});
  }
  read_and_compare(file, before, after, options, context, result.product);
  if (!target) return result;
  result.outputs = outputs_of(result.product);
  if (!options.dry_run) publish(*target, result);
  return result;
}

}  // namespace fusee::pipeline
