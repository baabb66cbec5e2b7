#include <algorithm>
#include <cmath>

#include "analysis/plausibility.h"
#include "base/text.h"
#include "base/thread_pool.h"
#include "export/mesh_files/mesh_files.h"
#include "fusee/joint.h"
#include "fusee/pipeline.h"
#include "pipeline/agreement.h"
#include "pipeline/design.h"
#include "pipeline/law_table_copy.h"
#include "pipeline/multi_turn.h"
#include "pipeline/shaft_reach.h"
#include "solid/print.h"

namespace fusee::pipeline {
namespace {

/// A written file that cannot be read back is a bug, not bad input.
solid::TriangleMesh read_back(const OutputFile& file) {
  try {
    return formats::read_mesh(file.bytes, file.name);
  } catch (const InputError& error) {
    throw Bug(std::string("a written file cannot be read back: ") + error.what());
  }
}

/// Files of a part, and the checks of them.
struct CheckedPart {
  std::vector<OutputFile> files;
  std::vector<Check> checks;
};

CheckedPart make_part(const kit::KitPart& part, const formats::KitProduct& product) {
  const Mechanism& mechanism = product.pulley.joint.mechanism;
  const solid::BodyLayout& layout = product.pulley.pulley.layout;
  const solid::TriangleMesh mesh = kit::printed_mesh(part, mechanism, layout);
  const std::string name = mechanism.name + ", " + part.name;
  CheckedPart result;
  result.files = {
      {formats::kit_file_name(part, "stl"), formats::stl_bytes(mesh, name)},
      {formats::kit_file_name(part, "3mf"), formats::threemf_bytes(mesh, name, product.pulley.mechanism_files)}};
  const solid::TriangleMesh written = read_back(result.files[0]);
  result.checks = solid::check_mesh(written);
  // Rounding moves a corner by up to half of a float's last digit. The volume changes by that distance times the area.
  const double volume = kit::printed_volume(part, mechanism, layout);
  result.checks.push_back(at_most("volume_error", std::abs(solid::enclosed_volume(written) / volume - 1), 1e-4, "1"));
  if (!mechanism.print.supports) {
    solid::PrintLimits limits;
    limits.overhang = mechanism.print.overhang;
    for (Check& check : solid::check_print(written, limits)) result.checks.push_back(std::move(check));
  }
  for (Check& check : same_mesh(mesh, read_back(result.files[1]))) {
    check.name = "3mf_" + check.name;
    result.checks.push_back(std::move(check));
  }
  for (Check& check : result.checks) check.name = part.name + "_" + check.name;
  return result;
}

void make_files(KitResult& result, const KitOptions& options, const RunContext& context) {
  formats::KitProduct& product = result.product;
  context.begin_step("building parts");
  auto drawing = run_async([&] { return formats::kit_dxf(product, options.dxf); });
  std::vector<Task<CheckedPart>> parts;
  for (const kit::KitPart& part : product.plan.parts)
    parts.push_back(run_async([&] { return make_part(part, product); }));
  product.checks = kit_fit_checks(product.plan);
  for (auto& part : parts) {
    CheckedPart one = part.get();
    result.outputs.insert(result.outputs.end(), one.files.begin(), one.files.end());
    product.checks.insert(product.checks.end(), one.checks.begin(), one.checks.end());
  }
  result.outputs.push_back({"kit.dxf", drawing.get()});
  for (Check& check : formats::check_drawing(formats::read_dxf(result.outputs.back().bytes, "kit.dxf"))) {
    check.name = "kit_dxf_" + check.name;
    product.checks.push_back(std::move(check));
  }
  context.begin_step("writing the page");
  result.outputs.push_back({"bom.csv", formats::bom_csv(product)});
  result.outputs.push_back({"kit.html", formats::kit_html(product)});
  for (std::size_t i = 0; i < product.bench.plan.steps.size(); ++i) {
    if (product.bench.plan.steps[i].run)
      result.outputs.push_back({formats::run_file_name(product.bench.plan, i), formats::run_csv(product.bench, i)});
  }
  result.outputs.push_back({"manifest.json", formats::kit_manifest_json(product, result.outputs)});
}

/// Obstacles of curves, body or rig.
std::vector<profile::Condition> obstacles_to_kit(const DeclaredMechanism& declared) {
  const Curves curves = curves_of(declared);
  if (!curves.obstacles.empty()) return curves.obstacles;
  const Mechanism& mechanism = curves.joint.mechanism;
  if (const auto of_body = solid::body_obstacles(mechanism, curves.synthesis); !of_body.empty()) return of_body;
  return profile::failed_of(
      kit::plan_kit(mechanism, curves.synthesis, solid::resolve_layout(mechanism, curves.synthesis)).conditions);
}

kit::KitPlan plan_of(const formats::Product& pulley) {
  if (pulley.helix) return kit::plan_kit_of_turns(pulley.joint.mechanism, pulley.pulley.layout, tendon_heights(pulley));
  return kit::plan_kit(pulley.joint.mechanism, pulley.synthesis, pulley.pulley.layout);
}

/// True if a file with the advised, rounded numbers has a rig. A number that makes the file bad input is infeasible.
bool has_kit(const MechanismFile& file, double chord_error_mm, const RunContext& context) {
  try {
    formats::Product pulley;
    pulley.file = file;
    pulley.joint = joint::identified_joint(file.mechanism);
    return design_any(pulley, chord_error_mm, {}, context, solid::TieOffSearch::brief) && plan_of(pulley).made();
  } catch (const InputError&) {
    return false;
  }
}

/// Changes with which the rig of a feasible pulley has no collisions.
profile::Advice advice_for_kit(const MechanismFile& file, const formats::KitProduct& product, const KitOptions& options,
                               const RunContext& context) {
  const kit::KitPlan& plan = product.plan;
  const profile::FeasibilityOracle judge{
      .obstacles =
          [&](const Mechanism& changed) {
            context.throw_if_stopped();
            if (!plan.heights) return obstacles_to_kit(with_declared(file, changed).mechanism);
            return profile::failed_of(
                kit::plan_kit_of_turns(changed, product.pulley.pulley.layout, *plan.heights).conditions);
          },
      .made =
          [&](const Mechanism& changed) {
            return has_kit(with_declared(file, changed), options.chord_error_mm, context);
          }};
  profile::Advice advice = profile::find_advice(file.mechanism, judge, {"body.flange_thickness_mm"});
  // Steps are relative, so none leaves a pin radius of 0.
  if (Mechanism thicker = file.mechanism; thicker.guides.radius == 0) {
    thicker.guides.radius = kit::k_least_pin;
    const std::string radius = shortest(kit::k_least_pin);
    if (judge.made(thicker))
      advice.alone.push_back({"guides.radius_mm", 0, kit::k_least_pin, "mm", "guides.radius_mm ≥ " + radius + " mm"});
  }
  return advice;
}

constexpr int k_most_kit_runs = 99;  ///< run files that an earlier kit may have written

/// Files that a rig may have: those of an earlier rig that this one lacks are withdrawn.
std::vector<std::string> kit_names() {
  std::vector<std::string> names{"kit.dxf", "bom.csv", "kit.html", "manifest.json"};
  for (const std::string_view part : kit::k_kit_part_names) {
    for (const char* ending : {".stl", ".3mf"}) names.push_back(std::string(part) + ending);
  }
  for (int i = 1; i <= k_most_kit_runs; ++i) names.push_back("run_" + std::to_string(i) + ".csv");
  return names;
}

/// Warning about a set screw that the shaft of the motor below the plate does not reach.
std::optional<Diagnostic> screw_beyond_shaft(const formats::KitProduct& product, double chord_error_mm,
                                             const RunContext& context) {
  const kit::KitSizes& sizes = product.plan.sizes;
  const double below = product.plan.drilled ? kit::k_template_plate : sizes.base + sizes.pulley_low;
  return shaft_reach_warning(product.pulley, below, [&](const Mechanism& changed) -> std::optional<formats::Product> {
    formats::Product pulley;
    pulley.file = with_declared(product.pulley.file, changed);
    pulley.joint = joint::identified_joint(pulley.file.mechanism);
    if (!design_any(pulley, chord_error_mm, {}, context, solid::TieOffSearch::brief)) return std::nullopt;
    return pulley;
  });
}

}  // namespace

std::vector<Check> kit_fit_checks(const kit::KitPlan& plan) {
  std::vector<Check> checks;
  for (const profile::Condition& condition : plan.conditions)
    checks.push_back(
        at_least("fit_" + condition.name, condition.value, condition.limit, condition.unit, condition.message));
  return checks;
}

KitResult kit(const MechanismFile& file, const KitOptions& options, const RunContext& context) {
  KitResult result;
  formats::KitProduct& product = result.product;
  product.pulley.file = analysis::with_plausibility_warnings(file);
  product.pulley.joint = joint::identified_joint(file.mechanism);
  OutputFolder target(options.folder, options.force, context);
  // Before the work, so that a refusal costs no time.
  target.claim({"kit.dxf", "bom.csv", "kit.html", "manifest.json"});
  product.pulley.mechanism_files = mechanism_files(file, *context.files);
  if (!design_any(product.pulley, options.chord_error_mm, {}, context)) {
    result.ending = KitEnding::no_pulley;
    return result;
  }
  const Mechanism& mechanism = product.pulley.joint.mechanism;
  context.begin_step("placing parts");
  product.plan = plan_of(product.pulley);
  if (!product.plan.made()) {
    result.ending = KitEnding::no_kit;
    context.begin_step("searching for changes that avoid collisions");
    result.advice = advice_for_kit(file, product, options, context.without_progress());
    return result;
  }
  if (const auto missed = screw_beyond_shaft(product, options.chord_error_mm, context.without_progress())) {
    product.plan.warnings.push_back(missed->message + (missed->hint.empty() ? "" : ": " + missed->hint));
    product.pulley.file.warnings.push_back(*missed);
  }
  const plan::PlanOptions bench;
  auto planned = run_async([&] { return plan::plan_runs(file.mechanism, bench, context.without_progress()); });
  target.claim(kit_names());
  if (!product.pulley.helix)
    product.pulley.holding = solid::tendon_holding(mechanism, product.pulley.synthesis, product.pulley.pulley);
  product.bench = {product.pulley.file, bench.noise, bench.minutes, planned.get()};
  make_files(result, options, context);
  result.ending = all_ok(product.checks) ? KitEnding::done : KitEnding::check_failed;
  if (options.dry_run) return result;
  if (result.ending != KitEnding::done && target.has_earlier_run() && !options.force) return result;
  context.begin_step("publishing");
  for (const OutputFile& output : result.outputs) target.stage(output);
  target.withdraw(kit_names());
  target.publish(product.pulley.file.warnings);
  result.published = true;
  return result;
}

}  // namespace fusee::pipeline
