/// \file
/// Torques of [load] and [spring] on the joint.
#pragma once

#include "fusee/mechanism.h"

namespace fusee::transmission {

constexpr double k_gravity = 9.80665;  ///< standard gravity, m/s²

/// Torque of the declared mass where its lever is horizontal, N·mm.
double weight_moment(const Load& load);
/// Total torque of [load] and [spring] against +θ, N·mm.
double load_torque(const Mechanism& mechanism, double theta);

/// A torque as a function of the joint angle, with derivatives: N·mm, N·mm/rad, N·mm/rad².
struct TorqueOverTheta {
  double value = 0;
  double d1 = 0;
  double d2 = 0;
};
/// The load torque against +θ that law = torque is designed to hold.
TorqueOverTheta law_load_torque(const Mechanism& mechanism, double theta);

/// Freezes the load and lever that define law = torque, so that later changes of [load] or R do not change θ(α).
void keep_law(Mechanism& mechanism);

}  // namespace fusee::transmission
