#include <utility>

#include "analysis/plausibility.h"
#include "fusee/joint.h"
#include "fusee/pipeline.h"
#include "pipeline/design.h"
#include "pipeline/layout.h"
#include "pipeline/motor_advice.h"
#include "pipeline/multi_turn.h"

namespace fusee::pipeline {
namespace {

/// Removes the obstacles that a multi-turn pulley does not have.
void drop_one_turn_obstacles(analysis::AnalysisResult& result) {
  std::erase_if(result.obstacles,
                [](const profile::Condition& condition) { return condition.name.rfind("one_turn_", 0) == 0; });
}

/// Advice of build() on a motor that does not suffice; none if no pulley can be made.
profile::Advice advice_on_motor(const MechanismFile& file, const RunContext& context) {
  context.begin_step("searching for changes that suit the motor");
  const BuildOptions options;
  formats::Product product;
  product.file = file;
  product.joint = joint::identified_joint(file.mechanism);
  if (!design_any(product, options.chord_error_mm, options.limits, context.without_progress())) return {};
  return motor_advice(product, options, context.without_progress());
}

}  // namespace

analysis::AnalysisResult analyze(const MechanismFile& file, const analysis::AnalysisOptions& options,
                                 const RunContext& context) {
  demand_tendons(file, "analyze");
  context.begin_step("moving the joint through its range");
  analysis::AnalysisResult result =
      analysis::analyse(joint::identified_joint(file.mechanism).mechanism, options, context);
  if (!result.exists) result.layout_advice = drum_advice(file, {}, context);
  result.warnings = analysis::likely_input_errors(file);
  // A tendon that breaks is an error rather than a warning.
  if (const auto overloaded = analysis::overloaded_tendon(file); overloaded && !result.breaks_at)
    result.warnings.push_back(*overloaded);
  const std::vector<Diagnostic> bends = analysis::tight_bends(file);
  result.warnings.insert(result.warnings.end(), bends.begin(), bends.end());
  if (const auto turns = note_on_turns(file)) {
    drop_one_turn_obstacles(result);
    result.warnings.push_back(*turns);
    for (Diagnostic& warning : warnings_of_turns(file)) result.warnings.push_back(std::move(warning));
  }
  if (result.motor) {
    if (!result.motor->ok()) result.motor->advice = advice_on_motor(file, context);
    for (Diagnostic& warning : analysis::motor_warnings(*result.motor, file))
      result.warnings.push_back(std::move(warning));
  }
  return result;
}

}  // namespace fusee::pipeline
