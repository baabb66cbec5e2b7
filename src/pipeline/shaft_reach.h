/// \file
/// Internal: the set screw of a pulley and the length of its motor's shaft.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "fusee/base.h"
#include "fusee/export.h"

namespace fusee::pipeline {

/// Heights above the motor's face, mm.
struct ShaftReach {
  std::string motor;  ///< "N20"
  std::string screw;  ///< "M2"
  double below = 0;   ///< of the pulley's lower face
  double axis = 0;    ///< of the set screw's axis
  double needed = 0;  ///< of the set screw's upper edge: the shaft reaches as far
  double length = 0;  ///< of the shaft's end

  bool suffices() const { return needed <= length; }
};

/// Empty without a set screw, behind a gearbox, or if the catalogue does not know the shaft of the file's motor.
/// `below`: height of the pulley's lower face above the motor's face, mm.
std::optional<ShaftReach> shaft_reach(const Mechanism& mechanism, const solid::BodyLayout& layout, double below = 0);

/// A copy with the highest hub whose set screw the shaft reaches, by a plan without a mesh. Empty if there is none, and
/// for a pulley of several turns.
std::optional<DeclaredMechanism> with_lower_hub(const DeclaredMechanism& declared, double below = 0);

/// Warning about a set screw that the shaft does not reach. `build`: a full build of a trial; empty if it fails.
std::optional<Diagnostic> shaft_reach_warning(
    const formats::Product& product, double below,
    const std::function<std::optional<formats::Product>(const Mechanism&)>& build);

}  // namespace fusee::pipeline
