#include "fusee/pipeline.h"
#include "pipeline/multi_turn.h"
#include "pipeline/without_law.h"

namespace fusee::pipeline {
namespace {

std::vector<OutputFile> outputs_of(const formats::PlanProduct& product) {
  std::vector<OutputFile> outputs = {{"plan.json", formats::plan_json(product)},
                                     {"plan.html", formats::plan_html(product)}};
  for (std::size_t i = 0; i < product.plan.steps.size(); ++i) {
    if (product.plan.steps[i].run)
      outputs.push_back({formats::run_file_name(product.plan, i), formats::run_csv(product, i)});
  }
  outputs.push_back({"manifest.json", formats::plan_manifest_json(product, outputs)});
  return outputs;
}

/// Names of the run files that an earlier plan may have written.
std::vector<std::string> run_names() {
  constexpr int k_most_runs = 99;
  std::vector<std::string> names;
  for (int i = 1; i <= k_most_runs; ++i) names.push_back("run_" + std::to_string(i) + ".csv");
  return names;
}

}  // namespace

PlanResult plan(const MechanismFile& file, const PlanFilesOptions& options, const RunContext& context) {
  PlanResult result;
  result.product.file = with_plausibility_warnings_and_turns(file);
  result.product.noise = options.plan.noise;
  result.product.minutes = options.plan.minutes;
  result.without_law = without_law(file.mechanism);
  if (result.without_law) return result;
  OutputFolder target(options.folder, options.force, context);
  // Before the work, so that a refusal costs no time.
  target.claim({"plan.json", "plan.html", "manifest.json"});
  result.product.plan = plan::plan_runs(file.mechanism, options.plan, context);
  if (result.product.plan.steps.empty()) return result;
  result.outputs = outputs_of(result.product);
  if (options.dry_run) return result;
  for (const OutputFile& output : result.outputs) target.stage(output);
  target.withdraw(run_names());
  target.publish(result.product.file.warnings);
  result.published = true;
  return result;
}

}  // namespace fusee::pipeline
