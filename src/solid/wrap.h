/// \file
/// Internal: arcs of an outline in its winding direction: counter-clockwise on P1, clockwise on P2. mm, rad.
#pragma once

#include "fusee/profile.h"

namespace fusee::solid {

/// The point whose normal is nearest to `normal`.
std::size_t index_at_normal(const profile::Outline& outline, double normal);
/// The point nearest to `place`.
std::size_t index_at_place(const profile::Outline& outline, const Vec2& place);

/// Length of an arc, and the angle by which its normal turns.
struct WoundArc {
  double length = 0;
  double turn = 0;
};
/// The arc from point `from` to point `to`.
WoundArc wound_arc(const profile::Outline& outline, std::size_t from, std::size_t to);

}  // namespace fusee::solid
