/// \file
/// Internal: conditions of multi-turn pulleys, in addition to those of every pitch curve.
#pragma once

#include <vector>

#include "fusee/helix.h"
#include "helix/winding.h"

namespace fusee::helix {

/// Conditions on the number of turns. They need the planar curves only and are checked before winding.
std::vector<profile::Condition> turn_conditions(const Mechanism& mechanism, const transmission::Transmission& planar);
/// Conditions on the wound curves.
std::vector<profile::Condition> helix_conditions(const Mechanism& mechanism, const HelixSynthesis& made,
                                                 const Windings& windings, const HelixGroove& groove);
/// Warnings that do not prevent making: fleet angles above k_warned_fleet.
std::vector<std::string> helix_warnings(const HelixSynthesis& made);

}  // namespace fusee::helix
