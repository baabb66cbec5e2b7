/// \file
/// What can be made small (or large): plain functions of a mechanism. Forces and errors are per newton of tip force, by
/// the paper's chain [1]-[11].
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "fusee/mechanism/mechanism.h"

namespace fusee {

enum class Objective { max_tension, max_error, footprint, motor_torque, min_bend };

struct ObjectiveInfo {
  Objective objective;
  std::string_view name;  ///< in the mechanism file
  std::string_view unit;
  std::string_view meaning;
  bool largest = false;     ///< is made large, not small
  bool certifiable = true;  ///< its equations have an interval form
};

std::span<const ObjectiveInfo> objectives();
const ObjectiveInfo& info(Objective objective);
Objective find_objective(std::string_view name);  ///< a name that the mechanism file accepts

/// The value of an objective, or why there is none. Never NaN, never infinite where possible.
struct Evaluation {
  bool possible = false;
  double value = 0;
  double theta = 0;    ///< where in the range it is taken, rad
  std::string reason;  ///< when not possible

  /// Smaller is better, for every objective; 1e300 when not possible.
  double cost(Objective objective) const;
};

/// law = "table" is evaluated like any other. Pins are points where the mechanism says so (has_point_pins).
Evaluation evaluate(Objective objective, const Mechanism& mechanism);

}  // namespace fusee
