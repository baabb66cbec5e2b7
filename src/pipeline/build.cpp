#include <algorithm>
#include <atomic>
#include <cmath>
#include <future>
#include <memory>

#include "analysis/plausibility.h"
#include "base/run_async.h"
#include "export/mesh_files/mesh_files.h"
#include "export/report/report.h"
#include "export/step/step.h"
#include "fusee/export.h"
#include "fusee/joint.h"
#include "fusee/pipeline.h"
#include "pipeline/agreement.h"
#include "pipeline/design.h"
#include "pipeline/layout.h"
#include "pipeline/several_turns.h"
#include "pipeline/thin_walls.h"
#include "solid/print.h"

namespace fusee::pipeline {
namespace {

// Limit of outline points for the full builds of advice. A build of the usual 200 points takes a quarter of a second,
// in proportion to the points (campaign of seed 210002).
constexpr double k_points_for_advice = 1600;

constexpr const char* k_step = "pulley.step";

// Upper bound of our own output files.
constexpr std::size_t k_largest_draco = std::size_t{512} << 20;

/// State of a build: results so far and their staging folder.
struct BuildContext {
  const BuildOptions& options;
  const RunContext& run;
  BuildResult& result;
  OutputFolder& folder;

  void step(std::string_view what) const { run.begin_step(what); }
  void stage(std::string name, std::string bytes) {
    step("writing " + name);
    result.outputs.push_back({std::move(name), std::move(bytes)});
    folder.stage(result.outputs.back());
  }
  Part read_back(const std::string& name) const { return read_part(folder.staged_path(name)); }
  solid::TriangleMesh mesh_of(const std::string& name) const { return std::get<solid::TriangleMesh>(read_back(name)); }
  void add(std::vector<Check> checks, const std::string& prefix = {}) {
    for (Check& check : checks) {
      check.name = prefix + check.name;
      result.product.checks.push_back(std::move(check));
    }
  }
};

void stage_step(BuildContext& context, formats::StepFile file) {
  const bool is_made = !file.bytes.empty();
  context.add({exactly("made", is_made ? 1 : 0, 1, "1", file.complaint)}, "step_");
  if (is_made) context.stage(k_step, std::move(file.bytes));
}

bool has_step(const BuildContext& context) {
  const auto& outputs = context.result.outputs;
  return std::any_of(outputs.begin(), outputs.end(), [](const OutputFile& file) { return file.name == k_step; });
}

/// Writes the files of a helical pulley. It has no plates.dxf: plates cannot contain helical grooves.
formats::DracoFile write_helical_parts(BuildContext& context) {
  const formats::Product& product = context.result.product;
  const solid::TriangleMesh& mesh = product.pulley.mesh;
  const std::string& name = product.file.mechanism.name;
  context.step("writing meshes and drawings");
  auto draco = run_async([&] { return formats::draco_file(mesh, context.options.chord_error_mm); });
  auto profile = run_async([&] { return formats::profile_dxf(product, context.options.dxf); });
  auto threemf = run_async([&] { return formats::threemf_bytes(mesh, name); });
  auto obj = run_async([&] { return formats::obj_text(mesh, name); });
  auto scad = run_async([&] { return formats::scad_text(product); });
  auto step = run_async([&] { return context.options.step ? formats::step_file(product) : formats::StepFile(); },
                        context.options.step);
  context.stage("pulley.stl", formats::stl_bytes(mesh, name));
  context.stage("pulley.obj", obj.get());
  context.stage("pulley.3mf", threemf.get());
  formats::DracoFile file = draco.get();
  context.stage("pulley.drc", file.bytes);
  if (context.options.step) stage_step(context, step.get());
  context.stage("pulley.scad", scad.get());
  context.stage("profile.dxf", profile.get());
  return file;
}

/// Checks a mesh in its print orientation.
std::vector<Check> print_checks(const Print& print, const solid::TriangleMesh& mesh) {
  if (print.supports) return {};
  solid::PrintLimits limits;
  limits.overhang = print.overhang;
  return solid::check_print(mesh, limits);
}

std::vector<Check> draco_checks(const BuildContext& context, const solid::TriangleMesh& mesh,
                                const formats::DracoFile& made) {
  const bool is_unchanged = read_file(context.folder.staged_path("pulley.drc"), k_largest_draco) == made.bytes;
  const Part decoded = is_unchanged ? Part(made.decoded) : context.read_back("pulley.drc");
  std::vector<Check> checks = near_mesh(mesh, std::get<solid::TriangleMesh>(decoded), context.options.chord_error_mm);
  for (const Check& check : is_unchanged ? made.checks : check_part(decoded)) checks.push_back(check);
  return checks;
}

/// Checks that the STEP file is a valid solid, and winds tendons on its floors.
std::vector<Check> step_checks(const BuildContext& context) {
  const formats::Product& product = context.result.product;
  formats::StepInspection look =
      formats::inspect_step(context.folder.staged_path(k_step), product, context.options.chord_error_mm);
  std::vector<Check> checks = std::move(look.checks);
  if (!all_ok(checks)) return checks;
  const profile::RewindResult wound =
      product.helix ? rewind_several_turns(product, look.climbing).result
                    : rewind_floors(product.joint, product.pulley.layout, look.floor1, look.floor2);
  for (Check& check : as_built_checks(product.joint.mechanism, wound, context.options.limits))
    checks.push_back(std::move(check));
  return checks;
}

/// Checks the written file of a printed part, also in its print orientation.
std::vector<Check> checks_of_printed(const BuildContext& context, const solid::PrintedPart& part) {
  const solid::TriangleMesh piece = context.mesh_of(formats::part_file_name(part.side));
  std::vector<Check> checks = solid::check_printed_part(piece, part);
  for (const Check& check : print_checks(context.result.product.joint.mechanism.print, piece)) checks.push_back(check);
  return checks;
}

/// Checks of the written files; each starts as soon as its file is staged. A check that was already made on equal bytes
/// or facets is not repeated.
struct PendingChecks {
  using Checks = std::future<std::vector<Check>>;

  std::shared_future<solid::TriangleMesh> mesh;  ///< from pulley.stl
  Checks pulley_checks, obj_checks, threemf_checks, draco_checks, step_checks, profile_checks, plates_checks;
  std::vector<Checks> printed_checks;
  std::future<profile::RewindResult> as_built;
};

void begin_mesh_checks(PendingChecks& pending, const BuildContext& context) {
  const formats::Product& product = context.result.product;
  const Mechanism& mechanism = product.joint.mechanism;
  pending.mesh = run_async([&context] { return context.mesh_of("pulley.stl"); }).share();
  pending.pulley_checks = run_async([&context, &product, mesh = pending.mesh] {
    return solid::check_pulley(mesh.get(), product.joint.mechanism, product.synthesis, product.pulley,
                               context.options.chord_error_mm);
  });
  pending.as_built = run_async(
      [&product, mesh = pending.mesh] { return rewind_made(product.joint, product.pulley.layout, mesh.get()); });
  if (product.pulley.parts.empty())
    pending.printed_checks.push_back(
        run_async([&mechanism, mesh = pending.mesh] { return print_checks(mechanism.print, mesh.get()); }));
}

/// Writes all part files in order, with parallel threads, and starts their checks.
PendingChecks write_parts(BuildContext& context) {
  formats::Product& product = context.result.product;
  const solid::TriangleMesh& mesh = product.pulley.mesh;
  const std::string& name = product.file.mechanism.name;
  context.step("writing meshes and drawings");
  auto draco = run_async([&] { return formats::draco_file(mesh, context.options.chord_error_mm); });
  auto plates = run_async([&] { return formats::plates_dxf(product, context.options.dxf); });
  auto profile = run_async([&] { return formats::profile_dxf(product, context.options.dxf); });
  auto threemf = run_async([&] { return formats::threemf_bytes(solid::plate_of(product.pulley), name); });
  auto obj = run_async([&] { return formats::obj_text(mesh, name); });
  auto scad = run_async([&] { return formats::scad_text(product); });
  auto holding =
      run_async([&] { return solid::tendon_holding(product.joint.mechanism, product.synthesis, product.pulley); });
  auto step = run_async([&] { return context.options.step ? formats::step_file(product) : formats::StepFile(); },
                        context.options.step);
  PendingChecks pending;
  context.stage("pulley.stl", formats::stl_bytes(mesh, name));
  begin_mesh_checks(pending, context);
  context.stage("pulley.obj", obj.get());
  pending.obj_checks =
      run_async([&context, read = pending.mesh] { return same_mesh(read.get(), context.mesh_of("pulley.obj")); });
  context.stage("pulley.3mf", threemf.get());
  pending.threemf_checks = run_async(
      [&context, &product] { return same_mesh(solid::plate_of(product.pulley), context.mesh_of("pulley.3mf")); });
  for (const solid::PrintedPart& part : product.pulley.parts) {
    context.stage(formats::part_file_name(part.side), formats::stl_bytes(part.mesh, name));
    pending.printed_checks.push_back(run_async([&context, &part] { return checks_of_printed(context, part); }));
  }
  formats::DracoFile file = draco.get();
  context.stage("pulley.drc", file.bytes);
  pending.draco_checks =
      run_async([&context, read = pending.mesh, made = std::make_shared<const formats::DracoFile>(std::move(file))] {
        return draco_checks(context, read.get(), *made);
      });
  if (context.options.step) stage_step(context, step.get());
  context.stage("pulley.scad", scad.get());
  context.stage("profile.dxf", profile.get());
  pending.profile_checks = run_async([&context] { return check_part(context.read_back("profile.dxf")); });
  context.stage("plates.dxf", plates.get());
  pending.plates_checks = run_async([&context] { return check_part(context.read_back("plates.dxf")); });
  product.holding = holding.get();
  const bool is_step = has_step(context);
  pending.step_checks =
      run_async([&context, is_step] { return is_step ? step_checks(context) : std::vector<Check>(); }, is_step);
  return pending;
}

/// Tables that need no check; made while the last checks run.
struct Tables {
  std::future<std::string> profile, p1, p2, transmission;
};
Tables begin_tables(const formats::Product& product) {
  return {run_async([&product] { return formats::profile_csv(product); }),
          run_async([&product] { return formats::pitch_curve_csv(product, transmission::Side::left); }),
          run_async([&product] { return formats::pitch_curve_csv(product, transmission::Side::right); }),
          run_async([&product] { return formats::transmission_csv(product); })};
}

/// Collects the checks.
Tables check_parts(BuildContext& context, PendingChecks& pending) {
  formats::Product& product = context.result.product;
  context.step("checking the written files");
  context.add(pending.pulley_checks.get());
  context.step("winding tendons on it");
  product.as_built = pending.as_built.get();
  context.add(as_built_checks(product.joint.mechanism, product.as_built, context.options.limits));
  Tables tables = begin_tables(product);
  context.step("checking the other files");
  for (std::size_t k = 0; k < product.pulley.parts.size(); ++k)
    context.add(pending.printed_checks[k].get(),
                product.pulley.parts[k].side == transmission::Side::left ? "p1_" : "p2_");
  if (product.pulley.parts.empty()) context.add(pending.printed_checks.front().get());
  context.add(pending.obj_checks.get(), "obj_");
  context.add(pending.threemf_checks.get(), "3mf_");
  context.add(pending.draco_checks.get(), "drc_");
  context.add(pending.step_checks.get(), "step_");
  context.add(pending.profile_checks.get(), "profile_dxf_");
  context.add(pending.plates_checks.get(), "plates_dxf_");
  return tables;
}

Tables check_helical_parts(BuildContext& context, const formats::DracoFile& draco) {
  formats::Product& product = context.result.product;
  const Mechanism& mechanism = product.joint.mechanism;
  context.step("checking the written files");
  const solid::TriangleMesh mesh = context.mesh_of("pulley.stl");
  auto of_draco = run_async([&] { return draco_checks(context, mesh, draco); });
  auto of_3mf = run_async([&] { return same_mesh(mesh, context.mesh_of("pulley.3mf")); });
  auto of_obj = run_async([&] { return same_mesh(mesh, context.mesh_of("pulley.obj")); });
  auto of_profile = run_async([&] { return check_part(context.read_back("profile.dxf")); });
  auto of_pulley = run_async([&] { return check_several_turns(product, mesh); });
  auto of_printing = run_async([&] { return print_checks(mechanism.print, mesh); });
  auto as_built = run_async([&] { return rewind_several_turns(product, mesh); });
  auto of_step =
      run_async([&] { return has_step(context) ? step_checks(context) : std::vector<Check>(); }, context.options.step);
  context.add(of_pulley.get());
  context.step("winding tendons on it");
  product.helix->as_built = as_built.get();
  product.as_built = product.helix->as_built.result;
  context.add(as_built_checks(mechanism, product.as_built, context.options.limits));
  Tables tables = begin_tables(product);
  context.step("checking the other files");
  context.add(of_printing.get());
  context.add(of_obj.get(), "obj_");
  context.add(of_3mf.get(), "3mf_");
  context.add(of_draco.get(), "drc_");
  context.add(of_step.get(), "step_");
  context.add(of_profile.get(), "profile_dxf_");
  return tables;
}

/// A written file that cannot be read back is a bug, not bad input, unless a request to stop has removed it.
template <typename Checking>
Tables check_written(const BuildContext& context, const Checking& run_checks) {
  try {
    return run_checks();
  } catch (const InputError& error) {
    context.run.throw_if_stopped();
    throw Bug(std::string("a written file cannot be read back: ") + error.what());
  }
}

Tables write_and_check_parts(BuildContext& context) {
  if (context.result.product.helix) {
    const formats::DracoFile draco = write_helical_parts(context);
    return check_written(context, [&] { return check_helical_parts(context, draco); });
  }
  PendingChecks pending = write_parts(context);
  return check_written(context, [&] { return check_parts(context, pending); });
}

void write_texts(BuildContext& context, Tables tables) {
  const formats::Product& product = context.result.product;
  context.step("writing tables, report and manifest");
  auto report = run_async([&] { return formats::report_html(product); });
  context.stage("profile.csv", tables.profile.get());
  context.stage("profile_p1.csv", tables.p1.get());
  context.stage("profile_p2.csv", tables.p2.get());
  context.stage("transmission.csv", tables.transmission.get());
  context.stage("report.html", report.get());
  auto manifest = run_async([&] { return formats::manifest_json(product, context.result.outputs); });
  context.stage("manifest.json", manifest.get());
}

bool passes_checks_of_several_turns(const formats::Product& product, const BuildOptions& options) {
  const Mechanism& mechanism = product.joint.mechanism;
  const solid::TriangleMesh& mesh = product.pulley.mesh;
  return all_ok(check_several_turns(product, mesh)) && all_ok(print_checks(mechanism.print, mesh)) &&
         all_ok(as_built_checks(mechanism, rewind_several_turns(product, mesh).result, options.limits));
}

/// Designs curves, body and plates in memory and runs the checks that a design can fail.
bool passes_checks(const MechanismFile& file, const BuildOptions& options, const RunContext& context) {
  formats::Product product;
  product.file = file;
  product.joint = joint::as_it_is(file.mechanism);
  if (!design_any(product, options.chord_error_mm, options.limits, context, solid::TieOffSearch::brief)) return false;
  if (product.helix) return passes_checks_of_several_turns(product, options);
  const Mechanism& mechanism = product.joint.mechanism;
  const solid::TriangleMesh& mesh = product.pulley.mesh;
  context.throw_if_stopped();
  auto of_plates = run_async([&] {
    const std::string drawing = formats::plates_dxf(product, options.dxf);
    return all_ok(check_part(formats::read_dxf(drawing, "plates.dxf")));
  });
  auto of_printing = run_async([&] {
    if (product.pulley.parts.empty()) return all_ok(print_checks(mechanism.print, mesh));
    return std::all_of(product.pulley.parts.begin(), product.pulley.parts.end(), [&](const solid::PrintedPart& part) {
      return all_ok(print_checks(mechanism.print, part.mesh));
    });
  });
  const bool is_right =
      all_ok(solid::check_pulley(mesh, mechanism, product.synthesis, product.pulley, options.chord_error_mm)) &&
      all_ok(as_built_checks(mechanism, rewind_made(product.joint, product.pulley.layout, mesh), options.limits));
  const bool prints = of_printing.get();
  return of_plates.get() && prints && is_right;
}

/// Bad input and parts on which no tendon can be wound are not feasible.
bool is_made(const MechanismFile& file, const BuildOptions& options, const RunContext& context) {
  try {
    return passes_checks(file, options, context);
  } catch (const InputError&) {
    return false;
  }
}

/// Quick feasibility check of small variants of a file: curves and body without a mesh. A variant of the body alone
/// reuses the file's curves.
class FeasibilityCheck {
 public:
  FeasibilityCheck(const formats::Product& refused, const BuildOptions& options, const RunContext& context)
      : file_(refused.file),
        options_(options),
        context_(context),
        own_(curves_of(refused.file.mechanism)),
        own_points_(static_cast<double>(refused.synthesis.p1.points.size())) {}

  std::vector<profile::Condition> operator()(const Mechanism& changed) const {
    context_.throw_if_stopped();
    if (!has_own_curves(changed)) return obstacles(curves_of(with_declared(file_, changed).mechanism));
    Curves curves = own_;
    curves.joint.mechanism.body = changed.body;
    curves.joint.mechanism.horn = changed.horn;
    curves.joint.mechanism.print = changed.print;
    return obstacles(curves);
  }

  /// Number of full builds for which the largest variant leaves time.
  int max_builds() const {
    const double turn = std::min(radians(2.0), std::sqrt(8.0 * options_.chord_error_mm / largest_));
    const double points = std::max(k_two_pi / turn, own_points_);
    return std::max(1, static_cast<int>(k_points_for_advice / points));
  }

 private:
  /// The flange's radius determines the chord length of the curves.
  bool has_own_curves(const Mechanism& changed) const {
    if (changed.groove_depth() != file_.mechanism.groove_depth()) return false;
    Mechanism with_own_body = changed;
    with_own_body.body = file_.mechanism.body;
    with_own_body.horn = file_.mechanism.horn;
    with_own_body.print = file_.mechanism.print;
    return with_own_body == static_cast<const Mechanism&>(file_.mechanism);
  }

  std::vector<profile::Condition> obstacles(const Curves& curves) const {
    if (!curves.obstacles.empty()) return curves.obstacles;
    const Mechanism& mechanism = curves.joint.mechanism;
    const profile::SynthesisResult& synthesis = curves.synthesis;
    const auto of_body = solid::body_obstacles(mechanism, synthesis);
    if (!of_body.empty()) return of_body;
    for (const profile::Outline* outline : {&synthesis.p1, &synthesis.p2}) {
      for (const profile::OutlinePoint& point : outline->points) record_size(point.position.norm());
    }
    const auto floor = [&mechanism](const profile::Outline& outline) {
      return profile::parallel(outline, -0.5 * mechanism.tendon.diameter);
    };
    return profile::failed_of(
        windable(mechanism, [&] { profile::rewind(mechanism, floor(synthesis.p1), floor(synthesis.p2)); }));
  }

  void record_size(double reach) const {
    double known = largest_;
    while (reach > known && !largest_.compare_exchange_weak(known, reach)) {
    }
  }

  const MechanismFile& file_;
  const BuildOptions& options_;
  const RunContext& context_;
  Curves own_;
  double own_points_;  ///< of an outline as it would be made, 0 where there is none
  /// Largest distance of an outline from the axis among the trials with room for a body, mm.
  mutable std::atomic<double> largest_ = 0;
};

/// The keys of --set.
std::vector<std::string> typed_keys(const MechanismFile& file) {
  std::vector<std::string> keys;
  for (const auto& [key, place] : file.places) {
    if (place.file.starts_with("--set")) keys.push_back(key);
  }
  return keys;
}

profile::Advice advice_for(const formats::Product& product, const BuildOptions& options, const RunContext& context) {
  const MechanismFile& file = product.file;
  if (product.helix) {
    const auto made = [&](const Mechanism& changed) { return is_made(with_declared(file, changed), options, context); };
    return advice_for_several_turns(product, {options.chord_error_mm, made, context});
  }
  const FeasibilityCheck check(product, options, context);
  std::atomic<int> begun = 0;
  const profile::FeasibilityOracle judge{.obstacles = [&](const Mechanism& changed) { return check(changed); },
                                         .made =
                                             [&](const Mechanism& changed) {
                                               ++begun;
                                               return is_made(with_declared(file, changed), options, context);
                                             },
                                         .builds_left = [&] { return check.max_builds() - begun; },
                                         .first = typed_keys(file)};
  return solid::body_advice(file.mechanism, judge, product.pulley.layout.parts);
}

void write_and_check(BuildContext& context) {
  Tables tables = write_and_check_parts(context);
  formats::Product& product = context.result.product;
  for (Diagnostic& thin : walls_below_a_line(product)) product.file.warnings.push_back(std::move(thin));
  write_texts(context, std::move(tables));
  context.result.status = all_ok(context.result.product.checks) ? BuildStatus::done : BuildStatus::check_failed;
}

}  // namespace

const std::vector<std::string>& output_names() {
  static const std::vector<std::string> names = {
      "pulley.stl",     "pulley_p1.stl",    "pulley_p2.stl", "pulley.obj",   "pulley.3mf",  "pulley.drc",
      k_step,           "pulley.scad",      "profile.dxf",   "plates.dxf",   "profile.csv", "profile_p1.csv",
      "profile_p2.csv", "transmission.csv", "report.html",   "manifest.json"};
  return names;
}

BuildResult build(const MechanismFile& file, const BuildOptions& options, const RunContext& context) {
  BuildResult result;
  result.product.file = file;
  auto warned = run_async([&file] { return analysis::plausibility_warnings(file); });
  result.product.joint = joint::as_it_is(file.mechanism);
  OutputFolder target(options.folder, options.force, context);
  if (const auto why = options.step ? formats::step_missing() : std::nullopt)
    throw InputError("", "no pulley.step: this fusee was built without STEP: " + *why, "build without --step");
  target.claim(output_names());  // before the work: a refusal should not cost a wait
  const bool is_possible = design_any(result.product, options.chord_error_mm, options.limits, context);
  for (Diagnostic& warning : warned.get()) result.product.file.warnings.push_back(std::move(warning));
  if (!is_possible) {
    result.status = BuildStatus::infeasible;
    if (!options.advice) return result;
    context.begin_step("looking for what would make it possible");
    result.advice = advice_for(result.product, options, context.without_progress());
    result.advice.layout = drum_advice(file, options, context.without_progress());
    return result;
  }
  if (!result.product.helix) {
    for (Diagnostic& unused : unused_turn_keys(file)) result.product.file.warnings.push_back(std::move(unused));
  }
  if (options.dry_run) {
    OutputFolder staging = OutputFolder::temporary(context);
    BuildContext dry_run{options, context, result, staging};
    write_and_check(dry_run);
    return result;
  }
  BuildContext published{options, context, result, target};
  write_and_check(published);
  const bool may_publish = result.status == BuildStatus::done || !target.has_earlier_run() || options.force;
  if (!may_publish) return result;
  context.begin_step("publishing");
  // pulley_p1.stl of an earlier run does not belong to a pulley in one piece.
  target.withdraw(output_names());
  target.publish(result.product.file.warnings);
  result.published = true;
  return result;
}

}  // namespace fusee::pipeline
