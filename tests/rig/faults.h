/// \file
/// Kinds of faults, in lists: those that calibration has a name for, and splits of those that it has none for. rad, mm,
/// N, s.
///
/// A new split is a function like tuning_faults() in a file of its own, and a line in fault_lists().
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

/// Numbers of a report by their names there, in its units.
using Numbers = std::vector<std::pair<std::string, double>>;

struct Fault {
  std::string name;
  double first = 0;  ///< a size to begin the search with, in a unit of the fault's own
  double most = 0;   ///< nobody would build worse
  void (*set)(Hidden&, double size, const Character&, const MadeJoint&) = nullptr;
  /// Named effects that are, physically, nearly the same: to report one of them is not held to be false blame where the
  /// fault has no name, or none in the catalogue at hand.
  std::vector<std::string> kin = {};
  Numbers (*numbers)(const Hidden&, const MadeJoint&) = nullptr;  ///< what a report should say; null: not a number
  double least_seen = 3;                                          ///< in the noise's rms
};

/// Short names for the lists of faults, which are tables.
namespace short_names {
using H = Hidden;
using C = Character;
using J = MadeJoint;
using N = std::vector<double>;
}  // namespace short_names

struct FaultList {
  std::string split;  ///< "named", "wide", or the split of faults without a name
  std::vector<Fault> faults;
};

/// Every effect of the catalogue by its name, in the order of the chain.
std::vector<Fault> named_faults();
/// The same of parts that only joints of the wider class have: drum, attachments, idlers, sheaths. A list of its own:
/// which faults random joints have is drawn from the other.
std::vector<Fault> wide_faults();
/// Without a name: those that thresholds may be tuned on.
std::vector<Fault> tuning_faults();
/// Without a name, and by another hand: kept aside, nothing is tuned on them and they are run once.
std::vector<Fault> unseen_faults();
/// Without a name, by a third hand: kept aside as the unseen ones are, and run once after all else is settled.
std::vector<Fault> sealed_faults();
/// Without a name, by a fourth hand: kept aside, and run once after all else is settled.
std::vector<Fault> withheld_faults();
/// Without a name, by a fifth hand: kept aside, and run once after all else is settled.
std::vector<Fault> reserved_faults();
/// Without a name, by a sixth hand: kept aside, and run once after all else is settled.
std::vector<Fault> unopened_faults();
/// Without a name, by a seventh hand: kept aside, and run once after all else is settled.
std::vector<Fault> unread_faults();
/// Without a name, by an eighth hand: kept aside until its first joints were looked at, and tuned on since.
std::vector<Fault> untold_faults();
/// Without a name, by a ninth hand: kept aside until they were run once, and tuned on since.
std::vector<Fault> unmet_faults();
/// Without a name, by a tenth hand: kept aside, and run once after all else is settled.
std::vector<Fault> unheard_faults();
/// Without a name, by an eleventh hand: kept aside, and run once after all else is settled.
std::vector<Fault> unforeseen_faults();
/// Without a name, by a twelfth hand: kept aside, and run once after all else is settled.
std::vector<Fault> unimagined_faults();
/// Without a name, by a thirteenth hand: kept aside, and run once after all else is settled.
std::vector<Fault> undreamt_faults();
/// Without a name, by a fourteenth hand: kept aside, and run once after all else is settled.
std::vector<Fault> unsuspected_faults();

/// The faults of several lists as one, in their order.
std::vector<Fault> joined(const std::vector<std::vector<Fault>>& lists);

/// All lists, the named one first.
const std::vector<FaultList>& fault_lists();
/// InputError, with the nearest name, where there is none.
const Fault& find_fault(const std::string& name);
/// Names in a list. InputError for a split that there is not.
std::vector<std::string> names_in(const std::string& split);

}  // namespace fusee::rig
