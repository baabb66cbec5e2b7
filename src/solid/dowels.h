/// \file
/// Internal: pins that locate P1 and P2 on each other when they are printed separately. mm, not yet scaled.
#pragma once

#include <functional>
#include <optional>
#include <utility>

#include "solid/plan.h"

namespace fusee::solid {

/// Two free places as far apart as possible within `reach` of the axis. Their distances from the axis differ by at
/// least half a hole, and they are not in line with the axis. No turn or flip that keeps the bore in place then maps
/// one onto the other. `diameter`: of a hole. `wall`: least wall between both holes.
std::optional<std::pair<Vec2, Vec2>> pin_places(double reach, double diameter, double wall,
                                                const std::function<bool(const Vec2&)>& is_free);

/// Holes through P1 and into P2, clear of all other features. Empty if there is no space for two.
DowelLayout choose_dowels(const Mechanism& mechanism, const BodyPlan& plan);

/// The volume that one pin's hole removes.
TriangleMesh dowel_tool(const DowelLayout& dowels, const Vec2& place);

}  // namespace fusee::solid
