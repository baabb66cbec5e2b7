/// \file
/// Internal: outlines of the holes along the axis. mm.
#pragma once

#include <optional>

#include "fusee/profile.h"
#include "fusee/solid.h"

namespace fusee::solid {

/// A printed round hole (polyhole): its facets are tangent to the circle from outside. It has two facets per mm of
/// diameter, as many as the printer can resolve, and at least eight.
Polygon polyhole(double diameter, const Vec2& centre);

/// The bore for a shaft of `diameter` (across flats for hex and square; unused for a horn). Flats, keyways and one
/// tooth of a toothed shaft face +y, towards the joint at home. The conditions of make_pulley check the values, not
/// this function.
BoreLayout bore_layout(const Mechanism& mechanism, double diameter);

/// The bore for the same shaft as `made`, without the compensation for shrinking holes: its size after printing.
BoreLayout bore_of_shaft(Mechanism mechanism, const BoreLayout& made);

/// Condition that fails if a written flat lies outside a D shaft of this diameter or not beyond its axis; empty
/// otherwise.
std::optional<profile::Condition> flat_off_shaft(const Body& body, double shaft);

/// The cone in which a horn's recess narrows to the centre screw's hole. Both rims have a corner on every ray from the
/// axis on which either polygon has one. The cone therefore ends in the hole itself and leaves no ledge.
struct RecessCone {
  Polygon rim;        ///< the recess' outline
  Polygon hole;       ///< the centre screw's hole; corner i is on the ray of the rim's corner i
  double travel = 0;  ///< the furthest that a corner moves inward
};

/// Requires a bore with a recess that contains the hole.
RecessCone recess_cone(const BoreLayout& bore);

}  // namespace fusee::solid
