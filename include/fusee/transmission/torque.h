/// \file
/// What law = torque wants of the motor, beside what it has to hold.
#pragma once

#include "fusee/mechanism/mechanism.h"

namespace fusee {

/// At one joint angle. Without friction the motor turns by load/motor for every angle of the joint.
struct TorqueMatch {
  double theta = 0;  ///< rad
  double load = 0;   ///< against +θ, of [load] and [spring], N·mm
  double motor = 0;  ///< wanted, towards +α, N·mm

  double slope() const { return load / motor; }  ///< dα/dθ
};

/// Of law = torque, the place of the range where dα/dθ is smallest, as the law itself looks for it: where that is not
/// positive there is no law. A place where it has no value comes first.
TorqueMatch tightest_torque(const Mechanism& mechanism);

}  // namespace fusee
