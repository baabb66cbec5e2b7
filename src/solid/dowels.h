/// \file
/// Pins that locate P1 and P2 on each other where they are printed apart. mm, not yet scaled.
#pragma once

#include <functional>
#include <optional>
#include <utility>

#include "solid/plan.h"

namespace fusee {

/// Two free places as far apart as can be within `reach` of the axis, at radii that differ by half a pin at least and
/// not in line with the axis: no turning or flipping that leaves the bore in place maps them onto themselves.
std::optional<std::pair<Vec2, Vec2>> pin_places(double reach, double diameter, double wall,
                                                const std::function<bool(const Vec2&)>& is_free);

/// Holes through P1 and into P2, clear of all that is cut out of them; none where there is no room for two.
DowelLayout choose_dowels(const Mechanism& mechanism, const BodyPlan& plan);

/// What one of them cuts out.
TriangleMesh dowel_tool(const DowelLayout& dowels, const Vec2& place);

}  // namespace fusee
