/// \file
/// Outlines of the holes along the axis. mm.
#pragma once

#include "fusee/solid/layout.h"

namespace fusee {

/// A print's round hole: facets tangent to the circle from outside, as many as the printer's corners bear (two per mm
/// of diameter).
Polygon polyhole(double diameter, const Vec2& centre);

/// The bore for a shaft of `diameter` (across flats for hex and square; of no meaning for a horn). Flats, keyways and
/// one tooth of a toothed shaft face +y, towards the joint at home. Nothing is checked: make_pulley's conditions do
/// that.
BoreLayout bore_layout(const Mechanism& mechanism, double diameter);

/// A horn's recess narrows in a cone to this share of its outline, just wider than the centre screw's hole.
double recess_roof_share(const BoreLayout& bore);

}  // namespace fusee
