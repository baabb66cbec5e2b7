/// \file
/// Requirements of law = torque: the wanted motor torque and the load that it has to hold.
#pragma once

#include <vector>

#include "fusee/mechanism.h"

namespace fusee::transmission {

/// Load and wanted motor torque at one joint angle. Without friction the motor turns by load/motor per joint angle.
struct TorqueMatch {
  double theta = 0;  ///< rad
  double load = 0;   ///< torque of [load] and [spring] against +θ, N·mm
  double motor = 0;  ///< wanted motor torque towards +α, N·mm

  double slope() const { return load / motor; }  ///< dα/dθ
};

/// The joint angle of the range where dα/dθ of law = torque is smallest. The law does not exist where dα/dθ is not
/// positive. An angle at which dα/dθ has no value counts as the smallest.
TorqueMatch tightest_torque(const Mechanism& mechanism);
/// The wanted motor torque of law = torque at joint angles (rad), N·mm: between the rows of its table by the law's
/// spline.
std::vector<double> wanted_torques(const Mechanism& mechanism, const std::vector<double>& thetas);

}  // namespace fusee::transmission
