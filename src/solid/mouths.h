/// \file
/// Plan views of tie-off channels that print without support. mm, rad.
#pragma once

#include <vector>

#include "fusee/base/units.h"
#include "fusee/solid/layout.h"
#include "solid/anchors.h"

namespace fusee {

/// Both edges of a channel from its mouth to its pocket, point by point; the ceiling rises from the inner to the outer
/// one.
struct ChannelEdges {
  std::vector<Vec2> inner;
  std::vector<Vec2> outer;
};

/// A mouth's wall leans over by this against the groove's edge, and by up to 7° more where the edge is curved. The tip
/// between them moves outwards by the edge's step over the sine of its angle: 0.183 mm of a roof at 47.5° and layers of
/// 0.2 mm become 0.1915 mm at 73°, and PrusaSlicer widens a layer by 0.193 mm at 45°.
inline constexpr double k_steep_lean = radians(10);
/// Where that finds no room: only a squared corner of PrusaSlicer's holds the tip (layers.h).
inline constexpr double k_wide_lean = radians(20);

/// Of constant width.
ChannelEdges plain_edges(const AnchorPath& path, double width);

/// Outside the floor the outer edge is opened to a mouth that stands steeply on the groove's edge. A tangential one
/// would leave a wedge of material whose tip grows by more than a layer can stand out. `lean`: of the mouth's walls
/// against the groove's edge, rad. `beyond`: the flanges end before this distance from the floor.
ChannelEdges flared_edges(const AnchorPath& path, double width, const Polygon& floor, double lean, double beyond);

/// How much deeper than the groove's own roof the ceiling of a mouth cuts into the flange at the lip, at most.
double mouth_rise(const BodyLayout& layout);

}  // namespace fusee
