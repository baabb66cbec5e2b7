/// \file
/// Kinds of faults, in lists: effects of the catalogue, unmodelled faults, and held-out sets of the latter. rad, mm, N,
/// s.
///
/// A new held-out set is a file heldout_NN.cpp with one function, declared here, and a line in fault_lists().
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "rig/rig.h"

namespace fusee::rig {

/// What a fault is like but for its size: fixed for a case.
struct Character {
  double sign = 1;
  double angle = 0;  ///< within a turn
  double share = 0;  ///< within 0 … 1
};

/// Everything that the numbers of an action depend on.
struct Draw : Character {
  double size = 0;
  const MadeJoint& joint;

  double pretension() const { return joint.declared.tendon.pretension; }
  /// A place within the middle 60 % of the declared stroke, and of the declared range.
  double alpha_within() const { return within(joint.alpha_min, joint.alpha_max); }
  double theta_within() const { return within(joint.declared.joint.theta_min, joint.declared.joint.theta_max); }

 private:
  double within(double low, double high) const { return low + (0.2 + 0.6 * share) * (high - low); }
};

/// The place in the joint's chain at which an action acts: a list of Hidden.
enum class Place {
  shaft,
  one_tendon,  ///< tendon 2, or tendon 1 where the character's sign is negative
  tendon_2,
  both_tendons,  ///< the action asks Moment::side which one
  joint_torque,
  dry_friction,
  load,
  reading,
};

/// Numbers of a report by their names there, in its units.
using Numbers = std::vector<std::pair<std::string, double>>;

struct Fault {
  std::string name;
  double first = 0;  ///< a size to begin the search with, in a unit of the fault's own
  double most = 0;   ///< nobody would build worse
  /// Null: `act` acts at `place` instead, with the numbers that `parameters` makes.
  void (*set)(Hidden&, double size, const Character&, const MadeJoint&) = nullptr;
  /// Effects that are, physically, nearly the same: to report one of them is no false positive where the fault is
  /// unmodelled, or left out of the catalogue.
  std::vector<std::string> kin = {};
  Numbers (*numbers)(const Hidden&, const MadeJoint&) = nullptr;  ///< what a report should say; null: not a number
  double least_seen = 3;                                          ///< in the noise's rms
  Place place = Place::shaft;
  double (*act)(const Moment&, const std::vector<double>& numbers, std::vector<double>& memory) = nullptr;
  std::vector<double> (*parameters)(const Draw&) = nullptr;

  void apply(Hidden& hidden, double size, const Character& character, const MadeJoint& joint) const;
};

/// Short names for the lists of faults, which are tables.
namespace short_names {
using H = Hidden;
using C = Character;
using D = Draw;
using J = MadeJoint;
using N = std::vector<double>;
}  // namespace short_names

/// A row of a table: an action at a place.
Fault acting(const char* name, double first, double most, Place place, decltype(Fault::act) act,
             decltype(Fault::parameters) parameters, std::vector<std::string> kin = {});

struct FaultList {
  std::string split;  ///< "named", "wide", or a split of unmodelled faults
  std::vector<Fault> faults;
  std::string seed_word = split;  ///< random_truth() draws by it: a split that is renamed keeps its joints
};

/// Every effect of the catalogue by its name, in the order of the chain.
std::vector<Fault> named_faults();
/// Effects of parts that only joints of the wider class have: drum, attachments, idlers, sheaths. A list of its own,
/// since random joints draw their faults from the other one.
std::vector<Fault> wide_faults();
/// Unmodelled faults that thresholds may be tuned on.
std::vector<Fault> tuning_faults();
/// Unmodelled faults of used-up held-out sets, on joints that calibration once got wrong.
std::vector<Fault> regression_faults();
/// Unmodelled faults, written by someone who knew neither the inference nor its results: run once, never tuned on.
std::vector<Fault> heldout_13_faults();

/// The faults of several lists as one, in their order.
std::vector<Fault> joined(const std::vector<std::vector<Fault>>& lists);

/// All lists, the named one first.
const std::vector<FaultList>& fault_lists();
/// InputError, with the nearest name, where there is none.
const Fault& find_fault(const std::string& name);
/// InputError for a split that there is not.
const FaultList& find_split(const std::string& split);
/// Names in a list. InputError for a split that there is not.
std::vector<std::string> names_in(const std::string& split);

}  // namespace fusee::rig
