/// \file
/// An effect: a physical way in which a joint can differ from its mechanism file. It has a place, parameters, a
/// signature in data and a correction.
///
/// An effect is one file, src/mechanism/effects/NAME.cpp, with one function `Effect NAME(JointKind)`. The build finds
/// it there, the file's [identified] table gets its keys, and `fusee calibrate` tests it.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fusee/mechanism.h"

namespace fusee {

/// Joints declared with tendons, guides and pulley, and joints declared by a ratio alone.
enum class JointKind { tendons, ratio };
JointKind kind_of(const Mechanism& mechanism);

/// How a corrected file combines a parameter with the value of an earlier calibration. The expected joint of the file,
/// to which the new value is relative, already contains part of the earlier value.
enum class MergeRule {
  replace,   ///< the new value: no mechanism contains the parameter
  add,       ///< before + found
  compound,  ///< (1 + before)(1 + found) − 1
};

/// The [identified] key of a parameter, for the field table.
struct IdentifiedKey {
  std::string_view name;     ///< "guide_radius_mm": includes the unit
  std::string_view unit;     ///< as Field::unit
  std::string_view meaning;  ///< explanation in one line
  double least = 0;          ///< lower bound in the file's unit
  double most = 0;
  double (*to_file)(double) = nullptr;    ///< converts from rad, mm, N
  double (*from_file)(double) = nullptr;  ///< converts back
  std::string_view fallback = "0";
};

/// A manual reading, as the deviation of the joint from its file, with its standard uncertainty.
struct ManualReading {
  double value = 0;        ///< deviation of the parameter
  double uncertainty = 0;  ///< standard uncertainty
};

/// The instrument that measures a parameter.
enum class HandTool { caliper, dial_gauge, mark, motor_sensor, protractor, ruler };
std::string_view word(HandTool tool);  ///< "dial_gauge"

/// Instructions for measuring a parameter by hand.
struct ManualMeasurement {
  std::string_view words;  ///< instruction for the user; empty: cannot be measured by hand
  double uncertainty = 0;  ///< usual standard uncertainty of such a reading
  /// Reads the parameter's entry in [prior] of the file.
  std::vector<ManualReading> (*readings)(const DeclaredMechanism& declared) = nullptr;
  std::string_view key = {};  ///< key of the file that receives the reading: "prior.guide_radius_mm"
  HandTool tool = HandTool::caliper;
  /// Predicts the reading of a joint when it depends on other parameters too; null: the reading is the parameter.
  double (*read)(const Imperfections& joint, const Mechanism& declared) = nullptr;
};

/// Descriptions of a parameter below and above zero, where the sign is not obvious: "both pulleys are too small".
struct SignWords {
  std::string_view below;
  std::string_view above;
};

/// Unit of a prior. The unit of load is known only from the log, so priors with that unit are scaled by the largest
/// load.
enum class PriorUnit { own, at_largest_load, of_largest_load };

struct EffectParameter {
  std::string name;  ///< name in reports, unit included: "EA_N"
  /// Accesses the parameter in the joint.
  double& (*number)(Imperfections& joint) = nullptr;
  double least = 0;  ///< lower bound
  double most = 0;   ///< upper bound
  double step = 0;   ///< smallest measurable change of the parameter: the scale of the fit
  /// Prior standard deviation over joints that people build, in the parameter's unit, centred on the declared value.
  /// Positive, or 0 where the parameter is searched.
  double prior = 0;
  /// Unit of the prior: the parameter's own; for a parameter per unit of load, its product with the largest load; for a
  /// parameter that is a load, a fraction of the largest load.
  PriorUnit prior_unit = PriorUnit::own;
  /// Converts the parameter to the reported value. May be decreasing.
  double (*shown)(double value, const Mechanism& declared) = nullptr;
  IdentifiedKey key;
  MergeRule merge_rule = MergeRule::replace;
  ManualMeasurement by_hand = {};
  SignWords sign = {};
  bool searched = false;  ///< not fitted: only the values in Effect::starts are tried
  /// True when the effect's other parameters make this one irrelevant; it is then reported as 0. Null: never.
  bool (*idle)(const Imperfections& joint) = nullptr;
  /// Value of a joint without the effect. For the change of a joint: minus the value of its earlier state.
  double value_if_absent = 0;
};

/// The prior in the parameter's own unit. `largest_load`: largest magnitude in the log; 0 without load.
double prior_of(const EffectParameter& parameter, double largest_load);
bool is_idle(const EffectParameter& parameter, const Imperfections& joint);
/// The reported value of the parameter in that joint.
double shown_value(const EffectParameter& parameter, const Imperfections& joint, const Mechanism& declared);

/// The reading by hand that is expected for `joint`.
double reading_by_hand(const EffectParameter& parameter, const Imperfections& joint, const Mechanism& declared);

/// The value of the parameter in `joint`.
double value_of(const Imperfections& joint, const EffectParameter& parameter);
void set_value(Imperfections& joint, const EffectParameter& parameter, double value);
/// Resets the parameter to the declared joint.
void reset(Imperfections& joint, const EffectParameter& parameter);

/// Requirements on joint and log without which an effect is not visible.
struct Needs {
  bool tendons = false;      ///< the joint is declared with its tendons
  bool ratio = false;        ///< the joint is declared by a ratio
  bool drum = false;         ///< the joint has a drum, and a tendon lies on it somewhere in the range
  bool end1 = false;         ///< tendon 1 has its own attachment, and is clear of any drum somewhere in the range
  bool end2 = false;         ///< the same for tendon 2
  bool pins = false;         ///< tendons slide over their guides
  bool idlers = false;       ///< tendons run over idlers
  bool sheath = false;       ///< tendons run through sheaths
  bool time = false;         ///< times are logged
  bool load = false;         ///< a load is declared or logged
  bool temperature = false;  ///< the temperature is logged and changes
  /// The effect is periodic in the motor's turn, which only a long stroke distinguishes from other smooth curves. Plans
  /// require that stroke (plan::k_most_linear_range); in data the effect competes with all equally smooth curves.
  bool long_stroke = false;
};

struct Effect {
  std::string name;
  ChainPlace place = ChainPlace::joint;
  int rank = 0;                ///< order among the effects of the same place
  std::string signature;       ///< appearance in data
  std::string separating_run;  ///< measurement that distinguishes it from its rivals
  CorrectableBy correctable_by = CorrectableBy::nothing;
  std::vector<EffectParameter> parameters;
  std::vector<std::vector<double>> starts;  ///< starting points of the fit besides zero; one value per parameter
  bool starts_in_time = false;  ///< also start wherever the residual steps: size and time are the first two parameters
  /// Holds the joint until a larger torque acts, so that neither derivatives nor finite differences predict it well.
  bool sticks = false;
  bool loosens = false;  ///< leaves the joint free within a play, in which any rest position is possible
  Needs needs;
  /// Tested by calibrate and plan; otherwise only simulated for files that have it in [identified].
  bool is_tested = true;
  /// Combines `before` (an earlier calibration) with `joint` (the present one) into `joint`, where MergeRule does not
  /// suffice; null: it does.
  void (*merge)(const Imperfections& before, Imperfections& joint) = nullptr;
  /// Replaces fitted numbers by equivalent ones in which each means what its name says; null: they do.
  void (*settle)(Imperfections& joint, const Mechanism& declared) = nullptr;
};

/// All effects of a kind of joint, in the order of the chain. They live as long as the program.
std::span<const Effect> effects(JointKind kind);
/// Finds an effect by name; null when there is none.
const Effect* find_effect(std::string_view name, JointKind kind);

/// Combines the values of two calibrations by each parameter's MergeRule.
Imperfections merge_findings(const Imperfections& before, const Imperfections& found, JointKind kind);
/// The joint `before` plus `change`, parameter by parameter and clamped to the bounds. A searched parameter is taken
/// from `change` if its effect changes, otherwise from `before`.
Imperfections changed(const Imperfections& before, const Imperfections& change, JointKind kind);
/// The part of `found` that no mechanism contains: without the deviations that the expected joint of the corrected file
/// contains or compensates.
Imperfections beyond_mechanism(const Imperfections& found, JointKind kind);

/// Conversions from parameters to reported values.
namespace shown {
inline double as_is(double value, const Mechanism&) { return value; }
inline double in_degrees(double value, const Mechanism&) { return degrees(value); }
inline double in_percent(double value, const Mechanism&) { return 100.0 * value; }
inline double in_ms(double value, const Mechanism&) { return 1000.0 * value; }
inline double in_ppm(double value, const Mechanism&) { return 1e6 * value; }
}  // namespace shown

/// Keys of [identified] in the usual units and ranges.
namespace key {
IdentifiedKey plain(std::string_view name, std::string_view unit, double least, double most, std::string_view meaning);
IdentifiedKey in_degrees(std::string_view name, double least, double most, std::string_view meaning);
IdentifiedKey in_percent(std::string_view name, double least, double most, std::string_view meaning);
IdentifiedKey in_ppm(std::string_view name, std::string_view meaning);
}  // namespace key

}  // namespace fusee
