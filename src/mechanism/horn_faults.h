/// \file
/// Internal: contradictions and omissions in [horn]. Geometric conditions (webs between holes, room in the pulley) are
/// checked by solid.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fusee/mechanism.h"

namespace fusee {

struct HornFault {
  std::string_view key;  ///< key of [horn] that the fault refers to
  std::string message;
  std::string hint;
};

std::vector<HornFault> faults_of(const Horn& horn);

}  // namespace fusee
