/// \file
/// A physical way in which a joint can differ from its mechanism file: where it sits, what it does, what its numbers
/// are called, what a correction does with it.
///
/// An effect is one file, src/mechanism/effects/NAME.cpp, with one function `Effect NAME(JointKind)`: the build finds
/// it there, the mechanism file's [identified] table gets its keys, `fusee calibrate` looks for it.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fusee/mechanism/mechanism.h"

namespace fusee {

/// Where in the chain from motor to sensor.
enum class ChainPlace { motor_sensor, shaft, pulley, tendon, sheath, pins, joint, joint_sensor };
std::string_view word(ChainPlace place);  ///< "motor sensor"

/// What takes the error out that an effect makes.
enum class CorrectableBy { nothing, table, pulley };
std::string_view word(CorrectableBy remedy);  ///< "pulley", "table" or ""

/// Joints that are declared with tendons, guides and pulley, and joints declared by a ratio alone.
enum class JointKind { tendons, ratio };
JointKind kind_of(const Mechanism& mechanism);

/// What a corrected file does with a number that an earlier calibration found: that part of it is in the expected joint
/// of the file, which the new one was found against.
enum class WhenFoundAgain {
  anew,        ///< no mechanism has it: the new finding is the whole
  added,       ///< before + found
  compounded,  ///< (1 + before)(1 + found) − 1
};

/// How a number stands in [identified]: what the field table needs for it.
struct IdentifiedKey {
  std::string_view name;     ///< "guide_radius_mm": the unit stands in it
  std::string_view unit;     ///< as Field::unit
  std::string_view meaning;  ///< one line
  double least = 0;          ///< in that unit
  double most = 0;
  double (*to_file)(double) = nullptr;    ///< from rad, mm, N
  double (*from_file)(double) = nullptr;  ///< back
  std::string_view fallback = "0";
};

/// What a person read with a caliper: by how much the joint differs from its file, and how sure that is.
struct CaliperReading {
  double value = 0;        ///< of the number
  double uncertainty = 0;  ///< standard
};

/// Instrument that a number is read with.
enum class HandTool { caliper, dial_gauge, mark, motor_sensor, protractor, ruler };
std::string_view word(HandTool tool);  ///< "dial_gauge"

/// How a number can be read by hand.
struct ByHand {
  std::string_view words;  ///< what to measure and what to write; empty: it cannot
  double uncertainty = 0;  ///< of such a reading, as a rule
  /// The entry of the number in [prior] of the file.
  std::vector<CaliperReading> (*readings)(const DeclaredMechanism& declared) = nullptr;
  std::string_view key = {};  ///< of the file, into which it is written: "prior.guide_radius_mm"
  HandTool tool = HandTool::caliper;
  /// The reading of a joint, where other numbers than its own are in it too; null: the number itself.
  double (*read)(const Imperfections& joint, const Mechanism& declared) = nullptr;
};

/// What a number below and above zero says of the joint, where its sign alone does not: "both pulleys too small".
struct SignWords {
  std::string_view below;
  std::string_view above;
};

/// The unit of load is the log's, so that numbers with it have no size of their own.
enum class PriorUnit { own, at_largest_load, of_largest_load };

struct EffectParameter {
  std::string name;  ///< as reported, the unit stands in it: "EA_N"
  /// What it does to the joint: it is this number of it.
  double& (*number)(Imperfections& joint) = nullptr;
  double least = 0;  ///< bounds of the number
  double most = 0;
  double step = 0;  ///< a change of the number that a sensor may just see: the scale of the fit
  /// How large it is in practice: the standard deviation over joints that people build, in the number's own unit, as
  /// good as declared in the middle. Positive, but 0 where the number is searched.
  double prior = 0;
  /// Unit of the prior: that of the number; of a number per unit of load, what the largest load makes of it; or of a
  /// number that is a load, a share of the largest.
  PriorUnit prior_unit = PriorUnit::own;
  /// From the number to what is reported; may fall where the number grows.
  double (*shown)(double value, const Mechanism& declared) = nullptr;
  IdentifiedKey key;
  WhenFoundAgain again = WhenFoundAgain::anew;
  ByHand by_hand = {};
  SignWords sign = {};
  bool searched = false;  ///< not fitted: only the values in Effect::starts are tried
  /// Whether the effect's other numbers leave it nothing to do, whatever it is: it is then reported as 0; null: never.
  bool (*idle)(const Imperfections& joint) = nullptr;
  double gone = 0;  ///< where the joint has none of it: of a change, minus what there was
};

/// The prior in the number's own unit. `largest_load`: the log's largest magnitude; 0 where there is none.
double prior_of(const EffectParameter& parameter, double largest_load);
bool is_idle(const EffectParameter& parameter, const Imperfections& joint);
/// As reported, of that joint.
double shown_value(const EffectParameter& parameter, const Imperfections& joint, const Mechanism& declared);

/// A number of `joint` as a person would read it by hand.
double reading_by_hand(const EffectParameter& parameter, const Imperfections& joint, const Mechanism& declared);

/// The number of `joint` that a parameter is.
double value_of(const Imperfections& joint, const EffectParameter& parameter);
void set_value(Imperfections& joint, const EffectParameter& parameter, double value);
/// As declared.
void reset(Imperfections& joint, const EffectParameter& parameter);

/// What must be logged for an effect to be seen at all.
struct Needs {
  bool tendons = false;  ///< the joint is declared with its tendons
  bool ratio = false;    ///< the joint is declared by a ratio
  bool drum = false;     ///< the joint has a drum, and a tendon lies on it somewhere in the range
  bool end1 = false;     ///< tendon 1 has an attachment of its own, and is free of any drum somewhere in the range
  bool end2 = false;     ///< the same of tendon 2
  bool pins = false;     ///< tendons slide over their guides
  bool idlers = false;   ///< tendons turn them
  bool sheath = false;   ///< tendons run through sheaths
  bool time = false;
  bool load = false;         ///< declared or logged
  bool temperature = false;  ///< that changes
  /// What comes back once per turn of the motor is told from any other smooth curve only where it turns far enough: no
  /// plan is made for it on less. In data it stands beside all that is as smooth.
  bool full_turn = false;
};

struct Effect {
  std::string name;
  ChainPlace place = ChainPlace::joint;
  int rank = 0;                ///< among the effects of a place, in the order of the chain
  std::string signature;       ///< how data show it
  std::string separating_run;  ///< the measurement that tells it from its rivals
  CorrectableBy correctable_by = CorrectableBy::nothing;
  std::vector<EffectParameter> parameters;
  std::vector<std::vector<double>> starts;  ///< of the fit, beside zero; one value a parameter
  bool starts_in_time = false;  ///< and wherever the residual steps: size and time are the first two parameters
  bool sticks = false;          ///< holds the joint where it is until more pushes: a slope or a chord says little of it
  bool loosens = false;         ///< leaves the joint free within a play: where in it it rests, any reading says
  Needs needs;
  bool is_looked_for = true;  ///< by calibrate and plan; else it is simulated where a file has it in [identified]
  /// What stays of it when `before` was found earlier and `joint` now, into `joint`, where WhenFoundAgain does not say
  /// it all; null: it does.
  void (*found_again)(const Imperfections& before, Imperfections& joint) = nullptr;
};

/// All effects that a kind of joint can have, in the order of the chain. They live as long as the program.
std::span<const Effect> effects(JointKind kind);
/// By name, or null.
const Effect* find_effect(std::string_view name, JointKind kind);

/// Both findings as one: of all effects what WhenFoundAgain says.
Imperfections found_again(const Imperfections& before, const Imperfections& found, JointKind kind);
/// The joint `before` with `change` added, number by number and within the bounds of each. A number that is searched is
/// that of the change where its effect changes, and else that of `before`.
Imperfections changed(const Imperfections& before, const Imperfections& change, JointKind kind);
/// What stays of `found` where the expected joint of the corrected file has, or undoes, what a mechanism can have.
Imperfections beyond_mechanism(const Imperfections& found, JointKind kind);

/// From numbers to what is reported.
namespace shown {
inline double as_is(double value, const Mechanism&) { return value; }
inline double in_degrees(double value, const Mechanism&) { return degrees(value); }
inline double in_percent(double value, const Mechanism&) { return 100.0 * value; }
inline double in_ms(double value, const Mechanism&) { return 1000.0 * value; }
inline double in_ppm(double value, const Mechanism&) { return 1e6 * value; }
}  // namespace shown

/// Keys of [identified] in their usual units, over the usual range.
namespace key {
IdentifiedKey plain(std::string_view name, std::string_view unit, double least, double most, std::string_view meaning);
IdentifiedKey in_degrees(std::string_view name, double least, double most, std::string_view meaning);
IdentifiedKey in_percent(std::string_view name, double least, double most, std::string_view meaning);
IdentifiedKey in_ppm(std::string_view name, std::string_view meaning);
}  // namespace key

}  // namespace fusee
