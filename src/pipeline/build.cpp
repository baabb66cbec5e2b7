#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <future>
#include <memory>

#include "base/run_async.h"
#include "fusee/analysis/plausibility.h"
#include "fusee/export/drawings.h"
#include "fusee/export/mesh_files.h"
#include "fusee/export/report.h"
#include "fusee/export/step.h"
#include "fusee/joint/as_it_is.h"
#include "fusee/pipeline.h"
#include "fusee/solid/print.h"
#include "pipeline/agreement.h"
#include "pipeline/design.h"
#include "pipeline/several_turns.h"
#include "pipeline/thin_walls.h"

namespace fusee {
namespace {

/// A folder of our own in the system's temporary folder, gone with all it holds at the end.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (temporary_folder() / "fusee-dry-run-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
      throw OutputError("the temporary folder cannot be written: " + name,
                        "set TMPDIR to a folder that you may write to");
    path_ = name;
  }
  ~TemporaryFolder() { remove(); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  void remove() const {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

 private:
  std::filesystem::path path_;
};

// As many points of outlines are made for advice: a making of 200, as most have, takes a quarter of a second, and its
// time grows in proportion (campaign of seed 210002).
constexpr double k_points_for_advice = 1600;

constexpr const char* k_step = "pulley.step";

// No file of ours is larger.
constexpr std::size_t k_largest_draco = std::size_t{512} << 20;

void announce(const BuildOptions& options, std::string_view what) {
  if (options.before_step) options.before_step(what);
}

/// A build under way: what was made so far and where it is staged.
struct Workshop {
  const BuildOptions& options;
  BuildResult& result;
  OutputFolder& folder;
  std::function<void()> clean_up;

  void step(std::string_view what) const {
    if (options.while_waiting) options.while_waiting(clean_up);
    announce(options, what);
  }
  void stage(std::string name, std::string bytes) {
    step("writing " + name);
    result.outputs.push_back({std::move(name), std::move(bytes)});
    folder.stage(result.outputs.back());
  }
  /// What another thread makes.
  template <typename Value>
  Value take(std::future<Value>& made) const {
    while (made.wait_for(std::chrono::milliseconds(20)) == std::future_status::timeout) {
      if (options.while_waiting) options.while_waiting(clean_up);
    }
    return made.get();
  }
  Part read_back(const std::string& name) const { return read_made_part(folder.staged_path(name)); }
  TriangleMesh mesh_of(const std::string& name) const { return std::get<TriangleMesh>(read_back(name)); }
  void add(std::vector<Check> checks, const std::string& prefix = {}) {
    for (Check& check : checks) {
      check.name = prefix + check.name;
      result.product.checks.push_back(std::move(check));
    }
  }
};

void stage_step(Workshop& shop, StepFile file) {
  const bool is_made = !file.bytes.empty();
  shop.add({exactly("made", is_made ? 1 : 0, 1, "1", file.complaint)}, "step_");
  if (is_made) shop.stage(k_step, std::move(file.bytes));
}

bool has_step(const Workshop& shop) {
  const auto& outputs = shop.result.outputs;
  return std::any_of(outputs.begin(), outputs.end(), [](const OutputFile& file) { return file.name == k_step; });
}

/// Of several turns: there are no plates to cut grooves out of that climb.
DracoFile write_climbing(Workshop& shop) {
  const Product& product = shop.result.product;
  const TriangleMesh& mesh = product.pulley.mesh;
  const std::string& name = product.file.mechanism.name;
  shop.step("writing meshes and drawings");
  auto draco = run_async([&] { return draco_file(mesh, shop.options.tolerance); });
  auto profile = run_async([&] { return profile_dxf(product, shop.options.dxf); });
  auto threemf = run_async([&] { return threemf_bytes(mesh, name); });
  auto obj = run_async([&] { return obj_text(mesh, name); });
  auto scad = run_async([&] { return scad_text(product); });
  auto step = run_async([&] { return shop.options.step ? step_file(product) : StepFile(); }, shop.options.step);
  shop.stage("pulley.stl", stl_bytes(mesh, name));
  shop.stage("pulley.obj", shop.take(obj));
  shop.stage("pulley.3mf", shop.take(threemf));
  DracoFile file = shop.take(draco);
  shop.stage("pulley.drc", file.bytes);
  if (shop.options.step) stage_step(shop, shop.take(step));
  shop.stage("pulley.scad", shop.take(scad));
  shop.stage("profile.dxf", shop.take(profile));
  return file;
}

/// As it lies on the printer.
std::vector<Check> print_checks(const Print& print, const TriangleMesh& mesh) {
  if (print.supports) return {};
  PrintLimits limits;
  limits.overhang = print.overhang;
  return check_print(mesh, limits);
}

std::vector<Check> draco_checks(const Workshop& shop, const TriangleMesh& mesh, const DracoFile& made) {
  const bool is_what_was_read = read_output(shop.folder.staged_path("pulley.drc"), k_largest_draco) == made.bytes;
  const Part decoded = is_what_was_read ? Part(made.decoded) : shop.read_back("pulley.drc");
  std::vector<Check> checks = near_mesh(mesh, std::get<TriangleMesh>(decoded), shop.options.tolerance);
  for (const Check& check : is_what_was_read ? made.checks : check_part(decoded)) checks.push_back(check);
  return checks;
}

/// A solid that CAD can use, and tendons wound on its floors.
std::vector<Check> step_checks(const Workshop& shop) {
  const Product& product = shop.result.product;
  StepInspection look = inspect_step(shop.folder.staged_path(k_step), product, shop.options.tolerance);
  std::vector<Check> checks = std::move(look.checks);
  if (!all_ok(checks)) return checks;
  const RewindResult wound = product.helix
                                 ? rewind_several_turns(product, look.climbing).result
                                 : rewind_floors(product.joint, product.pulley.layout, look.floor1, look.floor2);
  for (Check& check : as_built_checks(product.joint.mechanism, wound, shop.options.limits))
    checks.push_back(std::move(check));
  return checks;
}

/// As it was written, and as it lies on the printer.
std::vector<Check> checks_of_printed(const Workshop& shop, const PrintedPart& part) {
  const TriangleMesh piece = shop.mesh_of(part_file_name(part.side));
  std::vector<Check> checks = check_printed_part(piece, part);
  for (const Check& check : print_checks(shop.result.product.joint.mechanism.print, piece)) checks.push_back(check);
  return checks;
}

/// Looks at files, not at what is in memory: only what was written can be printed. What was found of the same bytes, or
/// of the same facets, before they were written is not looked for again. Each begins as soon as its file is staged.
struct Looks {
  using Found = std::future<std::vector<Check>>;

  std::shared_future<TriangleMesh> mesh;  ///< of pulley.stl
  Found of_pulley, of_obj, of_3mf, of_draco, of_step, of_profile, of_plates;
  std::vector<Found> of_printed;
  std::future<RewindResult> as_built;
};

void look_at_mesh(Looks& looks, const Workshop& shop) {
  const Product& product = shop.result.product;
  const Mechanism& mechanism = product.joint.mechanism;
  looks.mesh = run_async([&shop] { return shop.mesh_of("pulley.stl"); }).share();
  looks.of_pulley = run_async([&shop, &product, mesh = looks.mesh] {
    return check_pulley(mesh.get(), product.joint.mechanism, product.synthesis, product.pulley, shop.options.tolerance);
  });
  looks.as_built = run_async(
      [&product, mesh = looks.mesh] { return rewind_made(product.joint, product.pulley.layout, mesh.get()); });
  if (product.pulley.parts.empty())
    looks.of_printed.push_back(
        run_async([&mechanism, mesh = looks.mesh] { return print_checks(mechanism.print, mesh.get()); }));
}

/// Every file that has a part in it, in order, each made beside the others.
Looks write_parts(Workshop& shop) {
  Product& product = shop.result.product;
  const TriangleMesh& mesh = product.pulley.mesh;
  const std::string& name = product.file.mechanism.name;
  shop.step("writing meshes and drawings");
  auto draco = run_async([&] { return draco_file(mesh, shop.options.tolerance); });
  auto plates = run_async([&] { return plates_dxf(product, shop.options.dxf); });
  auto profile = run_async([&] { return profile_dxf(product, shop.options.dxf); });
  auto threemf = run_async([&] { return threemf_bytes(plate_of(product.pulley), name); });
  auto obj = run_async([&] { return obj_text(mesh, name); });
  auto scad = run_async([&] { return scad_text(product); });
  auto holding = run_async([&] { return tendon_holding(product.joint.mechanism, product.synthesis, product.pulley); });
  auto step = run_async([&] { return shop.options.step ? step_file(product) : StepFile(); }, shop.options.step);
  Looks looks;
  shop.stage("pulley.stl", stl_bytes(mesh, name));
  look_at_mesh(looks, shop);
  shop.stage("pulley.obj", shop.take(obj));
  looks.of_obj = run_async([&shop, read = looks.mesh] { return same_mesh(read.get(), shop.mesh_of("pulley.obj")); });
  shop.stage("pulley.3mf", shop.take(threemf));
  looks.of_3mf =
      run_async([&shop, &product] { return same_mesh(plate_of(product.pulley), shop.mesh_of("pulley.3mf")); });
  for (const PrintedPart& part : product.pulley.parts) {
    shop.stage(part_file_name(part.side), stl_bytes(part.mesh, name));
    looks.of_printed.push_back(run_async([&shop, &part] { return checks_of_printed(shop, part); }));
  }
  DracoFile file = shop.take(draco);
  shop.stage("pulley.drc", file.bytes);
  looks.of_draco = run_async([&shop, read = looks.mesh, made = std::make_shared<const DracoFile>(std::move(file))] {
    return draco_checks(shop, read.get(), *made);
  });
  if (shop.options.step) stage_step(shop, shop.take(step));
  shop.stage("pulley.scad", shop.take(scad));
  shop.stage("profile.dxf", shop.take(profile));
  looks.of_profile = run_async([&shop] { return check_part(shop.read_back("profile.dxf")); });
  shop.stage("plates.dxf", shop.take(plates));
  looks.of_plates = run_async([&shop] { return check_part(shop.read_back("plates.dxf")); });
  product.holding = shop.take(holding);
  const bool is_step = has_step(shop);
  looks.of_step = run_async([&shop, is_step] { return is_step ? step_checks(shop) : std::vector<Check>(); }, is_step);
  return looks;
}

/// Tables that ask for no check: made while the last of them are under way.
struct Tables {
  std::future<std::string> profile, p1, p2, transmission;
};
Tables begin_tables(const Product& product) {
  return {run_async([&product] { return profile_csv(product); }),
          run_async([&product] { return pitch_curve_csv(product, Side::left); }),
          run_async([&product] { return pitch_curve_csv(product, Side::right); }),
          run_async([&product] { return transmission_csv(product); })};
}

/// What the looks found.
Tables check_parts(Workshop& shop, Looks& looks) {
  Product& product = shop.result.product;
  shop.step("checking what was written");
  shop.add(shop.take(looks.of_pulley));
  shop.step("winding tendons on it");
  product.as_built = shop.take(looks.as_built);
  shop.add(as_built_checks(product.joint.mechanism, product.as_built, shop.options.limits));
  Tables tables = begin_tables(product);
  shop.step("checking the other files");
  for (std::size_t k = 0; k < product.pulley.parts.size(); ++k)
    shop.add(shop.take(looks.of_printed[k]), product.pulley.parts[k].side == Side::left ? "p1_" : "p2_");
  if (product.pulley.parts.empty()) shop.add(shop.take(looks.of_printed.front()));
  shop.add(shop.take(looks.of_obj), "obj_");
  shop.add(shop.take(looks.of_3mf), "3mf_");
  shop.add(shop.take(looks.of_draco), "drc_");
  shop.add(shop.take(looks.of_step), "step_");
  shop.add(shop.take(looks.of_profile), "profile_dxf_");
  shop.add(shop.take(looks.of_plates), "plates_dxf_");
  return tables;
}

Tables check_climbing(Workshop& shop, const DracoFile& draco) {
  Product& product = shop.result.product;
  const Mechanism& mechanism = product.joint.mechanism;
  shop.step("checking what was written");
  const TriangleMesh mesh = shop.mesh_of("pulley.stl");
  auto of_draco = run_async([&] { return draco_checks(shop, mesh, draco); });
  auto of_3mf = run_async([&] { return same_mesh(mesh, shop.mesh_of("pulley.3mf")); });
  auto of_obj = run_async([&] { return same_mesh(mesh, shop.mesh_of("pulley.obj")); });
  auto of_profile = run_async([&] { return check_part(shop.read_back("profile.dxf")); });
  auto of_pulley = run_async([&] { return check_several_turns(product, mesh); });
  auto of_printing = run_async([&] { return print_checks(mechanism.print, mesh); });
  auto as_built = run_async([&] { return rewind_several_turns(product, mesh); });
  auto of_step =
      run_async([&] { return has_step(shop) ? step_checks(shop) : std::vector<Check>(); }, shop.options.step);
  shop.add(shop.take(of_pulley));
  shop.step("winding tendons on it");
  product.helix->as_built = shop.take(as_built);
  product.as_built = product.helix->as_built.result;
  shop.add(as_built_checks(mechanism, product.as_built, shop.options.limits));
  Tables tables = begin_tables(product);
  shop.step("checking the other files");
  shop.add(shop.take(of_printing));
  shop.add(shop.take(of_obj), "obj_");
  shop.add(shop.take(of_3mf), "3mf_");
  shop.add(shop.take(of_draco), "drc_");
  shop.add(shop.take(of_step), "step_");
  shop.add(shop.take(of_profile), "profile_dxf_");
  return tables;
}

/// A file of ours that cannot be used is nobody's bad input.
template <typename Look>
Tables check_written(const Look& look) {
  try {
    return look();
  } catch (const InputError& error) {
    throw Bug(std::string("what was written cannot be used: ") + error.what());
  }
}

Tables write_and_check_parts(Workshop& shop) {
  if (shop.result.product.helix) {
    const DracoFile draco = write_climbing(shop);
    return check_written([&] { return check_climbing(shop, draco); });
  }
  Looks looks = write_parts(shop);
  return check_written([&] { return check_parts(shop, looks); });
}

void write_texts(Workshop& shop, Tables tables) {
  const Product& product = shop.result.product;
  shop.step("writing tables, report and manifest");
  auto report = run_async([&] { return report_html(product); });
  shop.stage("profile.csv", shop.take(tables.profile));
  shop.stage("profile_p1.csv", shop.take(tables.p1));
  shop.stage("profile_p2.csv", shop.take(tables.p2));
  shop.stage("transmission.csv", shop.take(tables.transmission));
  shop.stage("report.html", shop.take(report));
  auto manifest = run_async([&] { return manifest_json(product, shop.result.outputs); });
  shop.stage("manifest.json", shop.take(manifest));
}

bool passes_checks_of_several_turns(const Product& product, const BuildOptions& options) {
  const Mechanism& mechanism = product.joint.mechanism;
  const TriangleMesh& mesh = product.pulley.mesh;
  return all_ok(check_several_turns(product, mesh)) && all_ok(print_checks(mechanism.print, mesh)) &&
         all_ok(as_built_checks(mechanism, rewind_several_turns(product, mesh).result, options.limits));
}

/// Curves, body and plates with the checks that a design can fail; the other files say the same. Nothing is written.
bool passes_checks(const MechanismFile& file, const BuildOptions& options) {
  Product product;
  product.file = file;
  product.joint = as_it_is(file.mechanism);
  BuildOptions quietly = options;
  quietly.before_step = [&options](std::string_view) {
    if (options.between_tries) options.between_tries();
  };
  if (!design_any(product, quietly.tolerance, quietly.limits, quietly.before_step, TieOffSearch::brief)) return false;
  if (product.helix) return passes_checks_of_several_turns(product, options);
  const Mechanism& mechanism = product.joint.mechanism;
  const TriangleMesh& mesh = product.pulley.mesh;
  announce(quietly, "checking its mesh");
  auto of_plates = run_async([&] {
    const std::string drawing = plates_dxf(product, options.dxf);
    return all_ok(check_part(read_dxf(drawing, "plates.dxf")));
  });
  auto of_printing = run_async([&] {
    if (product.pulley.parts.empty()) return all_ok(print_checks(mechanism.print, mesh));
    return std::all_of(product.pulley.parts.begin(), product.pulley.parts.end(),
                       [&](const PrintedPart& part) { return all_ok(print_checks(mechanism.print, part.mesh)); });
  });
  const bool is_right =
      all_ok(check_pulley(mesh, mechanism, product.synthesis, product.pulley, options.tolerance)) &&
      all_ok(as_built_checks(mechanism, rewind_made(product.joint, product.pulley.layout, mesh), options.limits));
  const bool prints = of_printing.get();
  return of_plates.get() && prints && is_right;
}

/// A number that makes the file bad input, or a part on which no tendon can be wound, is no advice.
bool is_made(const MechanismFile& file, const BuildOptions& options) {
  try {
    return passes_checks(file, options);
  } catch (const InputError&) {
    return false;
  }
}

/// The quick look at mechanisms that are hardly different from a file's: curves and body of the joint as it is, without
/// a mesh. What differs in its body alone has the file's curves.
class Look {
 public:
  Look(const Product& refused, const BuildOptions& options)
      : file_(refused.file),
        options_(options),
        own_(curves_of(refused.file.mechanism)),
        own_points_(static_cast<double>(refused.synthesis.p1.points.size())) {}

  std::vector<Condition> operator()(const Mechanism& changed) const {
    if (options_.between_tries) options_.between_tries();
    if (!has_own_curves(changed)) return obstacles(curves_of(with_declared(file_, changed).mechanism));
    Curves curves = own_;
    curves.joint.mechanism.body = changed.body;
    curves.joint.mechanism.horn = changed.horn;
    curves.joint.mechanism.print = changed.print;
    return obstacles(curves);
  }

  /// That its largest part leaves time for.
  int builds_left() const {
    const double turn = std::min(radians(2.0), std::sqrt(8.0 * options_.tolerance / largest_));
    const double points = std::max(k_two_pi / turn, own_points_);
    return std::max(1, static_cast<int>(k_points_for_advice / points));
  }

 private:
  /// A flange's reach says how finely curves are drawn.
  bool has_own_curves(const Mechanism& changed) const {
    if (changed.groove_depth() != file_.mechanism.groove_depth()) return false;
    Mechanism with_own_body = changed;
    with_own_body.body = file_.mechanism.body;
    with_own_body.horn = file_.mechanism.horn;
    with_own_body.print = file_.mechanism.print;
    return with_own_body == static_cast<const Mechanism&>(file_.mechanism);
  }

  std::vector<Condition> obstacles(const Curves& curves) const {
    if (!curves.obstacles.empty()) return curves.obstacles;
    const Mechanism& mechanism = curves.joint.mechanism;
    const SynthesisResult& synthesis = curves.synthesis;
    const auto of_body = body_obstacles(mechanism, synthesis);
    if (!of_body.empty()) return of_body;
    for (const Outline* outline : {&synthesis.p1, &synthesis.p2}) {
      for (const OutlinePoint& point : outline->points) see_size(point.position.norm());
    }
    const auto floor = [&mechanism](const Outline& outline) {
      return parallel(outline, -0.5 * mechanism.tendon.diameter);
    };
    return failed_of(windable(mechanism, [&] { rewind(mechanism, floor(synthesis.p1), floor(synthesis.p2)); }));
  }

  void see_size(double reach) const {
    double known = largest_;
    while (reach > known && !largest_.compare_exchange_weak(known, reach)) {
    }
  }

  const MechanismFile& file_;
  const BuildOptions& options_;
  Curves own_;
  double own_points_;  ///< of an outline as it would be made, 0 where there is none
  /// Of all that had room for a body: from the axis to an outline's furthest point, mm.
  mutable std::atomic<double> largest_ = 0;
};

Advice advice_for(const Product& product, const BuildOptions& options) {
  const MechanismFile& file = product.file;
  if (product.helix) {
    const auto made = [&](const Mechanism& changed) { return is_made(with_declared(file, changed), options); };
    return advice_for_several_turns(product, {options.tolerance, made, options.between_tries});
  }
  const Look look(product, options);
  std::atomic<int> begun = 0;
  const FeasibilityOracle judge{.obstacles = [&](const Mechanism& changed) { return look(changed); },
                                .made =
                                    [&](const Mechanism& changed) {
                                      ++begun;
                                      return is_made(with_declared(file, changed), options);
                                    },
                                .builds_left = [&] { return look.builds_left() - begun; }};
  return body_advice(file.mechanism, judge, product.pulley.layout.parts);
}

void write_and_check(Workshop& shop) {
  Tables tables = write_and_check_parts(shop);
  Product& product = shop.result.product;
  for (Diagnostic& thin : walls_below_a_line(product)) product.file.warnings.push_back(std::move(thin));
  write_texts(shop, std::move(tables));
  shop.result.status = all_ok(shop.result.product.checks) ? BuildStatus::done : BuildStatus::check_failed;
}

void write_and_forget(BuildResult& result, const BuildOptions& options) {
  if (options.before_writing) options.before_writing();
  const TemporaryFolder temporary;
  OutputFolder staging(temporary.path() / "out", true);
  Workshop shop{options, result, staging, [&] {
                  staging.discard();
                  temporary.remove();
                }};
  write_and_check(shop);
}

}  // namespace

const std::vector<std::string>& output_names() {
  static const std::vector<std::string> names = {
      "pulley.stl",     "pulley_p1.stl",    "pulley_p2.stl", "pulley.obj",   "pulley.3mf",  "pulley.drc",
      k_step,           "pulley.scad",      "profile.dxf",   "plates.dxf",   "profile.csv", "profile_p1.csv",
      "profile_p2.csv", "transmission.csv", "report.html",   "manifest.json"};
  return names;
}

BuildResult build(const MechanismFile& file, const BuildOptions& options) {
  BuildResult result;
  result.product.file = file;
  auto doubted = run_async([&file] { return plausibility_warnings(file); });
  result.product.joint = as_it_is(file.mechanism);
  OutputFolder target(options.folder, options.force);
  if (const auto why = options.step ? step_missing() : std::nullopt)
    throw InputError("", "no pulley.step: this fusee was built without STEP: " + *why, "build without --step");
  target.claim(output_names());  // before the work: a refusal should not cost a wait
  const bool is_possible = design_any(result.product, options.tolerance, options.limits, options.before_step);
  for (Diagnostic& doubt : doubted.get()) result.product.file.warnings.push_back(std::move(doubt));
  if (!is_possible) {
    result.status = BuildStatus::infeasible;
    announce(options, "looking for what would make it possible");
    result.advice = advice_for(result.product, options);
    return result;
  }
  if (!result.product.helix) {
    for (Diagnostic& unused : unused_turn_keys(file)) result.product.file.warnings.push_back(std::move(unused));
  }
  if (options.dry_run) {
    write_and_forget(result, options);
    return result;
  }
  if (options.before_writing) options.before_writing();
  Workshop shop{options, result, target, [&target] { target.discard(); }};
  write_and_check(shop);
  const bool may_publish = result.status == BuildStatus::done || !target.has_earlier_run() || options.force;
  if (!may_publish) return result;
  shop.step("publishing");
  // pulley_p1.stl of an earlier run does not belong to a pulley in one piece.
  target.withdraw(output_names());
  target.publish(result.product.file.warnings);
  result.published = true;
  return result;
}

}  // namespace fusee
