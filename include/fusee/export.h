/// \file
/// Contents of the output files, as bytes or text. The same input gives the same bytes.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fusee/analysis.h"
#include "fusee/base.h"
#include "fusee/calibration.h"
#include "fusee/correction.h"
#include "fusee/helical_solid.h"
#include "fusee/helix.h"
#include "fusee/joint.h"
#include "fusee/kit.h"
#include "fusee/measurement.h"
#include "fusee/mechanism_file.h"
#include "fusee/model.h"
#include "fusee/plan.h"
#include "fusee/profile.h"
#include "fusee/solid.h"

namespace fusee::formats {

// ---- Product --------------------------------------------------------------------------------------------------------
// The input of drawings and reports.

/// Additional data of a multi-turn pulley, whose curves are no outlines and whose grooves lie in no plane.
struct HelixProduct {
  helix::HelixSynthesis synthesis;
  helical_solid::HelicalPulley pulley;  ///< its mesh and conditions are in Product::pulley
  helical_solid::HelicalRewind as_built;

  /// Heights above the part's lower face of the tendons' ends on the joint, or of their guides' collars.
  helical_solid::TendonsLaid laid(bool collar) const {
    return helical_solid::tendons_laid(pulley, synthesis.sides[0].spiral, synthesis.sides[1].spiral,
                                       synthesis.sides[0].attachment_z, synthesis.sides[1].attachment_z, collar);
  }
};

/// The complete data of a finished pulley.
struct Product {
  MechanismFile file;            ///< as read
  joint::IdentifiedJoint joint;  ///< the identified joint that the pulley was designed for
  profile::SynthesisResult synthesis;
  solid::Pulley pulley;
  std::optional<solid::BodyLayout> cut_layout;  ///< layout for cutting, without shrinkage and chamfer, if known
  solid::Holding holding;                       ///< of its tendons
  profile::RewindResult as_built;
  analysis::UnderLoad under_load;  ///< with the declared load; `as_built` is geometry alone
  std::vector<Check> checks;
  /// mechanism.toml, which describes `file.mechanism`, and its law's table if there is one
  std::vector<OutputFile> mechanism_files = {};
  /// additional lengths of both tendons in the test rig of kit(); empty if there is no such rig
  std::optional<std::array<kit::KitTendon, 2>> rig = {};
  std::optional<HelixProduct> helix = {};  ///< several turns; `synthesis` then has no outlines and `pulley` no anchors
};

// ---- Drawings -------------------------------------------------------------------------------------------------------
// Writes and reads drawings as DXF, and checks them for faults that stop a workshop's machine. The same input gives
// the same bytes.

/// AC1015 is AutoCAD 2000, with millimetres; R12 suits old machines.
enum class DxfVersion { ac1015, r12 };

/// The body's sizes without shrinkage and hole compensation, which apply to prints only.
solid::BodyLayout layout_to_cut(Mechanism mechanism, const profile::SynthesisResult& synthesis);

/// The pulley's curves at true size about the axis, with marks of its home position.
std::string profile_dxf(const Product& product, DxfVersion version);
/// The part as a stack of plates to cut, nested on sheets.
std::string plates_dxf(const Product& product, DxfVersion version);
/// Features of the plates that are omitted or smaller than [cut] declares, with the reason, and a sheet that is larger.
std::vector<std::string> plate_omissions(const Product& product);

/// One closed or open path of a drawing. Arcs and circles are points within 0.001 mm.
struct DrawingPath {
  std::string layer;
  std::string entity;  ///< "LWPOLYLINE", "CIRCLE" …
  int line = 0;        ///< line in the file
  bool closed = false;
  Polygon points;
  bool in_space = false;                          ///< `points` is its plan
  std::optional<double> diameter = std::nullopt;  ///< of a whole circle: the exact value, not that of the points
};

/// An unusual entity without effect; entities of one kind are combined.
struct DrawingRemark {
  int line = 0;  ///< of the first one
  std::string text;
  std::size_t count = 1;
};
/// The reason why an entity was omitted.
struct UndrawnEntity {
  int line = 0;
  std::string why;
};

/// A drawing as read from a file.
struct Drawing {
  std::string version;               ///< "AC1015", "AC1009" …
  bool millimetres = false;          ///< $INSUNITS = 4, or absent in R12
  std::vector<DrawingPath> paths;    ///< in mm; paths that meet on one layer are joined
  std::vector<std::string> ignored;  ///< kinds of entity that were skipped
  std::vector<DrawingRemark> remarks = {};
  std::size_t undrawn = 0;  ///< entities whose values draw no curve
  UndrawnEntity first_undrawn = {};
};

/// Reads ASCII DXF, R12 to R2018. Entities that cannot be drawn are counted and skipped. Throws InputError with the
/// line if the file as a whole cannot be read.
Drawing read_dxf(std::string_view bytes, const std::string& file_name);

/// Checks for drawable entities, closed contours, meeting ends, self-crossings, duplicate lines and the smallest
/// feature: one Check each. Duplicate lines are tested once, and checks that an earlier fault makes meaningless are
/// omitted.
std::vector<Check> check_drawing(const Drawing& drawing);

// ---- Plan -----------------------------------------------------------------------------------------------------------
// The outputs of `fusee plan`, as bytes.

/// A plan and its inputs.
struct PlanProduct {
  MechanismFile file;
  double noise = 0;    ///< rad
  double minutes = 0;  ///< available minutes
  plan::Plan plan;
};

/// "run_2.csv"; "" for a step that is no run.
std::string run_file_name(const plan::Plan& plan, std::size_t step);
/// The rows to drive in the format of `fusee calibrate`, with θ empty and the instructions in comments.
std::string run_csv(const PlanProduct& product, std::size_t step);
/// The document of a plan, with a schema number.
std::string plan_json(const PlanProduct& product);
/// A page for the bench: A4, boxes to tick, no network.
std::string plan_html(const PlanProduct& product);
/// The page and run files of a calibration's next measurements. `measured`: the runs that it had.
std::string next_html(const PlanProduct& product, const std::vector<std::string>& measured);
/// The sections with instructions, for another page that has plan.css.
std::string plan_steps_html(const PlanProduct& product);
/// Lists inputs and the hashes of all files.
std::string plan_manifest_json(const PlanProduct& product, const std::vector<OutputFile>& outputs);

// Texts for page and terminal.

/// "hang 1.02 kg on a cord …"; "" without load.
std::string hanging_words(const PlanProduct& product, const plan::PlannedRun& run);
/// The expected false-positive rate in words, for simulated joints.
std::vector<std::string> false_positive_words(const plan::Plan& plan);
/// The predicted gain of a step over the steps before it, such as "detects creep; distinguishes … from …".
std::string gain_words(const plan::PlanStep& step);
/// The predicted gain of the first minutes, such as "by minute 3: 3 cycles, slow …; distinguishes …".
std::string minute_words(const plan::PlanStep& step, const std::string& gain);
/// minute_words() of several steps, in their order.
std::vector<std::string> minute_words(const std::vector<plan::PlanStep>& steps);

// ---- Test rig -------------------------------------------------------------------------------------------------------
// The outputs of `fusee kit`, as bytes. The same input gives the same bytes.

/// A test rig, and the pulley that it is for.
struct KitProduct {
  Product pulley;  ///< file, joint, curves and body, not written
  kit::KitPlan plan;
  PlanProduct bench;  ///< the measurements to be made on it
  std::vector<Check> checks;
};

/// File name such as "base_plate.stl".
std::string kit_file_name(const kit::KitPart& part, const std::string& ending);

/// Length of a tendon to be cut.
struct KitCut {
  transmission::Side side = transmission::Side::left;
  double between_knots = 0;  ///< from the pulley's knot to its fastening at the joint, taut, at home, mm
  double cut = 0;            ///< including both ends, in whole 5 mm
  double longer = 0;         ///< additional length that the rig's tensioner and post use, mm
};
/// The lengths of both tendons. mm.
std::vector<KitCut> kit_cuts(const KitProduct& product);
/// Cut lengths of a pulley in a rig.
std::vector<KitCut> rig_cuts(const Product& pulley, const std::array<kit::KitTendon, 2>& rig);

/// The parts that can be cut from sheets, nested flat: layers CUT_OUTER, CUT_INNER, ENGRAVE.
std::string kit_dxf(const KitProduct& product, DxfVersion version);
/// The columns count,item,use.
std::string bom_csv(const KitProduct& product);
/// The assembly page: pictures of each step, tendons, parts to buy, the coupon, the measuring plan.
std::string kit_html(const KitProduct& product);
/// Lists inputs and the hashes of all files.
std::string kit_manifest_json(const KitProduct& product, const std::vector<OutputFile>& outputs);

// ---- Models ---------------------------------------------------------------------------------------------------------
// The outputs of `fusee model`, as text. The same input gives the same bytes.

/// The complete model of a joint.
struct ModelProduct {
  MechanismFile file;   ///< as read
  Mechanism mechanism;  ///< the identified mechanism
  model::JointCurves curves;
  std::string compensation;     ///< source file of curves.sensed; empty: none
  model::EqualityFit equality;  ///< for MuJoCo
  model::EqualityFit line;      ///< straight line, for URDF
  std::optional<model::TendonModel> tendons;
  std::string without_tendons;  ///< why there is no tendon model
  bool with_polynomial = true;  ///< true if joint.xml is written
  double most_error = 0;        ///< allowed error of a simulator's joint, rad
  double most_table_error = 0;  ///< allowed error of tables, rad
  model::JointTable table;
  std::string prefix;  ///< prefix of the names in the header
  std::vector<Check> checks;
  std::vector<std::string> notes;
};

/// A valid C prefix derived from the joint's name.
std::string c_prefix(const std::string& name);

/// MuJoCo: hinges alpha and theta, coupled by a joint equality.
std::string mujoco_joint_xml(const ModelProduct& product);
/// MuJoCo: both hinges, coupled by a tendon that is wrapped over its pin. Requires product.tendons.
std::string mujoco_tendons_xml(const ModelProduct& product);
/// Joints alpha and theta; the second one mimics the first.
std::string joint_urdf(const ModelProduct& product);
/// For ros2_control: joint theta, and a transmission from the motor to it.
std::string ros2_control_urdf(const ModelProduct& product);
/// C header with tables of 32-bit floats and their interpolation.
std::string joint_table_h(const ModelProduct& product);
/// The tables of joint_table_h() as JSON.
std::string joint_table_json(const ModelProduct& product);
/// Lists inputs and the hashes of all files.
std::string model_manifest_json(const ModelProduct& product, const std::vector<OutputFile>& outputs);

/// True if `manifest`, the text of a manifest of fusee, lists the file `name` with this SHA-256.
bool names_output(const std::string& manifest, const std::string& name, const std::string& sha256);

/// Reads the written files back and compares them with the joint's curves.
std::vector<Check> check_model(const ModelProduct& product, const std::vector<OutputFile>& outputs);

// ---- Calibration ----------------------------------------------------------------------------------------------------
// Outputs of `fusee calibrate`, as bytes.

/// The complete result of a calibration.
struct CalibrationProduct {
  MechanismFile file;
  measurement::Measurement measurement;
  calibration::Calibration calibration;
  /// Likely errors of the file or the data, for data that no effect explains.
  std::vector<calibration::LikelyInputError> input_errors;
  correction::Correction correction;
  correction::Rehearsal rehearsal;  ///< of the identified effects
};

/// The document of a calibration, with a schema number.
std::string calibration_json(const CalibrationProduct& product);
/// The measurements to make next, for the bench: a page and the run files, "next/run_6.csv". Empty if there are none.
std::vector<OutputFile> next_files(const CalibrationProduct& product);
/// The file of calibration.next[i]: "next/run_6.csv", numbered after the runs that were read; "" if it is not a run.
std::string next_file_name(const CalibrationProduct& product, std::size_t i);
/// The number of a plan's first run file, given the names of existing runs: one more than the largest, 6 for
/// "run_5.csv".
int first_free_run(const std::vector<std::string>& names);
/// Names of next_files() for this number of runs.
std::vector<std::string> next_file_names(int first_run, int runs);
/// The page of a calibration, without network.
std::string calibration_report_html(const CalibrationProduct& product);
/// Lists the other outputs, so that the next run recognises them as files of fusee.
std::string calibration_manifest_json(const CalibrationProduct& product, const std::vector<OutputFile>& outputs);

// First lines of page and terminal.

/// The first lines of a calibration's page: at most 60 words, without identifiers.
struct Headline {
  std::string problem;  ///< the error of the joint and its size
  std::string cause;    ///< one cause, or up to three candidates; "" if there is none
  std::string action;   ///< the next step of the user
};
/// The first lines of a calibration.
Headline headline(const CalibrationProduct& product);

/// One parameter of a cause. Share and remedy are empty for further parameters of the cause, and for its rivals.
struct CauseRow {
  std::string cause;
  std::string size;
  std::string interval;      ///< 95 %, if this is the only cause
  std::string share;         ///< of the error on rows that were not fitted
  std::string corrected_by;  ///< "pulley", "table" or "–"

  /// Titles of the columns, in the order of the members.
  static constexpr std::array<const char*, 5> k_titles = {"cause", "size", "95 % if only cause", "share",
                                                          "corrected by"};
};
/// The table of causes, in the order of Calibration::effects.
std::vector<CauseRow> cause_rows(const CalibrationProduct& product);

// Texts for page and terminal.

/// "EA = 4515 N (95 %: 4479 … 4551 if it is the only cause, otherwise 4420 … 4610)": the unit is taken from the end of
/// the name; `load_unit` is that of the load column.
std::string parameter_words(const calibration::FittedParameter& parameter, const std::string& load_unit);
/// The group without the effect itself.
std::vector<std::string> rivals_of(const calibration::FoundEffect& effect);
/// States whether P1 stays round, and by how much the joint then deviates from its law.
std::string round_words(const correction::Correction& correction);
/// The reason why no corrected pulley can be made. Requires Correction::infeasible.
std::string infeasible_words(const correction::Correction& correction);
/// The assembly angle of a corrected pulley, if the correction requires another than 0.
std::string assembly_angle_words(const correction::Correction& correction);
/// Effects that were not identified, grouped by their smallest detectable size (rad, equal to two digits), smallest
/// first.
std::vector<std::pair<double, std::vector<std::string>>> detectable_groups(const calibration::Calibration& calibration);
/// The part of the unmodelled residual that the table covers, and where that holds; or why it covers none. "" if
/// nothing is unmodelled.
std::string curve_words(const CalibrationProduct& product);
/// All measurements to make next, the most decisive first.
std::vector<std::string> next_texts(const calibration::Calibration& calibration);
/// input_error_words() of every input error that would explain the data.
std::vector<std::string> input_error_texts(const CalibrationProduct& product);
/// The notes for a page. Of four or more notes that differ only in numbers, the first two are kept and the others
/// counted.
std::vector<std::string> shortened_notes(const std::vector<std::string>& notes);

// ---- Comparison -----------------------------------------------------------------------------------------------------
// Outputs of `fusee compare`, as texts and bytes.

/// The complete result of a comparison.
struct ComparisonProduct {
  MechanismFile file;
  measurement::Measurement measurement;  ///< the runs before, then the runs after
  std::size_t runs_before = 0;           ///< number of the runs before
  calibration::Comparison comparison;
};

/// The document of a comparison, with a schema number.
std::string comparison_json(const ComparisonProduct& product);
/// The page of a comparison, without network.
std::string comparison_report_html(const ComparisonProduct& product);
/// Lists the other outputs, so that the next run recognises them as files of fusee.
std::string comparison_manifest_json(const ComparisonProduct& product, const std::vector<OutputFile>& outputs);

/// The answer in at most 60 words, without identifiers: the change, its size and the remedy.
std::string comparison_words(const ComparisonProduct& product);
/// The change that these runs detect, whatever its cause: the largest of the smallest detectable changes, rms at the
/// joint, rad; 0 if none was computed.
double certainly_detected(const calibration::Comparison& comparison);

/// A row of the table of changes.
struct ChangeRow {
  std::string cause;      ///< "pretension of tendon 1"
  std::string change;     ///< "−4.20 N"
  std::string states;     ///< "20.0 → 15.8"
  std::string interval;   ///< "−4.60 … −3.80 N"
  std::string share;      ///< "98 %": StateChange::share; only in an effect's first row
  std::string as_likely;  ///< the other members of its group; only in an effect's first row
};
/// The table of changes, the largest first.
std::vector<ChangeRow> change_rows(const ComparisonProduct& product);

// ---- Simulation -----------------------------------------------------------------------------------------------------
// The outputs of `fusee simulate`, as bytes.

/// A joint moved through a log.
struct Simulation {
  MechanismFile file;
  measurement::Measurement log;           ///< one run that drove the joint
  std::vector<joint::JointState> states;  ///< parallel to its rows
};

/// A column of the table, whose name ends with its unit; NaN for missing numbers.
struct SimulationColumn {
  std::string name;
  std::vector<double> values;
};
/// The columns of the table, which ends with `status`, in its order. theta_deg: reading of the joint's sensor.
/// joint_deg: true joint angle. loose_deg: range about it without a restoring torque. tension1_N and tension2_N:
/// between pulley and pin; tension1_joint_N and tension2_joint_N: between pin and joint. The motor's torque is positive
/// towards +α. time_s, temperature_C and the encoder offsets appear if they were logged. A joint declared by a ratio
/// has no tensions and no torque.
std::vector<SimulationColumn> simulation_columns(const Simulation& simulation);
/// "held", "loose" (both tendons are slack), "no_equilibrium" (no joint angle carries the load).
std::string_view word(joint::EquilibriumStatus status);
/// A table that `fusee calibrate` reads.
std::string simulation_csv(const Simulation& simulation);

}  // namespace fusee::formats
