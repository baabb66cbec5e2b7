/// \file
/// Internal: channel entries, the plan views of tie-off channels that print without support. mm, rad.
#pragma once

#include <vector>

#include "fusee/base.h"
#include "fusee/solid.h"
#include "solid/anchors.h"

namespace fusee::solid {

/// Both edges of a channel from its entry to its pocket, point by point. The ceiling rises from the inner to the outer
/// edge.
struct ChannelEdges {
  std::vector<Vec2> inner;
  std::vector<Vec2> outer;
};

/// Lean of a channel entry's wall against the groove edge; a curved edge adds up to 7°. The tip between them moves
/// outwards by the edge's step over the sine of its angle. With a ceiling at 47.5° and layers of 0.2 mm, 0.183 mm
/// become 0.1915 mm at 73°; PrusaSlicer widens a layer by 0.193 mm at 45°.
inline constexpr double k_steep_lean = radians(10);
/// Lean used where k_steep_lean does not fit. Only PrusaSlicer's squared corner supports the tip (layers.h).
inline constexpr double k_wide_lean = radians(20);

/// Edges of a channel of constant width.
ChannelEdges plain_edges(const AnchorPath& path, double width);

/// Outside the floor the outer edge widens to an entry that stands steeply on the groove edge. A tangential entry would
/// leave a wedge whose tip grows by more than a layer can overhang. `lean`: of the entry's walls against the groove
/// edge, rad. `beyond`: distance from the floor within which the flanges end.
ChannelEdges flared_edges(const AnchorPath& path, double width, const Polygon& floor, double lean, double beyond);

/// Largest additional depth, compared with the groove's own ceiling, to which an entry's ceiling cuts into the flange
/// at the groove edge.
double entry_rise(const BodyLayout& layout);

}  // namespace fusee::solid
