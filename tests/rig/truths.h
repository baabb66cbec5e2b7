/// \file
/// Random joints with known faults of visible size, from which the tables of known_truth are made.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "fusee/plan.h"
#include "rig/faults.h"
#include "rig/random.h"
#include "rig/rig.h"

namespace fusee::rig {

/// Runs, motion and sensors of a session.
struct Programme {
  std::vector<RunPlan> runs;
  MotionPlan motion;
  SensorPlan sensors;  ///< the caller sets its seed
};

/// Good and bad practice: 2 … 7 runs with their own loads, speeds, cycles and dwells, strokes or point to
/// point, some with loads that change within a run; noise 0.005 … 0.05°, coloured or coarse or neither.
Programme random_programme(Random& random, const MadeJoint& joint);

/// The faults of a joint.
struct Truth {
  std::string name;
  std::vector<std::string> faults;  ///< none: a joint as declared
};

/// True for effects of the catalogue. InputError for an unknown fault.
bool has_name(const std::string& fault);

/// The truth of this name: "nothing", or names of faults joined by " + ". InputError for an unknown fault.
Truth truth_of(const std::string& name);

/// Nothing (three kinds of noise), each fault of `named` and `tuning`, and pairs.
std::vector<Truth> all_truths();

/// Nothing, and each fault of `wide` that this joint can have. With helical grooves those of `named` too.
std::vector<Truth> wide_truths(const MadeJoint& joint);

/// The kinds of random joints.
enum class Kind {
  nothing,
  one,  ///< a named fault
  two,  ///< named faults
  three,
  unknown,  ///< an unmodelled fault
  beside,   ///< a named fault and an unmodelled one
};
/// Drawn by the seed. `split`: the split of the unmodelled fault.
Truth random_truth(Kind kind, const std::string& split, std::uint64_t seed);

enum class Protocol { full, single, random };

struct CaseOptions {
  Protocol protocol = Protocol::full;
  bool any_groove = false;           ///< friction of the groove is 0.05 … 0.5 while the file says 0.2
  const MadeJoint* joint = nullptr;  ///< this joint instead of a random one, with loads that its tendons bear
};

/// A joint, its faults and its data.
struct Case {
  std::string truth;
  std::vector<std::string> faults;
  std::uint64_t seed = 0;
  MadeJoint joint;
  HiddenFaults hidden;
  SensorPlan sensors;
  std::vector<RunPlan> plans;
  MotionPlan motion;
  std::vector<double> seen;  ///< movement of the reading by each fault alone, rms per noise rms
  std::vector<Log> logs;
};

/// Draws joint, size, character, programme and sensor by the seed and the truth's name, again if the fault cannot be
/// made visible on the joint. Other truths do not change a case.
Case make_case(const Truth& truth, std::uint64_t seed, const CaseOptions& options = {});

/// Noise of 0.02°, by the seed: white, correlated or coarse.
SensorPlan usual_sensors(std::uint64_t seed);

/// The size at which a fault moves the reading by a target within 15 %.
struct SizedFault {
  double size = 0;
  double moved = 0;     ///< rms, rad; 0 where the joint has no equilibrium
  bool is_met = false;  ///< the target, or the largest size without reaching it
};
/// Secant search from `first` up to `most`. `movement` of a size may throw InputError: no equilibrium.
SizedFault find_size(double first, double most, double target, int iterations,
                     const std::function<double(double)>& movement);

/// A joint of 40 … 160 mm for which a pulley exists.
MadeJoint random_joint(Random& random);

/// truth.json, spec.toml and run_1.csv … of a case, as (name, text).
std::vector<std::pair<std::string, std::string>> files_of(const Case& made);

/// Manual reading of a parameter on the rig's joint without error, in the unit of the fit.
double read_by_hand(const EffectParameter& number, const Case& made);

/// Adds a run to the case, or writes readings with their usual error into [prior] of its file. False and no change if
/// the rig cannot make the measurement.
bool perform(const plan::NextMeasurement& next, Case& made);

}  // namespace fusee::rig
