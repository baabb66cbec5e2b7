/// \file
/// Internal: sections of both grooves, and all heights along the axis. mm, rad.
#pragma once

#include "fusee/base.h"
#include "solid/body.h"

namespace fusee::solid {

/// Margin of ceilings above the flattest allowed slope. Slicers reject slopes up to a degree steeper than their
/// threshold (PrusaSlicer 2.5 supports 45.5° at 45°, not 46°), and coordinates are floats.
inline constexpr double k_slope_margin = radians(2.5);

/// Groove walls, channels, flanges, cones, chamfer and heights of a part printed in one piece or two, without bore and
/// hub.
BodyLayout axial_layout(const Mechanism& mechanism, const FlangeRims& rims, Parts parts, double entry_lean);

/// Adds the ceiling over P1's knot pockets, which open on the bed of a part in one piece. Thickens the middle flange
/// for it.
void add_pocket_ceiling(BodyLayout& layout);
/// Adds the cone over a horn's recess.
void add_recess_ceiling(BodyLayout& layout);

}  // namespace fusee::solid
