#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <memory>
#include <mutex>

#include "analysis/plausibility.h"
#include "base/thread_pool.h"
#include "export/mesh_files/mesh_files.h"
#include "export/report/report.h"
#include "export/step/step.h"
#include "fusee/export.h"
#include "fusee/joint.h"
#include "fusee/pipeline.h"
#include "pipeline/agreement.h"
#include "pipeline/axle_clearance.h"
#include "pipeline/design.h"
#include "pipeline/law_table_copy.h"
#include "pipeline/layout.h"
#include "pipeline/motor_advice.h"
#include "pipeline/multi_turn.h"
#include "pipeline/omissions.h"
#include "pipeline/shaft_reach.h"
#include "pipeline/thin_walls.h"
#include "pipeline/wide_parts.h"
#include "solid/print.h"

namespace fusee::pipeline {
namespace {

// Limit on the sum of outline points over all full builds for one piece of advice. A build takes a quarter of a second
// with the usual 200 points, and proportionally more with more points.
constexpr double k_points_for_advice = 1600;

constexpr const char* k_step_name = "pulley.step";

// Upper bound on the size of the written pulley.drc, bytes.
constexpr std::size_t k_largest_draco = std::size_t{512} << 20;

/// State of a build: results so far and their staging folder.
struct BuildContext {
  const BuildOptions& options;
  const RunContext& run;
  BuildResult& result;
  OutputFolder& folder;

  void step(std::string_view name) const { run.begin_step(name); }
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
  if (is_made) context.stage(k_step_name, std::move(file.bytes));
}

bool has_step(const BuildContext& context) {
  const auto& outputs = context.result.outputs;
  return std::any_of(outputs.begin(), outputs.end(), [](const OutputFile& file) { return file.name == k_step_name; });
}

/// Writes the part files of a helical pulley. It has no plates.dxf: plates cannot contain helical grooves.
formats::DracoFile write_helical_parts(BuildContext& context) {
  const formats::Product& product = context.result.product;
  const solid::TriangleMesh& mesh = product.pulley.mesh;
  const std::string& name = product.file.mechanism.name;
  context.step("writing meshes and drawings");
  auto draco = run_async([&] { return formats::draco_file(mesh, context.options.chord_error_mm); });
  auto profile = run_async([&] { return formats::profile_dxf(product, context.options.dxf); });
  auto threemf = run_async([&] { return formats::threemf_bytes(mesh, name, product.mechanism_files); });
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
  formats::StepInspection inspection =
      formats::inspect_step(context.folder.staged_path(k_step_name), product, context.options.chord_error_mm);
  std::vector<Check> checks = std::move(inspection.checks);
  if (!all_ok(checks)) return checks;
  const profile::RewindResult wound =
      product.helix ? rewind_multi_turn(product, inspection.helical).result
                    : rewind_floors(product.joint, product.pulley.layout, inspection.floor1, inspection.floor2);
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

/// Running checks of the written files; each starts as soon as its file is staged. No check is repeated on equal bytes
/// or facets: pulley.obj and pulley.3mf are compared with a checked mesh, and pulley.drc is decoded again only if its
/// bytes are not those that formats::draco_file() has decoded and checked.
struct PendingChecks {
  using Checks = Task<std::vector<Check>>;

  std::shared_ptr<const Task<solid::TriangleMesh>> mesh;  ///< from pulley.stl
  Checks pulley_checks, obj_checks, threemf_checks, draco_checks, step_checks, profile_checks, plates_checks;
  std::vector<Checks> printed_checks;
  Task<profile::RewindResult> as_built;
};

void begin_mesh_checks(PendingChecks& pending, const BuildContext& context) {
  const formats::Product& product = context.result.product;
  const Mechanism& mechanism = product.joint.mechanism;
  auto read = run_async([&context] { return context.mesh_of("pulley.stl"); });
  pending.mesh = std::make_shared<const Task<solid::TriangleMesh>>(std::move(read));
  pending.pulley_checks = run_async([&context, &product, mesh = pending.mesh] {
    return solid::check_pulley(mesh->value(), product.joint.mechanism, product.synthesis, product.pulley,
                               context.options.chord_error_mm);
  });
  pending.as_built = run_async(
      [&product, mesh = pending.mesh] { return rewind_made(product.joint, product.pulley.layout, mesh->value()); });
  if (product.pulley.parts.empty())
    pending.printed_checks.push_back(
        run_async([&mechanism, mesh = pending.mesh] { return print_checks(mechanism.print, mesh->value()); }));
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
  auto threemf =
      run_async([&] { return formats::threemf_bytes(solid::plate_of(product.pulley), name, product.mechanism_files); });
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
      run_async([&context, read = pending.mesh] { return same_mesh(read->value(), context.mesh_of("pulley.obj")); });
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
        return draco_checks(context, read->value(), *made);
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
  Task<std::string> profile, p1, p2, transmission;
};
Tables begin_tables(const formats::Product& product) {
  return {run_async([&product] { return formats::profile_csv(product); }),
          run_async([&product] { return formats::pitch_curve_csv(product, transmission::Side::left); }),
          run_async([&product] { return formats::pitch_curve_csv(product, transmission::Side::right); }),
          run_async([&product] { return formats::transmission_csv(product); })};
}

/// Collects the checks, and starts the tables.
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
  auto of_pulley = run_async([&] { return check_multi_turn(product, mesh); });
  auto of_printing = run_async([&] { return print_checks(mechanism.print, mesh); });
  auto as_built = run_async([&] { return rewind_multi_turn(product, mesh); });
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

/// Runs the checks of written files. A written file that cannot be read back is a bug, not bad input, unless a request
/// to stop has removed it.
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
  for (const OutputFile& file : product.mechanism_files) context.stage(file.name, file.bytes);
  context.stage("report.html", report.get());
  auto manifest = run_async([&] { return formats::manifest_json(product, context.result.outputs); });
  context.stage("manifest.json", manifest.get());
}

bool passes_multi_turn_checks(const formats::Product& product, const BuildOptions& options) {
  const Mechanism& mechanism = product.joint.mechanism;
  const solid::TriangleMesh& mesh = product.pulley.mesh;
  return all_ok(check_multi_turn(product, mesh)) && all_ok(print_checks(mechanism.print, mesh)) &&
         all_ok(as_built_checks(mechanism, rewind_multi_turn(product, mesh).result, options.limits));
}

/// Designs curves, body and plates in memory and runs the checks that a design can fail.
bool passes_checks(formats::Product& product, const BuildOptions& options, const RunContext& context) {
  product.joint = joint::identified_joint(product.file.mechanism);
  if (!design_any(product, options.chord_error_mm, options.limits, context, solid::TieOffSearch::brief)) return false;
  if (product.helix) return passes_multi_turn_checks(product, options);
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
  const bool is_sound =
      all_ok(solid::check_pulley(mesh, mechanism, product.synthesis, product.pulley, options.chord_error_mm)) &&
      all_ok(as_built_checks(mechanism, rewind_made(product.joint, product.pulley.layout, mesh), options.limits));
  const bool is_printable = of_printing.get();
  return of_plates.get() && is_printable && is_sound;
}

/// The product of a file if it passes all checks. Bad input and parts on which no tendon can be wound do not pass.
std::optional<formats::Product> passing_product(const MechanismFile& file, const BuildOptions& options,
                                                const RunContext& context) {
  formats::Product product;
  product.file = file;
  try {
    if (passes_checks(product, options, context)) return product;
  } catch (const InputError&) {
  }
  return std::nullopt;
}

bool is_made(const MechanismFile& file, const BuildOptions& options, const RunContext& context) {
  return passing_product(file, options, context).has_value();
}

/// Quick feasibility check of small variants of a file: curves and body without a mesh. A variant of the body alone
/// reuses the file's curves.
class FeasibilityCheck {
 public:
  /// `with_motor`: the mechanism's motor must suffice, too.
  FeasibilityCheck(const formats::Product& refused, const BuildOptions& options, const RunContext& context,
                   bool with_motor)
      : with_motor_(with_motor),
        file_(refused.file),
        options_(options),
        context_(context),
        refused_curves_(curves_of(refused.file.mechanism)),
        refused_points_(static_cast<double>(refused.synthesis.p1.points.size())) {}

  std::vector<profile::Condition> operator()(const Mechanism& changed) const {
    context_.throw_if_stopped();
    if (!has_refused_curves(changed)) return obstacles(curves_of(with_declared(file_, changed).mechanism));
    Curves curves = refused_curves_;
    curves.joint.mechanism.body = changed.body;
    curves.joint.mechanism.horn = changed.horn;
    curves.joint.mechanism.print = changed.print;
    return obstacles(curves);
  }

  /// Number of full builds that keep within k_points_for_advice, estimated from the largest variant.
  int max_builds() const {
    // A chord over the angle φ of a circle of radius r has the error r φ² / 8. Facets turn by 2° at most.
    const double turn = std::min(radians(2.0), std::sqrt(8.0 * options_.chord_error_mm / largest_reach_));
    const double points = std::max(k_two_pi / turn, refused_points_);
    return std::max(1, static_cast<int>(k_points_for_advice / points));
  }

 private:
  /// True if only the body differs from the refused design. The groove depth counts as well, since the flange's radius
  /// determines the chord length of the curves.
  bool has_refused_curves(const Mechanism& changed) const {
    if (changed.groove_depth() != file_.mechanism.groove_depth()) return false;
    Mechanism with_refused_body = changed;
    with_refused_body.body = file_.mechanism.body;
    with_refused_body.horn = file_.mechanism.horn;
    with_refused_body.print = file_.mechanism.print;
    return with_refused_body == static_cast<const Mechanism&>(file_.mechanism);
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
    const auto not_wound = profile::failed_of(
        winding_conditions(mechanism, [&] { profile::rewind(mechanism, floor(synthesis.p1), floor(synthesis.p2)); }));
    return not_wound.empty() && with_motor_ ? analysis::motor_obstacles(mechanism) : not_wound;
  }

  /// Raises largest_reach_ to `reach`; called by several threads.
  void record_size(double reach) const {
    double known = largest_reach_;
    while (reach > known && !largest_reach_.compare_exchange_weak(known, reach)) {
    }
  }

  bool with_motor_;
  const MechanismFile& file_;
  const BuildOptions& options_;
  const RunContext& context_;
  Curves refused_curves_;
  double refused_points_;  ///< points of the refused design's outline; 0 without an outline
  /// Largest distance of an outline from the axis among the trials with room for a body, mm.
  mutable std::atomic<double> largest_reach_ = 0;
};

bool motor_suffices(const MechanismFile& file) {
  return analysis::motor_obstacles(joint::identified_joint(file.mechanism).mechanism).empty();
}

/// The keys that --set states: advice on them comes first.
std::vector<std::string> typed_keys(const MechanismFile& file) {
  std::vector<std::string> keys;
  for (const auto& [key, place] : file.places) {
    if (place.file.starts_with("--set")) keys.push_back(key);
  }
  return keys;
}

profile::Advice advice_for(const formats::Product& product, const BuildOptions& options, const RunContext& context) {
  const MechanismFile& file = product.file;
  const bool with_motor = file.mechanism.motor.enforce;
  const auto made = [&](const Mechanism& changed) {
    const MechanismFile trial = with_declared(file, changed);
    return is_made(trial, options, context) && (!with_motor || motor_suffices(trial));
  };
  if (product.helix) {
    return multi_turn_advice(product, {options.chord_error_mm, made, context});
  }
  const FeasibilityCheck check(product, options, context, with_motor);
  std::atomic<int> begun = 0;
  const profile::FeasibilityOracle judge{.obstacles = [&](const Mechanism& changed) { return check(changed); },
                                         .made =
                                             [&](const Mechanism& changed) {
                                               ++begun;
                                               return made(changed);
                                             },
                                         .builds_left = [&] { return check.max_builds() - begun; },
                                         .first = typed_keys(file)};
  return solid::body_advice(file.mechanism, judge, product.pulley.layout.parts);
}

/// Adds the warnings about a motor that does not suffice, with advice.
void compare_with_motor(BuildContext& context) {
  formats::Product& product = context.result.product;
  if (!product.under_load.motor) return;
  if (context.options.advice && !product.under_load.motor->ok()) {
    context.step("searching for changes that suit the motor");
    product.under_load.motor->advice = motor_advice(product, context.options, context.run.without_progress());
  }
  for (Diagnostic& warning : analysis::motor_warnings(*product.under_load.motor, product.file))
    product.file.warnings.push_back(std::move(warning));
}

std::vector<std::string> names_with_table(const Mechanism& mechanism) {
  std::vector<std::string> names = output_names();
  if (const auto table = law_table_name(mechanism)) names.push_back(*table);
  return names;
}

/// Throws OutputError if mechanism.toml would replace the file that was read by one with other numbers.
void demand_other_place(const MechanismFile& file, const BuildOptions& options) {
  std::error_code error;
  const std::filesystem::path written = options.folder / "mechanism.toml";
  if (options.dry_run || file.settings.empty() || !std::filesystem::equivalent(written, file.path, error)) return;
  throw OutputError(written.string() + " is the mechanism file itself, which --set would change",
                    "choose another folder with -o");
}

/// Additional tendon lengths for the test rig, which has a tensioner and a post. Empty for drilling templates.
std::optional<std::array<kit::KitTendon, 2>> rig_of(const formats::Product& product) {
  if (product.helix) return std::nullopt;
  const kit::KitPlan plan = kit::plan_kit(product.joint.mechanism, product.synthesis, product.pulley.layout);
  if (!plan.made() || plan.drilled) return std::nullopt;
  return plan.tendons;
}

std::vector<std::string> advised_notes(const formats::Product& product, const BuildOptions& options,
                                       const RunContext& context) {
  if (!options.advice) return product.pulley.layout.notes;
  const BuildOmissions build = [&](const Mechanism& changed) -> std::optional<BuiltTrial> {
    const auto trial = passing_product(with_declared(product.file, changed), options, context);
    if (!trial) return std::nullopt;
    BuiltTrial built;
    for (const solid::Omission& omission : trial->pulley.layout.omissions) built.omitted.push_back(omission.feature);
    built.cost = costs(*trial, product);
    return built;
  };
  return notes_with_advice(product, build, context);
}

/// Notes about omissions of the plates, for a file that declares a cutter. Others are printed.
std::vector<std::string> plate_notes(const formats::Product& product) {
  const auto is_of_cut = [](const auto& entry) { return entry.first.starts_with("cut."); };
  std::vector<std::string> notes;
  if (product.helix || std::none_of(product.file.places.begin(), product.file.places.end(), is_of_cut)) return notes;
  for (const std::string& omission : formats::plate_omissions(product)) notes.push_back("plates.dxf: " + omission);
  return notes;
}

std::vector<Diagnostic> parts_in_the_way(const formats::Product& product, const BuildOptions& options,
                                         const RunContext& context) {
  return axle_clearance_warnings(product, [&](const Mechanism& changed) {
    return options.advice ? passing_product(with_declared(product.file, changed), options, context) : std::nullopt;
  });
}

std::optional<Diagnostic> screw_beyond_shaft(const formats::Product& product, const BuildOptions& options,
                                             const RunContext& context) {
  return shaft_reach_warning(product, 0, [&](const Mechanism& changed) {
    return options.advice ? passing_product(with_declared(product.file, changed), options, context) : std::nullopt;
  });
}

void write_and_check(BuildContext& context) {
  formats::Product& product = context.result.product;
  product.rig = rig_of(product);
  const RunContext trials = context.run.without_progress();
  auto notes = run_async([&] { return advised_notes(product, context.options, trials); });
  auto of_plates = run_async([&] { return plate_notes(product); });
  auto in_the_way = run_async([&] { return parts_in_the_way(product, context.options, trials); });
  auto beyond_shaft = run_async([&] { return screw_beyond_shaft(product, context.options, trials); });
  auto loaded = run_async([&joint = product.joint] { return analysis::under_load(joint.mechanism); });
  Tables tables = write_and_check_parts(context);
  std::vector<std::string> omissions = of_plates.get();
  product.pulley.layout.notes = notes.get();
  std::move(omissions.begin(), omissions.end(), std::back_inserter(product.pulley.layout.notes));
  for (Diagnostic& part : in_the_way.get()) product.file.warnings.push_back(std::move(part));
  if (auto missed = beyond_shaft.get()) product.file.warnings.push_back(std::move(*missed));
  product.under_load = loaded.get();
  if (auto lost = analysis::no_equilibrium(product.under_load)) {
    lost->severity = Severity::warning;
    lost->place = product.file.place_of("load.tip_force_N");
    product.file.warnings.push_back(std::move(*lost));
  }
  compare_with_motor(context);
  for (Diagnostic& thin : thin_wall_warnings(product)) product.file.warnings.push_back(std::move(thin));
  if (auto wide = wide_part_warning(product)) product.file.warnings.push_back(std::move(*wide));
  write_texts(context, std::move(tables));
  context.result.status = all_ok(context.result.product.checks) ? BuildStatus::done : BuildStatus::check_failed;
}

}  // namespace

profile::Advice motor_advice(const formats::Product& product, const BuildOptions& options, const RunContext& context) {
  const MechanismFile& file = product.file;
  const FeasibilityCheck check(product, options, context, /*with_motor=*/true);
  profile::FeasibilityOracle judge;
  // A change may need several turns, if the pulley does. Their conditions are tested by the full build.
  if (product.helix)
    judge.obstacles = [&file](const Mechanism& changed) -> std::vector<profile::Condition> {
      const Mechanism trial =
          joint::identified_joint(with_declared(file, changed).mechanism, joint::LawSearch::brief).mechanism;
      if (const auto obstacle = profile::obstacle_but_one_turn(trial)) return {*obstacle};
      return analysis::motor_obstacles(trial);
    };
  else
    judge.obstacles = [&check](const Mechanism& changed) { return check(changed); };
  // Trials that passed, with their disadvantages in words. The oracle is called by two threads.
  std::vector<std::pair<Mechanism, std::string>> passed;
  std::mutex guard;
  judge.made = [&](const Mechanism& changed) {
    const auto trial = passing_product(with_declared(file, changed), options, context);
    if (!trial || !motor_suffices(trial->file)) return false;
    const std::string lost = lost_with(*trial, product);
    const std::lock_guard lock(guard);
    passed.emplace_back(changed, lost);
    return true;
  };
  judge.is_expensive = true;
  profile::Advice advice = profile::find_advice(file.mechanism, judge);
  for (profile::Change& change : advice.alone) {
    const Field* field = find_field(change.key);
    if (field == nullptr || field->kind != FieldKind::number) continue;
    for (const auto& [trial, lost] : passed) {
      if (std::abs(number_of(trial, *field) - change.to) < 1e-9 * std::abs(change.to)) change.cost = lost;
    }
  }
  return advice;
}

const std::vector<std::string>& output_names() {
  static const std::vector<std::string> names = {
      "pulley.stl",     "pulley_p1.stl",    "pulley_p2.stl",  "pulley.obj",  "pulley.3mf",   "pulley.drc",
      k_step_name,      "pulley.scad",      "profile.dxf",    "plates.dxf",  "profile.csv",  "profile_p1.csv",
      "profile_p2.csv", "transmission.csv", "mechanism.toml", "report.html", "manifest.json"};
  return names;
}

BuildResult build(const MechanismFile& file, const BuildOptions& options, const RunContext& context) {
  demand_tendons(file, "make a pulley for");
  BuildResult result;
  result.product.file = file;
  auto plausibility = run_async([&file] { return analysis::plausibility_warnings(file); });
  result.product.joint = joint::identified_joint(file.mechanism);
  OutputFolder target(options.folder, options.force, context);
  if (const auto why = options.step ? formats::step_missing() : std::nullopt)
    throw InputError("", "no pulley.step: this fusee was built without STEP: " + *why, "build without --step");
  const std::vector<std::string> names = names_with_table(file.mechanism);
  demand_other_place(file, options);
  target.claim(names);  // before the work, so that a refusal costs no time
  result.product.mechanism_files = mechanism_files(file, *context.files);
  const bool is_possible = design_any(result.product, options.chord_error_mm, options.limits, context);
  for (Diagnostic& warning : plausibility.get()) result.product.file.warnings.push_back(std::move(warning));
  if (!is_possible) {
    result.status = BuildStatus::infeasible;
    if (!options.advice) return result;
    context.begin_step("searching for changes that make it possible");
    result.advice = advice_for(result.product, options, context.without_progress());
    result.advice.layout = drum_advice(file, options, context.without_progress());
    return result;
  }
  if (file.mechanism.motor.enforce) {
    result.product.under_load = analysis::under_load(result.product.joint.mechanism);
    analysis::MotorCheck& motor = *result.product.under_load.motor;
    if (!motor.ok()) {
      result.status = BuildStatus::infeasible;
      std::vector<profile::Condition>& conditions = result.product.pulley.conditions;
      conditions.insert(conditions.end(), motor.conditions.begin(), motor.conditions.end());
      if (!options.advice) return result;
      context.begin_step("searching for changes that suit the motor");
      result.advice = motor.advice = motor_advice(result.product, options, context.without_progress());
      return result;
    }
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
  target.withdraw(names);
  target.publish(result.product.file.warnings);
  result.published = true;
  return result;
}

}  // namespace fusee::pipeline
