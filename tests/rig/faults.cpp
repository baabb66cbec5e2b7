#include "rig/faults.h"

#include <algorithm>
#include <utility>

#include "fusee/base/diagnostics.h"
#include "fusee/base/text.h"

namespace fusee::rig {

void Fault::apply(Hidden& hidden, double size, const Character& character, const MadeJoint& joint) const {
  if (set != nullptr) return set(hidden, size, character, joint);
  const Action action{name, parameters({character, size, joint}), act};
  switch (place) {
    case Place::shaft:
      hidden.shaft.push_back(action);
      break;
    case Place::one_tendon:
      hidden.longer[character.sign > 0 ? 1 : 0].push_back(action);
      break;
    case Place::tendon_2:
      hidden.longer[1].push_back(action);
      break;
    case Place::both_tendons:
      for (std::vector<Action>& longer : hidden.longer) longer.push_back(action);
      break;
    case Place::joint_torque:
      hidden.torque.push_back(action);
      break;
    case Place::dry_friction:
      hidden.dry.push_back(action);
      break;
    case Place::load:
      hidden.load.push_back(action);
      break;
    case Place::reading:
      hidden.reading.push_back(action);
      break;
  }
}

Fault acting(const char* name, double first, double most, Place place, decltype(Fault::act) act,
             decltype(Fault::parameters) parameters, std::vector<std::string> kin) {
  Fault fault{.name = name, .first = first, .most = most, .kin = std::move(kin)};
  fault.place = place, fault.act = act, fault.parameters = parameters;
  return fault;
}

std::vector<Fault> joined(const std::vector<std::vector<Fault>>& lists) {
  std::vector<Fault> all;
  for (const std::vector<Fault>& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

const std::vector<FaultList>& fault_lists() {
  static const std::vector<FaultList> lists = {
      {"named", named_faults()},
      {"wide", wide_faults()},
      {"tuning", tuning_faults()},
      {"regression", regression_faults()},
      {"heldout_13", heldout_13_faults(), "unsuspected"},  // its name when its joints were run
  };
  return lists;
}

const Fault& find_fault(const std::string& name) {
  std::vector<std::string> names;
  for (const FaultList& list : fault_lists()) {
    for (const Fault& fault : list.faults) {
      if (fault.name == name) return fault;
      names.push_back(fault.name);
    }
  }
  throw InputError("rig", "there is no fault '" + name + "'", nearest_word(name, names));
}

const FaultList& find_split(const std::string& split) {
  const std::vector<FaultList>& lists = fault_lists();
  const auto found =
      std::find_if(lists.begin(), lists.end(), [&](const FaultList& list) { return list.split == split; });
  if (found == lists.end()) throw InputError("rig", "there is no split '" + split + "' of the faults");
  return *found;
}

std::vector<std::string> names_in(const std::string& split) {
  std::vector<std::string> names;
  for (const Fault& fault : find_split(split).faults) names.push_back(fault.name);
  return names;
}

}  // namespace fusee::rig
