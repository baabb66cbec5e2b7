/// \file
/// Plan views of tie-off channels that print without support. mm, rad.
#pragma once

#include <vector>

#include "fusee/solid/layout.h"
#include "solid/anchors.h"

namespace fusee {

/// Both edges of a channel from its mouth to its pocket, point by point; the ceiling rises from the inner to the outer one.
struct ChannelEdges {
  std::vector<Vec2> inner;
  std::vector<Vec2> outer;
};

/// Of constant width.
ChannelEdges plain_edges(const AnchorPath& path, double width);

/// Outside the floor the outer edge is opened to a mouth that stands steeply on the groove's edge. A tangential one would
/// leave a wedge of material whose tip grows by more than a layer can stand out. `beyond`: the flanges end before this
/// distance from the floor.
ChannelEdges flared_edges(const AnchorPath& path, double width, const Polygon& floor, double beyond);

/// How much deeper than the groove's own roof the ceiling of a mouth cuts into the flange at the lip, at most.
double mouth_rise(const BodyLayout& layout);

}  // namespace fusee
