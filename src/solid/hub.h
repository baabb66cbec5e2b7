/// \file
/// Internal: the hub and its set screw.
#pragma once

#include <vector>

#include "fusee/profile.h"
#include "fusee/solid.h"

namespace fusee::solid {

/// Least distance of the hub from the upper flange's rim.
inline constexpr double k_hub_margin = 0.5;

/// Sets hub, set screw and z_hub of a layout with heights and bore. `rim_radius`: inradius of flange 2. Automatic
/// features without enough space are reduced or omitted, with a note.
void choose_hub(BodyLayout& layout, const Mechanism& mechanism, double rim_radius);

/// Conditions of a requested hub and set screw: wall about the bore, size of the flange, space for the screw.
std::vector<profile::Condition> hub_conditions(const Mechanism& mechanism, const BodyLayout& layout, double rim_radius);

}  // namespace fusee::solid
