/// \file
/// Internal: the hub and its set screw.
#pragma once

#include <vector>

#include "fusee/profile.h"
#include "fusee/solid.h"

namespace fusee::solid {

/// Least distance of the hub from the upper flange's rim, mm.
inline constexpr double k_hub_margin = 0.5;

/// A hub that fits on the upper flange, and its set screw if it has one. Radius 0: no hub. mm
struct HubChoice {
  double radius = 0;
  SetScrewLayout set_screw = {};
};

/// Radius of the smallest automatic hub: the wall around the shaft carries the torque. mm
double least_hub_radius(const BodyLayout& layout);

/// The possible hubs for a layout with heights and bore, the largest first. An automatic hub follows the shaft and the
/// screw: M3 to M2, with a nut or with its thread in the hub, then without a screw, then no hub. If a diameter or a
/// screw is requested, only the other varies. `rim_radius`: inradius of flange 2. Never empty.
std::vector<HubChoice> hub_choices(const BodyLayout& layout, const Mechanism& mechanism, double rim_radius);

/// Sets hub, set screw and z_hub of a layout. Notes what is omitted or reduced.
void set_hub(BodyLayout& layout, const Mechanism& mechanism, const HubChoice& choice);

/// Conditions of a requested hub and set screw: wall about the bore, size of the flange, space for the screw.
std::vector<profile::Condition> hub_conditions(const Mechanism& mechanism, const BodyLayout& layout, double rim_radius);

}  // namespace fusee::solid
