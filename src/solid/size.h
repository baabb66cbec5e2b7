/// \file
/// How large a part may be that is made at all. mm.
#pragma once

#include <optional>

#include "fusee/profile/synthesis.h"
#include "fusee/solid/layout.h"

namespace fusee {

/// No part beyond these is made: no printer builds it, and floats hold its corners ever more coarsely.
constexpr double k_furthest = 1000.0;  ///< from the axis to a pitch curve
constexpr double k_tallest = 1000.0;

constexpr const char* k_height_condition = "height";

/// What a pulley of this layout fails by its height, if it does; in two parts, the taller one.
std::optional<Condition> too_tall(const BodyLayout& layout);

/// The same of how far a pitch curve reaches. `active_reach`: the part of it that tendons leave.
std::optional<Condition> too_far_out(Side side, double reach, double active_reach);

}  // namespace fusee
