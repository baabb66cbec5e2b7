/// \file
/// Table of the faults that the rig can simulate. rad, mm, N, s.
///
/// Rows stand by their place in the chain: motor_faults.cpp, tendon_faults.cpp, joint_faults.cpp, sensor_faults.cpp.
/// A split is the purpose of a row:
/// - `named`: an effect of the catalogue that every joint with tendons has;
/// - `wide`: an effect of a part that some joints have: drum, attachments, idlers, sheaths. Random joints draw none;
/// - `tuning`: unmodelled; thresholds may be tuned on it;
/// - `regression`: unmodelled, from a used-up held-out set, for the joints listed in CMakeLists.txt;
/// - `heldout_13`: unmodelled, written without knowledge of the inference. Run once, never tuned on.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "rig/rig.h"

namespace fusee::rig {

/// The random properties of a fault other than its size. Constant within a case.
struct Character {
  double sign = 1;
  double angle = 0;  ///< 0 … 2π
  double share = 0;  ///< 0 … 1
};

/// Arguments from which the numbers of an action are computed.
struct Draw : Character {
  double size = 0;
  const MadeJoint& joint;

  double pretension() const { return joint.declared.tendon.pretension; }
  /// An angle in the middle 60 % of the declared range, by `share`.
  double alpha_within() const { return within(joint.alpha_min, joint.alpha_max); }
  double theta_within() const { return within(joint.declared.joint.theta_min, joint.declared.joint.theta_max); }

 private:
  double within(double low, double high) const { return low + (0.2 + 0.6 * share) * (high - low); }
};

/// The list of HiddenFaults to which an action belongs.
enum class Place {
  shaft,
  one_tendon,  ///< tendon 2; tendon 1 if the character's sign is negative
  tendon_2,
  both_tendons,  ///< the action reads Moment::side
  joint_torque,
  dry_friction,
  load,
  reading,
};

/// Reported parameters, (name, value in its unit).
using Numbers = std::vector<std::pair<std::string, double>>;

/// Either sets members of HiddenFaults (`set`) or adds an action (`act`) at `place`.
struct Fault {
  std::string split;
  std::string name;
  double first = 0;  ///< initial size of the search, in the fault's own unit
  double most = 0;   ///< largest plausible size
  void (*set)(HiddenFaults&, double size, const Character&, const MadeJoint&) = nullptr;
  /// Catalogue effects that are physically almost the same. If the fault is unmodelled or left out of the catalogue, a
  /// report of one of them is no false positive.
  std::vector<std::string> kin = {};
  Numbers (*numbers)(const HiddenFaults&, const MadeJoint&) = nullptr;  ///< true values of the report; null: none
  double least_seen = 3;  ///< smallest change of the reading, rms per noise rms
  Place place = Place::shaft;
  std::vector<double> (*parameters)(const Draw&) = nullptr;  ///< numbers of the action; null: the size
  double (*act)(const Moment&, const std::vector<double>& numbers, std::vector<double>& memory) = nullptr;

  void apply(HiddenFaults& hidden, double size, const Character& character, const MadeJoint& joint) const;
};

/// All rows in the order of the chain, names being unique.
const std::vector<Fault>& all_faults();
/// InputError with the nearest name for an unknown fault.
const Fault& find_fault(const std::string& name);
/// Rows of a split in their order. InputError for an unknown split.
std::vector<Fault> faults_in(const std::string& split);
std::vector<std::string> names_in(const std::string& split);

}  // namespace fusee::rig
