#include "rig/faults.h"

#include <algorithm>
#include <utility>

#include "base/text.h"
#include "fusee/base.h"
#include "rig/fault_table.h"

namespace fusee::rig {

void Fault::apply(HiddenFaults& hidden, double size, const Character& character, const MadeJoint& joint) const {
  if (set != nullptr) return set(hidden, size, character, joint);
  const Action action{name, parameters != nullptr ? parameters({character, size, joint}) : std::vector{size}, act};
  const auto add = [&action](std::vector<Action>& list) { list.push_back(action); };
  // clang-format off
  switch (place) {
    case Place::shaft: return add(hidden.shaft);
    case Place::one_tendon: return add(hidden.longer[character.sign > 0 ? 1 : 0]);
    case Place::tendon_2: return add(hidden.longer[1]);
    case Place::both_tendons: return add(hidden.longer[0]), add(hidden.longer[1]);
    case Place::joint_torque: return add(hidden.torque);
    case Place::dry_friction: return add(hidden.dry);
    case Place::load: return add(hidden.load);
    case Place::reading: return add(hidden.reading);
  }
  // clang-format on
}

const std::vector<Fault>& all_faults() {
  using namespace fault_table;
  static const std::vector<Fault> faults = [] {
    std::vector<Fault> all = motor_faults();
    for (const auto list : {tendon_faults, joint_faults, sensor_faults}) {
      for (Fault& fault : list()) all.push_back(std::move(fault));
    }
    return all;
  }();
  return faults;
}

const Fault& find_fault(const std::string& name) {
  std::vector<std::string> names;
  for (const Fault& fault : all_faults()) {
    if (fault.name == name) return fault;
    names.push_back(fault.name);
  }
  throw InputError("rig", "there is no fault '" + name + "'", nearest_word(name, names));
}

std::vector<Fault> faults_in(const std::string& split) {
  std::vector<Fault> faults;
  for (const Fault& fault : all_faults()) {
    if (fault.split == split) faults.push_back(fault);
  }
  if (faults.empty()) throw InputError("rig", "there is no split '" + split + "' of the faults");
  return faults;
}

std::vector<std::string> names_in(const std::string& split) {
  std::vector<std::string> names;
  for (const Fault& fault : faults_in(split)) names.push_back(fault.name);
  return names;
}

}  // namespace fusee::rig
