/// \file
/// Joints with known faults of a size that is well seen: what the known-truth matrix is made of.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "rig/faults.h"
#include "rig/protocols.h"
#include "rig/random.h"
#include "rig/rig.h"

namespace fusee::rig {

/// A kind of truth: one row of the matrix.
struct Truth {
  std::string name;
  std::vector<std::string> faults;  ///< names of fault_names(); none: a joint as declared
};

/// Every effect of the catalogue by its name, then those that no catalogue holds.
std::vector<std::string> fault_names();
/// Whether calibration has a name for it.
bool has_name(const std::string& fault);
/// Fault::kin.
std::vector<std::string> kin_of(const std::string& fault);

/// The truth of this name: "nothing", or names of faults joined by " + ". InputError for a fault that there is not.
Truth truth_of(const std::string& name);

/// Nothing at all (three kinds of noise), every fault with a name or for tuning alone, and pairs.
std::vector<Truth> all_truths();

/// Nothing, and every fault of the wide list that this joint can have, alone; where its grooves climb, those with a
/// name too.
std::vector<Truth> wide_truths(const MadeJoint& joint);

/// What a joint drawn at random is like.
enum class Kind {
  nothing,
  one,  ///< with a name
  two,  ///< both with names
  three,
  unknown,  ///< one without a name
  beside,   ///< one with a name and one without
};
/// Drawn by the seed. `split`: where faults without a name are taken from.
Truth random_truth(Kind kind, const std::string& split, std::uint64_t seed);

enum class Protocol { full, single, random };

struct CaseOptions {
  Protocol protocol = Protocol::full;
  bool any_groove = false;           ///< the groove's friction is 0.05 … 0.5 while the file says 0.2
  const MadeJoint* joint = nullptr;  ///< this one, and none drawn at random; loads are those that its tendons bear
};

/// A joint, its fault and its data.
struct Case {
  std::string truth;
  std::vector<std::string> faults;
  std::uint64_t seed = 0;
  MadeJoint joint;
  Hidden hidden;
  SensorPlan sensors;
  std::vector<RunPlan> plans;
  MotionPlan motion;
  std::vector<double> seen;  ///< by how much each fault alone moves the reading, rms in units of the sensor's noise
  std::vector<Log> logs;
};

/// Joint, size, character, programme and kind of sensor by the seed; a joint on which the fault cannot be made visible
/// is drawn again. The truth stays the same joint whatever other truths there are.
Case make_case(const Truth& truth, std::uint64_t seed, const CaseOptions& options = {});

/// A joint of which a pulley can be made: 40 … 160 mm.
MadeJoint random_joint(Random& random);

/// truth.json, spec.toml and run_1.csv … of a case, as (name, text).
std::vector<std::pair<std::string, std::string>> files_of(const Case& made);

}  // namespace fusee::rig
