/// \file
/// Internal: the plots of a pulley's report.
#pragma once

#include <string_view>
#include <vector>

#include "export/report/plot.h"
#include "fusee/export.h"

namespace fusee::formats {

/// r1 and r2, θ with its best straight line and the deviation from it, radius of curvature of both pitch curves.
std::vector<Plot> transmission_plots(const Product& product);
/// Error of the joint angle and excess length over α between their limits. Empty if no tendon was wound.
std::vector<Plot> as_built_plots(const Product& product);
/// Tension of tendon 2 and the joint angle lost by its stretch. Empty without a tip force.
std::vector<Plot> force_plots(const Product& product);

/// For law = "torque", over θ: the target torque of the motor, the torque of the pulley as wound, and the torque with
/// friction and stretch in each direction; also the torque of weight, force and spring at the joint.
std::vector<Plot> torque_plots(const Product& product);

/// The product's check of this name, or null.
const Check* find_check(const Product& product, std::string_view name);

}  // namespace fusee::formats
