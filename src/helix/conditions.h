/// \file
/// Internal: what several turns ask for beside what every curve does.
#pragma once

#include <vector>

#include "fusee/helix/synthesis.h"
#include "helix/winding.h"

namespace fusee {

/// As soon as the planar curves are known to be possible, and before they are wound: the number of turns.
std::vector<Condition> turn_conditions(const Mechanism& mechanism, const Transmission& planar);
/// Of what was wound.
std::vector<Condition> helix_conditions(const Mechanism& mechanism, const HelixSynthesis& made,
                                        const Windings& windings, const HelixGroove& groove);
std::vector<std::string> helix_warnings(const HelixSynthesis& made);

}  // namespace fusee
