/// \file
/// What [load] turns the joint with.
#pragma once

#include "fusee/mechanism/mechanism.h"

namespace fusee {

constexpr double k_gravity = 9.80665;  ///< standard, m/s²

/// What the declared mass turns the joint with where its arm lies level, N·mm.
double weight_moment(const Load& load);
/// Torque against +θ of everything [load] declares, N·mm.
double load_torque(const Mechanism& mechanism, double theta);

}  // namespace fusee
