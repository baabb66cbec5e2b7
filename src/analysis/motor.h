/// \file
/// Internal: the motor's limits beside what the joint requires.
#pragma once

#include "fusee/analysis.h"

namespace fusee::analysis {

/// Compares the motor's travel with the required one, rad, and nothing else.
MotorCheck travel_check(const Mechanism& mechanism, double travel);
/// Compares the mechanism's motor and the models of the catalogue with the stroke under load.
MotorCheck motor_check(const Mechanism& mechanism, const UnderLoad& load);

}  // namespace fusee::analysis
