/// \file
/// Internal: what of [horn] contradicts itself or is missing. Whether its holes leave webs between them, and the pulley
/// room for it, is for the body's conditions to say.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fusee/mechanism/mechanism.h"

namespace fusee {

struct HornFault {
  std::string_view key;  ///< of [horn], at which it is said
  std::string message;
  std::string hint;
};

std::vector<HornFault> faults_of(const Horn& horn);

}  // namespace fusee
