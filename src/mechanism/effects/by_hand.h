/// \file
/// Internal: what effects whose numbers a caliper reads have in common.
#pragma once

#include <vector>

#include "fusee/mechanism/effect.h"

namespace fusee {

inline constexpr double k_caliper = 0.05;  ///< a caliper's standard uncertainty, mm

/// A line of [prior], [value, standard uncertainty] of something that is `declared`, as a reading of by how much the
/// joint differs from its file. None where the line is empty.
inline std::vector<CaliperReading> hand_reading(const std::vector<double>& prior, double declared) {
  if (prior.size() != 2) return {};
  return {{prior[0] - declared, prior[1]}};
}

}  // namespace fusee
