/// \file
/// Objectives: functions of a mechanism to minimize or maximize. Forces and errors are per newton of tip force, by the
/// paper's formulas [1]-[11].
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
  bool largest = false;     ///< maximized instead of minimized
  bool certifiable = true;  ///< an interval form of its equations exists
};

std::span<const ObjectiveInfo> objectives();
const ObjectiveInfo& info(Objective objective);
Objective find_objective(std::string_view name);  ///< a name valid in the mechanism file

/// Value of an objective, or the reason why there is none. Finite if possible.
struct Evaluation {
  bool possible = false;
  double value = 0;
  double theta = 0;    ///< joint angle of that value, rad
  std::string reason;  ///< set if not possible

  /// Cost to minimize, for every objective; 1e300 if not possible.
  double cost(Objective objective) const;
};

/// Supports all laws. Pins are points if has_point_pins().
Evaluation evaluate(Objective objective, const Mechanism& mechanism);

}  // namespace fusee
