/// \file
/// From the end of a groove to the knot: an arc that leaves the groove tangentially, inwards and towards the face, into
/// a pocket in that face. mm, in the finished part's frame.
#pragma once

#include "coil/winding.h"
#include "fusee/coil/helical_pulley.h"

namespace fusee {

/// Sizes of a run-out, the same for both ends.
struct RunOutSizes {
  double channel_radius = 0;
  double mouth_radius = 0;   ///< of the channel where it leaves the groove
  double mouth_outward = 0;  ///< of its middle, from the tendon's centre line
  double pocket_radius = 0;
  double pocket_depth = 0;  ///< of the straight part, at least
  double cone = 0;          ///< height of the cone over it
  double inward = 0;        ///< from the groove's end to the pocket, and as much towards the face
  double bend_radius = 0;   ///< inward · √2
  double roof_slope = 0;    ///< of the channel's gable above the horizontal, rad

  /// The least from the face to the tendon's centre line where the groove ends.
  double height() const { return pocket_depth + cone + inward; }
};

RunOutSizes run_out_sizes(const Mechanism& mechanism, const BodyLayout& layout);

/// The groove's end, seen along the tendon towards its knot.
struct GrooveEnd {
  Side side = Side::left;
  WindingRow row;
  double along = 1;    ///< the tendon goes on counter-clockwise (+1) or clockwise
  double outward = 1;  ///< of the face along z: −1 is the lower one
  double face = 0;     ///< height
};

/// Middle of the pocket in plan.
Vec2 pocket_place(const GrooveEnd& end, const RunOutSizes& sizes);
HelicalAnchor anchor_at(const GrooveEnd& end, const RunOutSizes& sizes);
/// What is cut out, a closed mesh; another `variant` has other facets.
TriangleMesh run_out_tool(const GrooveEnd& end, const RunOutSizes& sizes, int variant);

}  // namespace fusee
