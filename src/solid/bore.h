/// \file
/// Outlines of the holes along the axis. mm.
#pragma once

#include <optional>

#include "fusee/profile/synthesis.h"
#include "fusee/solid/layout.h"

namespace fusee {

/// A print's round hole: facets tangent to the circle from outside, as many as the printer's corners bear (two per mm
/// of diameter).
Polygon polyhole(double diameter, const Vec2& centre);

/// The bore for a shaft of `diameter` (across flats for hex and square; of no meaning for a horn). Flats, keyways and
/// one tooth of a toothed shaft face +y, towards the joint at home. Nothing is checked: make_pulley's conditions do
/// that.
BoreLayout bore_layout(const Mechanism& mechanism, double diameter);

/// The bore for the same shaft as it is once printed: what a printer's holes come out smaller by is left out.
BoreLayout bore_of_shaft(Mechanism mechanism, const BoreLayout& made);

/// A written flat that lies outside a D shaft of this diameter, or not beyond its axis; nothing where there is none.
std::optional<Condition> flat_off_shaft(const Body& body, double shaft);

/// The cone in which a horn's recess narrows to the centre screw's hole. Both rims have a corner on each ray from the
/// axis on which either polygon has one, so that the cone ends in the hole itself and leaves no ledge about it.
struct RecessCone {
  Polygon rim;        ///< the recess' outline
  Polygon hole;       ///< the centre screw's; corner i is on the ray of the rim's corner i
  double travel = 0;  ///< the furthest that a corner moves inward
};

/// Of a bore with a recess, whose outline the hole lies within.
RecessCone recess_cone(const BoreLayout& bore);

}  // namespace fusee
