/// \file
/// fusee as verbs, files in and values out: the first thing to read.
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
/// and in the steps that build() takes:
///
///     MechanismFile    file = read_mechanism("forearm.toml")            the declared joint (mechanism/file.h)
///     SynthesisResult  synthesis = synthesise(file.mechanism)           θ(α) → both pitch curves (profile/synthesis.h)
///     Pulley           pulley = make_pulley(file.mechanism, synthesis)  → one checked solid (solid/pulley.h)
///     RewindResult     as_built = rewind(file.mechanism, floor1, floor2)  θ(α) of the part as made (profile/rewind.h)
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "fusee/analysis/analysis.h"
#include "fusee/base/check.h"
#include "fusee/base/files.h"
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

/// What the pulley as built may miss before a check fails.
struct AsBuiltLimits {
  double theta_error = 0.05;  ///< deg
  double slack = 0.05;        ///< mm
};

struct BuildOptions {
  double tolerance = 0.01;  ///< sagitta of curves, mm
  AsBuiltLimits limits;
  DxfVersion dxf = DxfVersion::ac1015;
  bool step = false;             ///< pulley.step too: InputError where it is too large for one, or step_missing()
  std::filesystem::path folder;  ///< where the files go
  bool force = false;
  /// Everything but publishing; what has to be read back is staged in the system's temporary folder.
  bool dry_run = false;
  /// Called before each step with what it does. What it throws stops the build, and nothing is left behind.
  std::function<void(std::string_view step)> before_step;
  /// Called some hundred times a second while advice is searched for, to the same end.
  std::function<void()> between_tries;
  /// Called once, before anything stands on the disk.
  std::function<void()> before_writing;
  /// From then on called some fifty times a second while files are made and checked on other threads. For a program
  /// that has to end at once: `clean_up` removes what stands on the disk.
  std::function<void(const std::function<void()>& clean_up)> while_waiting;
};

enum class BuildStatus { done, infeasible, check_failed };

struct BuildResult {
  BuildStatus status = BuildStatus::done;
  Product product;
  Advice advice;                    ///< of an infeasible one; what it says builds, with every check
  std::vector<OutputFile> outputs;  ///< manifest.json last; empty when infeasible
  bool published = false;
};

/// Mechanism → checked pulley in every format. Infeasible designs and failed checks are values; InputError and
/// OutputError as their names say. A build whose check failed is published only where there is no earlier run to lose,
/// or with `force`. What is checked is what was written: every mesh and drawing is read back from the disk.
BuildResult build(const MechanismFile& file, const BuildOptions& options);

/// The files that build() leaves, in the order in which they are written.
const std::vector<std::string>& output_names();

/// Forces over the range of the joint as it is. InputError: a joint with [transmission] has none.
AnalysisResult analyze(const MechanismFile& file, const AnalysisOptions& options = {});

/// The search that [optimize] asks for, of the joint as it is and in the numbers that the file declares. A box without
/// a possible design and a search that was stopped are values; InputError and OutputError as their names say.
OptimizeResult optimize(const MechanismFile& file, const OptimizeOptions& options = {});

// ---- Parts from anywhere --------------------------------------------------------------------------------------------

/// A made part as a file holds it.
using Part = std::variant<TriangleMesh, Drawing>;
/// A mesh (stl obj 3mf off ply drc) or a drawing (dxf), told apart by content, then by the name's ending. InputError.
Part read_part(const std::filesystem::path& path);
/// The same of what this run wrote: no input.
Part read_made_part(const std::filesystem::path& path);
/// check_mesh or check_drawing.
std::vector<Check> check_part(const Part& part);

struct PartSize {
  std::optional<Vec3> extent;           ///< along x, y, z, mm; none where there is nothing
  std::optional<double> volume;         ///< of a mesh that passed `checks`, mm³
  std::optional<std::size_t> contours;  ///< closed paths of a drawing
};
/// `checks`: what check_part() says of it.
PartSize size_of(const Part& part, const std::vector<Check>& checks);

/// Winds tendons on the grooves found in a mesh at the heights the mechanism gives them, or on a drawing's P1_FLOOR and
/// P2_FLOOR (without them on the P*_PITCH curves). InputError when there is no such groove.
RewindResult rewind_part(const JointAsItIs& joint, const Part& part);
/// The same on a mesh of which it is known to what sizes it was made: where tie-offs had to be planned anew, its
/// grooves lie elsewhere than the mechanism alone says.
RewindResult rewind_made(const JointAsItIs& joint, const BodyLayout& layout, const TriangleMesh& mesh);
/// The same on floors that were found elsewhere, as printed.
RewindResult rewind_floors(const JointAsItIs& joint, const BodyLayout& layout, const Polygon& floor1,
                           const Polygon& floor2);

enum class PartPlace {
  as_made,         ///< it fits where it lies, or nowhere clearly better
  found,           ///< it was moved, and is wound where it was found
  not_recognised,  ///< it fits nowhere: wound where it lies
};
struct RewoundPart {
  RewindResult as_built;
  PartPlace place = PartPlace::as_made;
  /// Where it was found: once, or once for each of P1 and P2 in a file of both side by side.
  std::vector<Placement> placements;
  /// The only pulley that the file holds: its tendon alone was wound, and no slack is known.
  std::optional<Side> alone = std::nullopt;
};
/// As rewind_part(), but a mesh that was moved, turned about its axis or turned over since it was made is brought back
/// first. InputError, too, for one that is mirrored or of another size.
RewoundPart rewind_moved_part(const JointAsItIs& joint, const Part& part);

/// "theta_error" and "slack" against their limits. The slack of method = "paper" is known: it is reported as
/// "theta_error_reported" and "slack_reported", held only against 180 deg and the joint's length.
std::vector<Check> as_built_checks(const Mechanism& mechanism, const RewindResult& as_built,
                                   const AsBuiltLimits& limits);

}  // namespace fusee
