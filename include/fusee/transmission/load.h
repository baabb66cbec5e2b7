/// \file
/// What [load] and [spring] turn the joint with.
#pragma once

#include "fusee/mechanism/mechanism.h"

namespace fusee {

constexpr double k_gravity = 9.80665;  ///< standard, m/s²

/// What the declared mass turns the joint with where its arm lies level, N·mm.
double weight_moment(const Load& load);
/// Torque against +θ of everything [load] and [spring] declare, N·mm.
double load_torque(const Mechanism& mechanism, double theta);

/// A torque over the joint's angle, and its derivatives by it: N·mm, N·mm/rad, N·mm/rad².
struct TorqueOverTheta {
  double value = 0;
  double d1 = 0;
  double d2 = 0;
};
/// Against +θ, of what law = torque is to hold.
TorqueOverTheta law_load_torque(const Mechanism& mechanism, double theta);

/// From here on the joint may carry something else, or have another lever: its law stays what it was declared to be.
void keep_law(Mechanism& mechanism);

}  // namespace fusee
