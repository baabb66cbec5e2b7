/// \file
/// The sections of both grooves and where everything lies along the axis. mm, rad.
#pragma once

#include "fusee/base/units.h"
#include "solid/body.h"

namespace fusee {

/// Roofs are made steeper than the flattest slope by this: slicers take a slope of up to a degree more for too flat
/// (PrusaSlicer 2.5 supports 45.5° at a threshold of 45°, and 46° no longer), and coordinates are floats.
inline constexpr double k_slope_margin = radians(2.5);

/// Groove walls, channels, flanges, cones, chamfer and heights of a part that is printed in one piece or in two; no
/// bore, no hub.
BodyLayout axial_layout(const Mechanism& mechanism, const FlangeRims& rims, Parts parts, double mouth_lean);

/// The roof over P1's knot pockets, which open on the bed where the part is printed in one piece; the middle flange
/// becomes as thick as it needs.
void roof_pockets(BodyLayout& layout);
/// The cone over a horn's recess.
void roof_recess(BodyLayout& layout);

}  // namespace fusee
