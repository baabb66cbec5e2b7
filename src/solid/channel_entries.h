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

/// Lean of a channel entry's wall from the normal of the groove edge. A curved edge adds up to 7°, so wall and edge
/// enclose a tip of at least 73°. Under a ceiling at 47.5°, in layers of 0.2 mm, the edge moves outwards by
/// 0.2 mm / tan 47.5° = 0.183 mm from layer to layer. The tip moves by 0.183 mm / sin 73° = 0.1915 mm. PrusaSlicer
/// needs no support up to 0.193 mm, by which it widens a layer at 45°.
inline constexpr double k_steep_lean = radians(10);
/// Lean used where k_steep_lean does not fit. Only PrusaSlicer's squared corner supports the tip (layers.h).
inline constexpr double k_wide_lean = radians(20);

/// Edges of a channel of constant width.
ChannelEdges plain_edges(const AnchorPath& path, double width);

/// Outside the floor the outer edge widens to an entry that stands steeply on the groove edge. A tangential entry would
/// leave a wedge whose tip grows by more than a layer can overhang. `lean`: of the entry's walls from the normal of the
/// groove edge, rad. `beyond`: distance from the floor within which the flanges end.
ChannelEdges flared_edges(const AnchorPath& path, double width, const Polygon& floor, double lean, double beyond);

/// Largest additional depth, compared with the groove's own ceiling, to which an entry's ceiling cuts into the flange
/// at the groove edge.
double entry_rise(const BodyLayout& layout);

}  // namespace fusee::solid
