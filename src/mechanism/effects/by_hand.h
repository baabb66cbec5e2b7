/// \file
/// Internal: common parts of effects whose parameters are measured by hand.
#pragma once

#include <vector>

#include "mechanism/effect.h"

namespace fusee {

/// Standard uncertainty of a length by caliper, mm: that of the mean of three readings, each uncertain by 0.05 mm. The
/// plan's page requests three readings.
inline constexpr double k_caliper = 0.03;
/// Standard uncertainty of a radius from a diameter by caliper, mm.
inline constexpr double k_half_diameter = 0.5 * k_caliper;

/// The deviation from `declared` of an entry of [prior], [value, standard uncertainty]. Empty for an empty entry.
inline std::vector<ManualReading> hand_reading(const std::vector<double>& prior, double declared) {
  if (prior.size() != 2) return {};
  return {{prior[0] - declared, prior[1]}};
}

/// An entry of [prior] that is the deviation itself. `unit`: the unit of the entry, in that of the parameter.
inline std::vector<ManualReading> hand_reading_in(const std::vector<double>& prior, double unit) {
  if (prior.size() != 2) return {};
  return {{unit * prior[0], unit * prior[1]}};
}

}  // namespace fusee
