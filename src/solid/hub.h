/// \file
/// The hub and its set screw, made to fit.
#pragma once

#include <vector>

#include "fusee/profile/synthesis.h"
#include "fusee/solid/layout.h"

namespace fusee {

/// The hub must stay this far inside the upper flange's rim.
inline constexpr double k_hub_margin = 0.5;

/// Sets hub, set screw and z_hub of a layout that has its heights and bore; `rim_radius` is the inradius of flange 2.
/// What is automatic is made smaller or left out where there is no room for it, with a note.
void choose_hub(BodyLayout& layout, const Mechanism& mechanism, double rim_radius);

/// What a hub and a screw that were asked for need: about the bore, on that flange, for the screw.
std::vector<Condition> hub_conditions(const Mechanism& mechanism, const BodyLayout& layout, double rim_radius);

}  // namespace fusee
