/// \file
/// The verbs of fusee, with files as input and values as result. Read this header first.
///
///     BuildResult      build(file, options)              the pulley, in every format, checked
///     AnalysisResult   analyze(file, options)            the transmission and the forces over the range
///     OptimizeResult   optimize(file, options)           better numbers for the mechanism
///     CalibrateResult  calibrate(file, runs, options)    measured runs: the causes of the error, a better file
///     CompareResult    compare(file, before, after, options)  what changed between two states
///     PlanResult       plan(file, options)               which runs to measure, what they can show
///     KitResult        kit(file, options)                the test rig: parts, plates, a page
///     ModelResult      model(file, options)              the joint for simulators and firmware
///     SimulateResult   simulate(file, log, options)      logged motor angles and loads: joint angle, tensions, torque
///
/// Every verb takes a RunContext last: progress, a request to stop, and access to files (fusee/base.h). It throws
/// Stopped after a request to stop, except optimize(), whose result is then the best design so far.
///
/// The steps of build() are public, too:
///
///     MechanismFile    file = read_mechanism("forearm.toml")            the declared joint (fusee/mechanism_file.h)
///     SynthesisResult  synthesis = profile::synthesise(file.mechanism)  θ(α) → both pitch curves (fusee/profile.h)
///     Pulley           pulley = solid::make_pulley(file.mechanism, synthesis)  → one checked solid (fusee/solid.h)
///     RewindResult     as_built = profile::rewind(file.mechanism, floor1, floor2)  θ(α) of the part as made
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "fusee/analysis.h"
#include "fusee/base.h"
#include "fusee/export.h"
#include "fusee/mechanism_file.h"
#include "fusee/optimize.h"
#include "fusee/profile.h"
#include "fusee/solid.h"

namespace fusee::pipeline {

/// Throws InputError for a joint declared by its ratio, which has no tendons. `verb`: what would be done with them, such
/// as "wind".
void demand_tendons(const MechanismFile& file, const std::string& verb);

// ---- Build ----------------------------------------------------------------------------------------------------------

/// Largest deviations of the pulley as built that pass the checks.
struct AsBuiltLimits {
  double theta_error_deg = 0.05;
  double excess = 0.05;  ///< length of a tendon beyond its path, mm
};

/// Accuracy, formats and place of build().
struct BuildOptions {
  double chord_error_mm = 0.01;  ///< largest distance of a facet from its curve (sagitta)
  AsBuiltLimits limits;
  formats::DxfVersion dxf = formats::DxfVersion::ac1015;
  /// Writes pulley.step, too. build() throws InputError if the part is too large for it, or if
  /// formats::step_missing() (export/step/step.h) names a reason.
  bool step = false;
  std::filesystem::path folder;  ///< folder of the output files
  bool force = false;
  /// Does everything except publishing. Files that are read back are staged in the system's temporary folder.
  bool dry_run = false;
  /// Searches for changes that make an infeasible design feasible.
  bool advice = true;
};

/// Outcome of build(): all checks hold, no such pulley exists, or a check failed.
enum class BuildStatus { done, infeasible, check_failed };

/// Result of build().
struct BuildResult {
  BuildStatus status = BuildStatus::done;
  formats::Product product;
  profile::Advice advice;           ///< for an infeasible design: changes with which the build passes every check
  std::vector<OutputFile> outputs;  ///< manifest.json last; empty if infeasible
  bool published = false;
};

/// Builds the checked pulley in every format. Every mesh and drawing is read back from the disk and checked. Infeasible
/// designs and failed checks are values; throws InputError and OutputError. A build with failed checks is published
/// only if it replaces no earlier run, or with `force`.
BuildResult build(const MechanismFile& file, const BuildOptions& options, const RunContext& context = {});

/// The files of build(), in the order in which they are written.
const std::vector<std::string>& output_names();

// ---- Analysis -------------------------------------------------------------------------------------------------------

/// Forces over the range of the identified joint. Throws InputError for a joint with [transmission], which has no
/// tendons.
analysis::AnalysisResult analyze(const MechanismFile& file, const analysis::AnalysisOptions& options = {},
                                 const RunContext& context = {});

// ---- Optimization ---------------------------------------------------------------------------------------------------
// Options and result of fusee optimize.

/// Search methods, in the order of OptimizeResult::search.
enum class SearchMethod { certified, genetic, pareto };

/// The most rigorous method that supports the objectives and variables of [optimize].
SearchMethod strongest_method(const MechanismFile& file);

/// Method and output of optimize().
struct OptimizeOptions {
  std::optional<SearchMethod> method;       ///< default: strongest_method()
  std::optional<optimize::Objective> then;  ///< certified: second objective that selects among tied designs
  optimize::GeneticOptions genetic;         ///< for genetic and pareto
  /// settings with which the file was read; numbers among them go into the new files
  std::vector<Setting> settings;
  std::filesystem::path new_file;      ///< path of the mechanism with the new numbers; empty: none
  std::filesystem::path front_folder;  ///< folder of the front's mechanisms; empty: none
  bool force = false;
  bool dry_run = false;  ///< everything except publishing
};

/// Result of optimize().
struct OptimizeResult {
  optimize::Problem problem;
  std::variant<optimize::CertifiedResult, optimize::GeneticResult, optimize::ParetoResult> search;
  std::optional<optimize::CertifiedResult> then;  ///< the second search of OptimizeOptions::then
  bool found = false;
  bool stopped = false;         ///< by RunContext::stop: the best design so far
  std::string reason;           ///< if nothing was found: the most frequent cause
  optimize::Design design;      ///< best design, in the file's declared numbers; for a front its most balanced point
  double value = 0;             ///< of the first objective
  double theta = 0;             ///< θ at which the objective takes its value, rad; not for a front
  optimize::Evaluation before;  ///< first objective of the unchanged file
  std::string new_text;         ///< text of the file with the design's numbers; empty if not requested
  std::vector<OutputFile> front_files;
  std::vector<Diagnostic> warnings;  ///< plausibility warnings about the file, and settings that the new files omit
  bool published = false;

  SearchMethod method() const { return static_cast<SearchMethod>(search.index()); }
};

/// Runs the search of [optimize] on the identified joint, in terms of the declared numbers. A box without a feasible
/// design and a stopped search are values; throws InputError and OutputError.
OptimizeResult optimize(const MechanismFile& file, const OptimizeOptions& options = {}, const RunContext& context = {});

// ---- Calibration ----------------------------------------------------------------------------------------------------
// Calibration: measured runs → causes of the error, and the file of a better pulley.

/// Columns, validation runs and place of calibrate().
struct CalibrateOptions {
  measurement::MeasurementOptions columns;
  std::vector<std::filesystem::path> hold_out;  ///< runs for validation only
  std::filesystem::path folder;                 ///< folder of the output files
  bool force = false;
  bool dry_run = false;  ///< everything except writing
  bool audit = true;     ///< CalibrationOptions::audit
};

/// Result of calibrate().
struct CalibrateResult {
  formats::CalibrationProduct product;
  std::vector<OutputFile> outputs;  ///< manifest.json last
  bool published = false;
  /// corrected.toml has every key, because the text of `file.path` differs from the mechanism (--set)
  bool rewritten = false;
};

/// Reads the runs, compares them with the joint of `file`, and writes calibration.json, corrected.toml (with the CSV of
/// a law table), compensation.csv, report.html and manifest.json. Inconclusive data give a verdict. Throws InputError
/// for unreadable input, and OutputError before the work if the output may not be written. A run that is both fitted
/// and held out is held out. corrected.toml keeps the text of `file.path` with comments if it describes
/// `file.mechanism`.
CalibrateResult calibrate(const MechanismFile& file, const std::vector<std::filesystem::path>& runs,
                          const CalibrateOptions& options, const RunContext& context = {});

// ---- Comparison -----------------------------------------------------------------------------------------------------
// Comparison: measured runs of two states of one joint → the changes between them.

/// Columns and place of compare().
struct CompareOptions {
  measurement::MeasurementOptions columns;
  std::filesystem::path folder;  ///< folder of the output files; empty: no files
  bool force = false;
  bool dry_run = false;  ///< everything except writing
};

/// Result of compare().
struct CompareResult {
  formats::ComparisonProduct product;
  std::vector<OutputFile> outputs;  ///< manifest.json last; empty without a folder
  bool published = false;
};

/// Reads the runs of both states, compares them with the joint of `file`, and writes comparison.json, report.html and
/// manifest.json. Runs that are not of two states of one joint give a verdict, and all files too. Throws InputError for
/// unreadable input and for a repeated run, and OutputError before the work if the output may not be written.
CompareResult compare(const MechanismFile& file, const std::vector<std::filesystem::path>& before,
                      const std::vector<std::filesystem::path>& after, const CompareOptions& options,
                      const RunContext& context = {});

// ---- Experiment design ----------------------------------------------------------------------------------------------
// Experiment design: plan.json, a page for the bench and empty run files.

/// Limits and place of plan().
struct PlanFilesOptions {
  plan::PlanOptions plan;
  std::filesystem::path folder;  ///< folder of the output files
  bool force = false;
  bool dry_run = false;  ///< everything except writing
};

/// Result of plan().
struct PlanResult {
  /// Reason why there is nothing to plan: the law does not exist over the range. Empty if it does.
  std::optional<profile::SynthesisResult> without_law;
  formats::PlanProduct product;
  std::vector<OutputFile> outputs;  ///< manifest.json last; empty if no run fits into the minutes
  bool published = false;
};

/// Plans the shortest set of runs for the joint of `file`, given the values in [prior]: plan.json, plan.html, and
/// run_1.csv … in the format of `fusee calibrate`, without θ. If no run fits into the minutes, the plan has no steps
/// and lists what more minutes would add. Throws InputError and OutputError.
PlanResult plan(const MechanismFile& file, const PlanFilesOptions& options, const RunContext& context = {});

// ---- Test rig -------------------------------------------------------------------------------------------------------
// Test rig: parts to print and to cut, and a page with the assembly.

/// Accuracy and place of kit().
struct KitOptions {
  double chord_error_mm = 0.01;  ///< largest distance of a facet of the pulley from its curve (sagitta)
  formats::DxfVersion dxf = formats::DxfVersion::ac1015;
  std::filesystem::path folder;  ///< folder of the output files
  bool force = false;
  bool dry_run = false;  ///< everything except publishing
};

/// Outcome of kit(): done, no feasible pulley, colliding parts, or a failed check.
enum class KitEnding { done, no_pulley, no_kit, check_failed };

/// Result of kit().
struct KitResult {
  KitEnding ending = KitEnding::done;
  formats::KitProduct product;
  profile::Advice advice;           ///< if parts would collide: changes that avoid it
  std::vector<OutputFile> outputs;  ///< manifest.json last; empty without a pulley or a rig
  bool published = false;
};

/// Designs the test rig. Every mesh and drawing is read back and checked. An infeasible pulley, colliding parts and
/// failed checks are values; throws InputError and OutputError. Failed checks are published only if they replace no
/// earlier run, or with `force`.
KitResult kit(const MechanismFile& file, const KitOptions& options, const RunContext& context = {});

/// Smallest distances between the assembled parts over the range, measured on their meshes, as checks.
std::vector<Check> kit_fit_checks(const kit::KitPlan& plan);

// ---- Models ---------------------------------------------------------------------------------------------------------
// The joint for other programs: simulators (MuJoCo), descriptions of robots (URDF, ros2_control), firmware (tables).

/// Largest accepted --max-error-deg, deg.
constexpr double k_largest_limit_deg = 45;

/// Accuracy, units and place of model().
struct ModelOptions {
  /// Largest error of θ in joint.xml, rad. The paper's mechanism leaves 0.064° and a printed pulley is checked to
  /// 0.05°, so a coarser polynomial does not describe the joint.
  double most_error = radians(0.1);
  /// Largest error of θ in the tables, in both directions, rad: 1/20 of a step of a 14-bit encoder.
  double most_table_error = radians(0.001);
  model::MotorUnit unit;
  bool declared = false;        ///< ignore identified effects
  bool with_polynomial = true;  ///< false: no joint.xml
  /// compensation.csv. Not set: the file next to the mechanism that calibrate() wrote with it. Empty: none.
  std::optional<std::filesystem::path> compensation;
  std::string prefix;  ///< of the names in joint_table.h; empty: derived from the joint's name
  std::filesystem::path folder;
  bool force = false;
  bool dry_run = false;  ///< everything except publishing
};

/// Outcome of model().
enum class ModelEnding {
  done,
  no_law,          ///< θ(α) does not exist or does not grow; see `without_law`
  no_equilibrium,  ///< the identified joint has no equilibrium under its declared load
  polynomial_off,  ///< the error of joint.xml would exceed most_error
  table_off,       ///< the error of k_most_pieces pieces exceeds most_table_error
  check_failed,
};

/// A change that makes a refused model possible.
struct ModelChange {
  std::string words;       ///< "--max-error-deg 0.13"
  std::string key = {};    ///< of the mechanism file; empty for an option
  std::string value = {};  ///< value of that key, as TOML
};

/// Result of model().
struct ModelResult {
  ModelEnding ending = ModelEnding::done;
  formats::ModelProduct product;
  std::optional<profile::SynthesisResult> without_law;
  std::vector<ModelChange> changes;  ///< tested changes
  std::vector<OutputFile> outputs;   ///< manifest.json last; empty if refused
  bool published = false;
};

/// Writes the models. A missing law, an insufficient polynomial or table, and failed checks are values; throws
/// InputError and OutputError.
ModelResult model(const MechanismFile& file, const ModelOptions& options, const RunContext& context = {});

// ---- Simulation -----------------------------------------------------------------------------------------------------
// Simulation: logged motor angles, loads and times → joint angle, tendon tensions and motor torque.

/// Columns, pulley and noise of simulate().
struct SimulateOptions {
  measurement::MeasurementOptions columns;
  /// true: simulates the corrected pulley that build() makes of this file; false: the pulley of the declared mechanism,
  /// on which [identified] was measured.
  bool corrected = false;
  double noise = 0;        ///< standard deviation of noise added to the joint sensor, rad
  std::uint64_t seed = 1;  ///< of that noise
};

/// Result of simulate().
struct SimulateResult {
  /// Reason why there is nothing to simulate: the law does not exist over the range. Empty if it does.
  std::optional<profile::SynthesisResult> without_law;
  formats::Simulation simulation;
};

/// Simulates the identified joint of `file` row by row, for a log or a run of plan(). Rows without an equilibrium are
/// marked. Throws InputError for unreadable input.
SimulateResult simulate(const MechanismFile& file, const std::filesystem::path& log,
                        const SimulateOptions& options = {}, const RunContext& context = {});

// ---- Parts from files -----------------------------------------------------------------------------------------------

/// Content of a part's file.
using Part = std::variant<solid::TriangleMesh, formats::Drawing>;
/// Reads a mesh (stl obj 3mf off ply drc) or a drawing (dxf), distinguished by content, then by file name. Throws
/// InputError.
Part read_part(const std::filesystem::path& path, FileAccess& files = disk());
/// check_mesh() or check_drawing().
std::vector<Check> check_part(const Part& part);

/// Dimensions of a part, as far as they are defined.
struct PartSize {
  std::optional<Vec3> extent;           ///< along x, y, z, mm; empty for an empty part
  std::optional<double> volume;         ///< of a mesh that passes `checks`, mm³
  std::optional<std::size_t> contours;  ///< closed paths of a drawing
};
/// `checks`: the result of check_part().
PartSize size_of(const Part& part, const std::vector<Check>& checks);

/// The width of a mesh about the z axis, after it has shrunk, against body.room_diameter_mm. Empty for a drawing and
/// without that key.
std::optional<Check> room_check(const Mechanism& mechanism, const Part& part);

/// Winds tendons on the grooves of a mesh at the mechanism's groove heights, or on the contours P1_FLOOR and P2_FLOOR
/// of a drawing (P1_PITCH and P2_PITCH without them). Throws InputError if there is no such groove.
profile::RewindResult rewind_part(const joint::IdentifiedJoint& joint, const Part& part);
/// Winds tendons on a mesh with the known `layout`: after a second plan of the tie-offs its grooves may be at other
/// heights than the mechanism alone gives.
profile::RewindResult rewind_made(const joint::IdentifiedJoint& joint, const solid::BodyLayout& layout,
                                  const solid::TriangleMesh& mesh);
/// Winds tendons on floors that were measured elsewhere, as printed.
profile::RewindResult rewind_floors(const joint::IdentifiedJoint& joint, const solid::BodyLayout& layout,
                                    const Polygon& floor1, const Polygon& floor2);

/// Position of a part in its file.
enum class PartPlace {
  as_made,         ///< it fits in its present position, or nowhere clearly better
  found,           ///< it was moved, and is wound at the position that was found
  not_recognised,  ///< it fits nowhere: wound in its present position
};
/// Result of rewind_moved_part().
struct RewoundPart {
  profile::RewindResult as_built;
  PartPlace place = PartPlace::as_made;
  /// Position of the part, or one each for P1 and P2 if the file has both side by side.
  std::vector<solid::Placement> placements;
  /// Set if the file has only this pulley: only its tendon is wound, and the excess length is unknown.
  std::optional<transmission::Side> alone = std::nullopt;
  /// Size of the grooves relative to the declared ones, where it explains most of their deviation; 1 otherwise.
  double scale = 1;
};
/// As rewind_part(), but a mesh that was moved, turned about its axis or turned over is moved back first. Throws
/// InputError also for a mirrored mesh or one of another size.
RewoundPart rewind_moved_part(const joint::IdentifiedJoint& joint, const Part& part);

/// Checks "theta_error" and "excess_length" against their limits. Pulleys of method = "paper" may exceed these. Their
/// values are reported as "theta_error_reported" and "excess_length_reported", with limits that only a bug exceeds: 180
/// deg and R + EF.
std::vector<Check> as_built_checks(const Mechanism& mechanism, const profile::RewindResult& as_built,
                                   const AsBuiltLimits& limits);

}  // namespace fusee::pipeline
