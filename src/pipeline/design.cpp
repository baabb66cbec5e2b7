#include "pipeline/design.h"

#include "base/thread_pool.h"
#include "fusee/export.h"
#include "fusee/joint.h"
#include "fusee/pipeline.h"

namespace fusee::pipeline {
namespace {

// Chord error of trial curves, mm. The advised design is built with the requested one.
constexpr double k_trial_chord_error_mm = 0.05;
// Steps of a trial's stroke table, of which only the feasibility is used.
constexpr int k_trial_steps = 36;

}  // namespace

std::vector<profile::Condition> winding_conditions(const Mechanism& mechanism, const std::function<void()>& wind) {
  if (mechanism.pulley.method != Method::paper) return {};
  profile::Condition condition;
  condition.name = "can_be_wound";
  condition.value = condition.limit = 1;
  condition.unit = "1";
  try {
    wind();
  } catch (const InputError& error) {
    condition.ok = false;
    condition.value = 0;
    condition.message =
        "as the paper's equations draw it (pulley.method = \"paper\"), " + error.diagnostics().front().message;
  }
  return {condition};
}

bool design(formats::Product& product, double chord_error_mm, const RunContext& context, solid::TieOffSearch search) {
  const Mechanism& mechanism = product.joint.mechanism;
  context.begin_step("finding both pitch curves");
  profile::SynthesisOptions synthesis_options;
  synthesis_options.chord_error_mm = chord_error_mm;
  // draw_for_making() below compensates the outline's error.
  synthesis_options.drawn_out = -product.joint.outline.offset;
  synthesis_options.advice = false;  // advice is searched for together with the body
  product.synthesis = profile::synthesise(mechanism, synthesis_options);
  if (!product.synthesis.made()) return false;
  joint::draw_for_making(product.synthesis, product.joint.outline);
  product.pulley.conditions = joint::turns_inward_as_drawn(product.synthesis, product.joint.outline);
  if (!product.pulley.conditions.empty()) return false;
  context.begin_step("building the body");
  auto cut_layout = run_async([&] { return formats::layout_to_cut(mechanism, product.synthesis); });
  product.pulley = solid::make_pulley(mechanism, product.synthesis, search);
  product.cut_layout = cut_layout.get();
  if (!product.pulley.made()) return false;
  for (const profile::Condition& condition :
       winding_conditions(mechanism, [&] { rewind_made(product.joint, product.pulley.layout, product.pulley.mesh); })) {
    product.pulley.conditions.push_back(condition);
    if (!condition.ok) product.pulley.status = solid::PulleyStatus::impossible;
  }
  return product.pulley.made();
}

MechanismFile with_declared(MechanismFile file, const Mechanism& changed) {
  static_cast<Mechanism&>(file.mechanism) = changed;
  return file;
}

Curves curves_of(const DeclaredMechanism& declared) {
  Curves curves{joint::identified_joint(declared, joint::LawSearch::brief), {}, {}};
  const Mechanism& mechanism = curves.joint.mechanism;
  if (const auto obstacle = profile::obstacle_to(mechanism)) {
    curves.obstacles = {*obstacle};  // cheap obstacles first, since most trials fail early
    return curves;
  }
  curves.synthesis = profile::synthesise(
      mechanism, {.chord_error_mm = k_trial_chord_error_mm, .advice = false, .stroke_steps = k_trial_steps});
  curves.obstacles = profile::failed_of(curves.synthesis.conditions);
  if (!curves.obstacles.empty()) return curves;
  joint::draw_for_making(curves.synthesis, curves.joint.outline);
  curves.obstacles = joint::turns_inward_as_drawn(curves.synthesis, curves.joint.outline);
  return curves;
}

}  // namespace fusee::pipeline
