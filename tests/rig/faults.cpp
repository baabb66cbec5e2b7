#include "rig/faults.h"

#include <algorithm>

#include "fusee/base/diagnostics.h"
#include "fusee/base/text.h"

namespace fusee::rig {

std::vector<Fault> joined(const std::vector<std::vector<Fault>>& lists) {
  std::vector<Fault> all;
  for (const std::vector<Fault>& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

const std::vector<FaultList>& fault_lists() {
  static const std::vector<FaultList> lists = {
      {"named", named_faults()},           {"wide", wide_faults()},
      {"tuning", tuning_faults()},         {"unseen", unseen_faults()},
      {"sealed", sealed_faults()},         {"withheld", withheld_faults()},
      {"reserved", reserved_faults()},     {"unopened", unopened_faults()},
      {"unread", unread_faults()},         {"untold", untold_faults()},
      {"unmet", unmet_faults()},           {"unheard", unheard_faults()},
      {"unforeseen", unforeseen_faults()}, {"unimagined", unimagined_faults()},
      {"undreamt", undreamt_faults()},     {"unsuspected", unsuspected_faults()},
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

std::vector<std::string> names_in(const std::string& split) {
  for (const FaultList& list : fault_lists()) {
    if (list.split != split) continue;
    std::vector<std::string> names;
    for (const Fault& fault : list.faults) names.push_back(fault.name);
    return names;
  }
  throw InputError("rig", "there is no split '" + split + "' of the faults");
}

}  // namespace fusee::rig
