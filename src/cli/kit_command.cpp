#include <algorithm>
#include <filesystem>

#include "base/output_list.h"
#include "base/text.h"
#include "cli/as_built.h"
#include "cli/command.h"
#include "fusee/pipeline.h"
#include "mechanism/catalogue.h"

namespace fusee::cli {
namespace {

pipeline::KitOptions kit_options_from(const Arguments& arguments) {
  pipeline::KitOptions options;
  options.chord_error_mm = arguments.number("--tolerance-mm", options.chord_error_mm, 0.0005, 1.0, "mm");
  const std::string version = arguments.text("--dxf").value_or("ac1015");
  if (version != "ac1015" && version != "r12")
    throw UsageError("--dxf must be ac1015 or r12; '" + version + "' is not");
  options.dxf = version == "r12" ? formats::DxfVersion::r12 : formats::DxfVersion::ac1015;
  options.force = arguments.has("--force");
  options.dry_run = arguments.has("--dry-run");
  options.folder = output_folder(arguments, "_kit");
  return options;
}

/// Explains why the pulley is infeasible, as build does.
void explain_no_pulley(const MechanismFile& file, const pipeline::KitOptions& options, const RunContext& context,
                       Reply& reply) {
  pipeline::BuildOptions build_options;
  build_options.chord_error_mm = options.chord_error_mm;
  build_options.dry_run = true;
  build_options.folder = options.folder;
  build_options.force = true;
  const pipeline::BuildResult built = pipeline::build(file, build_options, context.without_progress());
  const bool has_curves = built.product.synthesis.made();
  const std::vector<profile::Condition>& conditions =
      has_curves ? built.product.pulley.conditions : built.product.synthesis.conditions;
  add_obstacles(file.path, conditions, reply);
  add_advice(file.path, built.advice.alone, reply, built.advice.is_exhausted);
  add_advice_together(file.path, built.advice.together, reply);
  add_layout_advice(file.path, built.advice.layout, reply);
  reply.exit = Exit::infeasible;
  reply.fields["conditions"] = to_json(conditions);
  reply.fields["advice"] = to_json(built.advice.alone);
}

std::string motor_words(const kit::KitSizes& sizes) {
  if (!sizes.motor)
    return sizes.motor_name.empty() ? "your own: no motor of the catalogue fits"
                                    : sizes.motor_name + ": its mount is not in the catalogue";
  if (sizes.motor_name == sizes.motor->name) return sizes.motor_name;
  return (sizes.motor_name.empty() ? "none named" : sizes.motor_name) + ": mount as of " + sizes.motor->name +
         " (body.shaft, body.horn)";
}

std::string kit_summary(const pipeline::KitResult& made, const pipeline::KitOptions& options) {
  const formats::KitProduct& product = made.product;
  const kit::KitSizes& sizes = product.plan.sizes;
  int printed = 0;
  for (const kit::KitPart& part : product.plan.parts) printed += part.count;
  const profile::Condition* tightest = nullptr;
  for (const profile::Condition& condition : product.plan.conditions) {
    if (condition.unit == "mm" && (!tightest || condition.value - condition.limit < tightest->value - tightest->limit))
      tightest = &condition;
  }
  std::string text = product.pulley.joint.mechanism.name +
                     (product.plan.drilled ? ": drilling templates for the joint\n" : ": the test rig\n");
  text += "  parts       " + std::to_string(printed) + " to print, of " + std::to_string(product.plan.parts.size()) +
          " kinds; plates to cut in kit.dxf\n";
  if (!product.plan.drilled) {
    text += "  motor       " + motor_words(sizes) + "\n";
    text += "  joint       two bearings " + sizes.bearing->name + ", " + sizes.board->name + " over the axis\n";
  }
  for (const formats::KitCut& cut : formats::kit_cuts(product))
    text += "  tendon " + std::string(cut.side == transmission::Side::left ? "1" : "2") + "    cut at " +
            fixed(cut.cut, 0) + " mm" +
            (cut.longer > 0 ? ", " + fixed(cut.longer, 0) + " mm more than without rig (fusee build)" : "") + "\n";
  if (tightest) {
    std::string name = tightest->name;
    std::replace(name.begin(), name.end(), '_', ' ');
    text += "  clearance   " + fixed(tightest->value, 2) + " mm or more, " + name +
            " (required: " + fixed(tightest->limit, 2) + " mm)\n";
  }
  if (options.dry_run) return text + "  files       none written (--dry-run)\n";
  if (!made.published)
    return text + "  files       none written: " + options.folder.string() + " keeps its earlier run\n";
  return text + "  files       in " + options.folder.string() + ": open kit.html\n";
}

Reply run_kit(const Arguments& arguments, Console&, const RunContext& context) {
  const pipeline::KitOptions options = kit_options_from(arguments);
  const MechanismFile file = read_mechanism(arguments.positionals().front(), arguments.settings(), *context.files);
  const pipeline::KitResult made = pipeline::kit(file, options, context);
  Reply reply;
  reply.diagnostics = made.product.pulley.file.warnings;
  reply.units = file.mechanism.units;
  if (made.ending == pipeline::KitEnding::no_pulley) {
    explain_no_pulley(file, options, context, reply);
    return reply;
  }
  const kit::KitPlan& plan = made.product.plan;
  reply.fields["conditions"] = to_json(plan.conditions);
  if (made.ending == pipeline::KitEnding::no_kit) {
    add_obstacles(file.path, plan.conditions, reply);
    add_advice(file.path, made.advice.alone, reply);
    add_advice_together(file.path, made.advice.together, reply);
    reply.fields["advice"] = to_json(made.advice.alone);
    reply.exit = Exit::infeasible;
    return reply;
  }
  for (const std::string& words : plan.notes) reply.diagnostics.push_back(about_file(Severity::note, file.path, words));
  if (const std::string slack = made.product.bench.plan.slack_words(); !slack.empty())
    reply.diagnostics.push_back(about_file(Severity::note, file.path, slack));
  reply.text = kit_summary(made, options);
  reply.fields["name"] = made.product.pulley.joint.mechanism.name;
  reply.fields["folder"] = options.folder.string();
  reply.fields["published"] = made.published;
  reply.fields["checks"] = to_json(made.product.checks);
  reply.fields["outputs"] = output_list(made.outputs);
  if (made.ending == pipeline::KitEnding::check_failed) {
    reply.exit = Exit::check_failed;
    add_failures(made.product.checks, reply);
  }
  return reply;
}

}  // namespace

Command kit_command() {
  return {"kit",
          "SPEC",
          "the test rig, and how to build it",
          "Designs a test rig for the pulley of SPEC, to build and measure its\n"
          "joint: base plate with pins and the motor's pattern, link with tensioner and\n"
          "scale, spacers, encoder mount, fit coupon. Writes meshes that print without\n"
          "supports, plates to cut, a shopping list, run files, and a page with assembly\n"
          "steps. If parts would collide over the range, it reports which parts, and\n"
          "which number to change.",
          {{"-o,--out", "DIR", "where the files go (default: out/<name of SPEC>_kit)"},
           {"--tolerance-mm", "MM", "tolerance of the pulley's curves (default 0.01)"},
           {"--dxf", "VERSION", "drawings as ac1015 (default) or r12", false, "ac1015 r12"}},
          {{"fusee kit arm.toml", "everything in out/arm_kit; open its kit.html"},
           {"fusee kit arm.toml --dxf r12 -o model", "drawings for an old cutter"},
           {"fusee kit arm.toml --dry-run", "test the fit without writing files"}},
          run_kit};
}

}  // namespace fusee::cli
