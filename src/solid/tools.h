/// \file
/// Closed meshes of what is cut out of the body (or added to it). mm, not yet scaled.
#pragma once

#include <vector>

#include "fusee/solid/layout.h"
#include "fusee/solid/mesh.h"
#include "solid/anchors.h"

namespace fusee {

/// loops[0] without the others, from `low` to `high`.
TriangleMesh prism(const std::vector<Polygon>& loops, double low, double high);

/// Where a keyhole lies along the axis: the pocket is open to `open` (below both, or above both; `near` lies between the
/// others), the channel lies between `near` and `far`. Where `roof` is not `far` the pocket narrows from `far` to `roof`,
/// to `roof_share` of its outline.
struct KeyholeHeights {
  double open = 0;
  double near = 0;
  double far = 0;
  double roof = 0;
  double roof_share = 1;
};
TriangleMesh keyhole_tool(const Keyhole& keyhole, const KeyholeHeights& z);

/// Along the axis a seat between `open` and `sunk`, which narrows to the hole at `ground`, and the hole from there to
/// `far`. Both outlines have as many corners, each beside its like.
struct CountersinkHeights {
  double open = 0;
  double sunk = 0;
  double ground = 0;
  double far = 0;
};
TriangleMesh countersunk_tool(const Polygon& hole, const Polygon& seat, const CountersinkHeights& z);

/// The set screw's hole from the axis through the hub, with the slot its nut is slid into. Another `variant` has other
/// facets.
TriangleMesh set_screw_tool(const SetScrewLayout& screw, double hub_radius, double hub_top, int variant);

}  // namespace fusee
