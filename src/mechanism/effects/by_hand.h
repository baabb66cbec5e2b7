/// \file
/// Internal: what effects whose numbers a caliper reads have in common.
#pragma once

#include <vector>

#include "fusee/mechanism/effect.h"

namespace fusee {

inline constexpr double k_caliper = 0.03;  ///< of three readings of 0.05 mm, as the plan's page asks for, mm
inline constexpr double k_half_diameter = 0.5 * k_caliper;

/// A line of [prior], [value, standard uncertainty] of something that is `declared`, as a reading of by how much the
/// joint differs from its file. None where the line is empty.
inline std::vector<CaliperReading> hand_reading(const std::vector<double>& prior, double declared) {
  if (prior.size() != 2) return {};
  return {{prior[0] - declared, prior[1]}};
}

/// A line of [prior] whose unit is another than that of the joint's number: `unit` in rad, mm or N.
inline std::vector<CaliperReading> hand_reading_in(const std::vector<double>& prior, double unit) {
  if (prior.size() != 2) return {};
  return {{unit * prior[0], unit * prior[1]}};
}

}  // namespace fusee
