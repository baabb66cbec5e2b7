/// \file
/// The verbs of fusee, with files as input and values as result. Read this header first.
///
///     BuildResult      build(file, options)              the pulley, in every format, checked
///     AnalysisResult   analyze(file, options)            the transmission and the forces over the range
///     OptimizeResult   optimize(file, options)           better numbers for the mechanism
///     CalibrateResult  calibrate(file, runs, options)    measured runs: the causes of the error, a better file
///     CompareResult    compare(file, before, after, options)  what changed between two states (pipeline/compare.h)
///     PlanResult       plan(file, options)               which runs to measure, what they can show
///     KitResult        kit(file, options)                the test rig: parts, plates, a page (pipeline/kit.h)
///     ModelResult      model(file, options)              the joint for simulators and firmware (pipeline/model.h)
///     SimulateResult   simulate(file, log, options)      logged motor angles and loads: joint angle, tensions, torque
///
/// Every verb takes a RunContext last: progress, a request to stop, and access to files (base/run_context.h). It throws
/// Stopped after a request to stop, except optimize(), whose result is then the best design so far.
///
/// The steps of build() are public, too:
///
///     MechanismFile    file = read_mechanism("forearm.toml")            the declared joint (mechanism/file.h)
///     SynthesisResult  synthesis = synthesise(file.mechanism)           θ(α) → both pitch curves (profile/synthesis.h)
///     Pulley           pulley = make_pulley(file.mechanism, synthesis)  → one checked solid (solid/pulley.h)
///     RewindResult     as_built = rewind(file.mechanism, floor1, floor2)  θ(α) of the part as made (profile/rewind.h)
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "fusee/analysis/analysis.h"
#include "fusee/base/check.h"
#include "fusee/base/files.h"
#include "fusee/base/run_context.h"
#include "fusee/export/drawings.h"
#include "fusee/export/product.h"
#include "fusee/mechanism/file.h"
#include "fusee/pipeline/calibrate.h"
#include "fusee/pipeline/optimize.h"
#include "fusee/pipeline/plan.h"
#include "fusee/pipeline/simulate.h"
#include "fusee/solid/mesh.h"
#include "fusee/solid/placement.h"

namespace fusee {

/// Largest deviations of the pulley as built that pass the checks.
struct AsBuiltLimits {
  double theta_error_deg = 0.05;
  double slack = 0.05;  ///< mm
};

struct BuildOptions {
  double chord_error_mm = 0.01;  ///< largest distance of a facet from its curve (sagitta)
  AsBuiltLimits limits;
  DxfVersion dxf = DxfVersion::ac1015;
  /// Writes pulley.step, too. build() throws InputError if the part is too large for it, or if step_missing().
  bool step = false;
  std::filesystem::path folder;  ///< folder of the output files
  bool force = false;
  /// Does everything except publishing. Files that are read back are staged in the system's temporary folder.
  bool dry_run = false;
  /// Searches for changes that make an infeasible design feasible.
  bool advice = true;
};

enum class BuildStatus { done, infeasible, check_failed };

struct BuildResult {
  BuildStatus status = BuildStatus::done;
  Product product;
  Advice advice;                    ///< for an infeasible design: changes with which the build passes every check
  std::vector<OutputFile> outputs;  ///< manifest.json last; empty if infeasible
  bool published = false;
};

/// Builds the checked pulley in every format. Every mesh and drawing is read back from the disk and checked. Infeasible
/// designs and failed checks are values; throws InputError and OutputError. A build with failed checks is published
/// only if it replaces no earlier run, or with `force`.
BuildResult build(const MechanismFile& file, const BuildOptions& options, const RunContext& context = {});

/// The files of build(), in the order in which they are written.
const std::vector<std::string>& output_names();

/// Forces over the range of the identified joint. Throws InputError for a joint with [transmission], which has no
/// tendons.
AnalysisResult analyze(const MechanismFile& file, const AnalysisOptions& options = {}, const RunContext& context = {});

/// Runs the search of [optimize] on the identified joint, in terms of the declared numbers. A box without a feasible
/// design and a stopped search are values; throws InputError and OutputError.
OptimizeResult optimize(const MechanismFile& file, const OptimizeOptions& options = {}, const RunContext& context = {});

// ---- Parts from files -----------------------------------------------------------------------------------------------

/// Content of a part's file.
using Part = std::variant<TriangleMesh, Drawing>;
/// Reads a mesh (stl obj 3mf off ply drc) or a drawing (dxf), distinguished by content, then by file name. Throws
/// InputError.
Part read_part(const std::filesystem::path& path, FileAccess& files = disk());
/// check_mesh() or check_drawing().
std::vector<Check> check_part(const Part& part);

struct PartSize {
  std::optional<Vec3> extent;           ///< along x, y, z, mm; empty for an empty part
  std::optional<double> volume;         ///< of a mesh that passes `checks`, mm³
  std::optional<std::size_t> contours;  ///< closed paths of a drawing
};
/// `checks`: the result of check_part().
PartSize size_of(const Part& part, const std::vector<Check>& checks);

/// Winds tendons on the grooves of a mesh at the mechanism's groove heights, or on the contours P1_FLOOR and P2_FLOOR
/// of a drawing (P1_PITCH and P2_PITCH without them). Throws InputError if there is no such groove.
RewindResult rewind_part(const JointAsItIs& joint, const Part& part);
/// Winds tendons on a mesh with the known `layout`: after a second plan of the tie-offs its grooves may be at other
/// heights than the mechanism alone gives.
RewindResult rewind_made(const JointAsItIs& joint, const BodyLayout& layout, const TriangleMesh& mesh);
/// Winds tendons on floors that were measured elsewhere, as printed.
RewindResult rewind_floors(const JointAsItIs& joint, const BodyLayout& layout, const Polygon& floor1,
                           const Polygon& floor2);

enum class PartPlace {
  as_made,         ///< it fits in its present position, or nowhere clearly better
  found,           ///< it was moved, and is wound at the position that was found
  not_recognised,  ///< it fits nowhere: wound in its present position
};
struct RewoundPart {
  RewindResult as_built;
  PartPlace place = PartPlace::as_made;
  /// Position of the part, or one each for P1 and P2 if the file has both side by side.
  std::vector<Placement> placements;
  /// Set if the file has only this pulley: only its tendon is wound, and slack is unknown.
  std::optional<Side> alone = std::nullopt;
};
/// As rewind_part(), but a mesh that was moved, turned about its axis or turned over is moved back first. Throws
/// InputError also for a mirrored mesh or one of another size.
RewoundPart rewind_moved_part(const JointAsItIs& joint, const Part& part);

/// Checks "theta_error" and "slack" against their limits. The slack of method = "paper" is expected: it is reported as
/// "theta_error_reported" and "slack_reported", with the limits 180 deg and the joint's length.
std::vector<Check> as_built_checks(const Mechanism& mechanism, const RewindResult& as_built,
                                   const AsBuiltLimits& limits);

}  // namespace fusee
