/// \file
/// From the end of a groove to the knot: an arc that leaves the groove tangentially, inwards and towards the face, and
/// where the pulley is small a straight way on, into a pocket in that face. mm, in the finished part's frame.
#pragma once

#include <optional>
#include <vector>

#include "coil/winding.h"
#include "fusee/base/plane.h"
#include "fusee/coil/helical_pulley.h"

namespace fusee {

/// Sizes of a run-out.
struct RunOutSizes {
  double channel_radius = 0;
  double mouth_radius = 0;   ///< of the channel where it leaves the groove
  double mouth_outward = 0;  ///< of its middle, from the tendon's centre line
  double pocket_radius = 0;
  double pocket_depth = 0;  ///< of the straight part, at least
  double cone = 0;          ///< height of the cone over it, down to the channel's radius
  double tip = 0;           ///< and on to a fifth of that, in the lower face's pocket: it has no ceiling
  double inward = 0;        ///< from the groove's end to the pocket, and as much towards the face
  double bend_radius = 0;   ///< of the arc, at most inward · √2: a straight way goes on from it
  double sharpest_bend = 0;
  std::vector<double> channel_radii = {};  ///< along the arc, where it is not as wide as it becomes
  double roof_slope = 0;                   ///< of the channel's gable above the horizontal, rad

  /// The least from the face to the tendon's centre line where the groove ends.
  double height() const { return pocket_depth + cone + inward; }
};

/// Of a pulley of large radius: on smaller ones the rim bends towards the pocket. `share` of the automatic pocket.
RunOutSizes run_out_sizes(const Mechanism& mechanism, const BodyLayout& layout, double share);

/// The groove's end, seen along the tendon towards its knot.
struct GrooveEnd {
  Side side = Side::left;
  WindingRow row;
  double along = 1;    ///< the tendon goes on counter-clockwise (+1) or clockwise
  double outward = 1;  ///< of the face along z: −1 is the lower one
  double face = 0;     ///< height
};

/// `sizes` with the least way inwards, and the gentlest arc on it, that leave `wall` between pocket and rim; where none
/// does, the way that leaves most. The arc is no gentler than that of `sizes`.
RunOutSizes fitted_into(const Polygon& rim, const GrooveEnd& end, RunOutSizes sizes, double wall);
/// Between pocket and rim, below 0 where the pocket breaks through it.
double rim_wall(const Polygon& rim, const GrooveEnd& end, const RunOutSizes& sizes);
/// How far the mouth stands in the solid, less than 0 where it stands out.
double mouth_cover(const Polygon& rim, const GrooveEnd& end, const RunOutSizes& sizes);
/// What a channel has beside it where it begins, mm.
struct ChannelRoom {
  double cover = 0;      ///< to leave to the rim and to the neighbouring turn's groove
  double reach = 0;      ///< of that groove, inwards from the rim
  double neighbour = 0;  ///< along the axis, from the groove's end to that groove
};
/// The channel's radii along the arc: no wider than the room it has, no narrower than the mouth.
std::vector<double> channel_radii(const Polygon& rim, const GrooveEnd& end, const RunOutSizes& sizes,
                                  const ChannelRoom& room);
/// Radii and depths of the pocket below its face, from there in.
std::vector<Vec2> pocket_profile(const GrooveEnd& end, const RunOutSizes& sizes);
/// Middle of the pocket in plan.
Vec2 pocket_place(const GrooveEnd& end, const RunOutSizes& sizes);
HelicalAnchor anchor_at(const GrooveEnd& end, const RunOutSizes& sizes);
/// A channel's section: a circle in the plane across the channel, `level` and `up` in it, under a gable whose ridge
/// stands upright over the middle: what a ball with a cone on it, carried along the channel, sweeps. Its roof is as
/// steep as the cone however the channel bends, dives and widens.
struct ChannelRing {
  Vec3 middle = Vec3::Zero();
  Vec3 level = Vec3::UnitX(), up = Vec3::UnitZ();
  double radius = 0;
  double gap = 0;  ///< of the circle under the gable, from `up` to either side, rad
  Vec3 ridge = Vec3::Zero();
};
/// Along the channel, from the open groove into the pocket's cone; the first two stand in the mouth.
std::vector<ChannelRing> channel_rings(const GrooveEnd& end, const RunOutSizes& sizes, int variant);
/// What is cut out, a closed mesh, or none where channel and pocket do not join; another `variant` has other facets.
std::optional<TriangleMesh> run_out_tool(const GrooveEnd& end, const RunOutSizes& sizes, int variant);

}  // namespace fusee
