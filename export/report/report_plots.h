/// \file
/// What a pulley's report plots: the product's numbers as plain plots.
#pragma once

#include <string_view>
#include <vector>

#include "export/report/plot.h"
#include "fusee/export/product.h"

namespace fusee {

/// r1 and r2, θ with its best straight line and the deviation from it, radius of curvature of both pitch curves.
std::vector<Plot> transmission_plots(const Product& product);
/// Error of the joint angle and slack over α between their limits. None when no tendon was wound.
std::vector<Plot> as_built_plots(const Product& product);
/// Tension of tendon 2 and the joint angle that its stretch costs. None without a tip force.
std::vector<Plot> force_plots(const Product& product);

/// Of law = "torque", over θ: what the motor is wanted to turn with, what the pulley as wound makes of the load, and
/// what it takes with friction and stretch, each way; what weight, force and spring ask of the joint.
std::vector<Plot> torque_plots(const Product& product);

/// The product's check of this name, or null.
const Check* find_check(const Product& product, std::string_view name);

}  // namespace fusee
