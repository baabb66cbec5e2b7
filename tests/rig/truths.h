/// \file
/// Joints with a known fault of a size that is well seen: what the known-truth matrix is made of.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

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
/// Named effects that do nearly the same as a fault without a name: to report one of them is not held to be false
/// blame.
std::vector<std::string> kin_of(const std::string& fault);

/// Nothing at all (three kinds of noise), every fault alone, and pairs.
std::vector<Truth> all_truths();

enum class Protocol { full, single };

/// A joint, its fault and its data.
struct Case {
  std::string truth;
  std::vector<std::string> faults;
  std::uint64_t seed = 0;
  MadeJoint joint;
  Hidden hidden;
  SensorPlan sensors;
  std::vector<RunPlan> plans;
  std::vector<double> seen;  ///< by how much each fault alone moves the reading, rms in units of the sensor's noise
  std::vector<Log> logs;
};

/// Joint, size, character and kind of sensor by the seed; a joint on which the fault cannot be made visible is drawn
/// again. The truth stays the same joint whatever other truths there are.
Case make_case(const Truth& truth, std::uint64_t seed, Protocol protocol);

/// A joint of which a pulley can be made: 40 … 160 mm.
MadeJoint random_joint(Random& random);

/// truth.json, spec.toml and run_1.csv … of a case, as (name, text).
std::vector<std::pair<std::string, std::string>> files_of(const Case& made);

}  // namespace fusee::rig
