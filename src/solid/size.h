/// \file
/// Internal: the largest size of a part. mm.
#pragma once

#include <optional>

#include "fusee/profile.h"
#include "fusee/solid.h"

namespace fusee::solid {

/// Limits of a part's size. No printer builds a larger one, and floats resolve its corners ever more coarsely.
constexpr double k_furthest = 1000.0;  ///< from the axis to a pitch curve
constexpr double k_tallest = 1000.0;

constexpr const char* k_height_condition = "height";

/// The failed height condition of a pulley with this layout, if any. Of two parts the taller one counts.
std::optional<profile::Condition> too_tall(const BodyLayout& layout);

/// The failed condition on the reach of a pitch curve, if any. `active_reach`: reach of its working part.
std::optional<profile::Condition> too_far_out(transmission::Side side, double reach, double active_reach);

}  // namespace fusee::solid
