/// \file
/// Internal: the run-out from a groove's end to the knot. An arc leaves the groove tangentially, inwards and towards
/// the face. On small pulleys a straight channel continues it. It ends in a pocket in that face. mm, in the finished
/// part's frame.
#pragma once

#include <optional>
#include <vector>

#include "fusee/base.h"
#include "fusee/helical_solid.h"
#include "helical_solid/winding.h"

namespace fusee::helical_solid {

/// Dimensions of a run-out.
struct RunOutSizes {
  double channel_radius = 0;
  double entry_radius = 0;   ///< radius of the channel where it leaves the groove
  double entry_outward = 0;  ///< offset of the entry's centre from the tendon's centre line, outwards
  double pocket_radius = 0;
  double pocket_depth = 0;  ///< least depth of the cylindrical part
  double cone = 0;          ///< height of the cone above it, down to the channel's radius
  /// Height of the further cone down to a fifth of that radius; only in the lower face's pocket, to avoid a ceiling
  double tip = 0;
  double inward = 0;         ///< distance from the groove's end to the pocket, inwards and equally towards the face
  double bend_radius = 0;    ///< radius of the arc, at most inward · √2; a straight channel continues it
  double sharpest_bend = 0;  ///< least `bend_radius`
  std::vector<double> channel_radii = {};  ///< radii along the arc, if they vary
  double ceiling_slope = 0;                ///< angle of the channel's peaked ceiling above the horizontal, rad

  /// The least distance from the face to the tendon's centre line at the groove's end.
  double height() const { return pocket_depth + cone + inward; }
};

/// The sizes for a straight rim, as on a pulley of large radius. fitted_into() adapts them to a rim that bends towards
/// the pocket. `share`: fraction of the automatic pocket size.
RunOutSizes run_out_sizes(const Mechanism& mechanism, const solid::BodyLayout& layout, double share);

/// The end of a groove, seen along the tendon towards its knot.
struct GrooveEnd {
  transmission::Side side = transmission::Side::left;
  WindingRow row;
  double along = 1;    ///< the tendon continues counter-clockwise (+1) or clockwise (−1)
  double outward = 1;  ///< direction of the face along z: −1 for the lower one
  double face = 0;     ///< height of the face
};

/// `sizes` with the shortest way inwards, and the gentlest arc on it, that leave `wall` between pocket and rim. If none
/// does, the way that leaves the thickest wall. The arc is no gentler than that of `sizes`.
RunOutSizes fitted_into(const Polygon& rim, const GrooveEnd& end, RunOutSizes sizes, double wall);
/// Wall between pocket and rim, negative where the pocket breaks through.
double rim_wall(const Polygon& rim, const GrooveEnd& end, const RunOutSizes& sizes);
/// Depth of the channel entry inside the solid, negative where it projects.
double entry_cover(const Polygon& rim, const GrooveEnd& end, const RunOutSizes& sizes);
/// Clearances of a channel at its start, mm.
struct ChannelRoom {
  double cover = 0;      ///< required clearance to the rim and to the neighbouring turn's groove
  double reach = 0;      ///< depth of that groove, inwards from the rim
  double neighbour = 0;  ///< axial distance from the groove's end to that groove
};
/// Radii of the channel along the arc: no wider than its clearance allows, no narrower than the entry.
std::vector<double> channel_radii(const Polygon& rim, const GrooveEnd& end, const RunOutSizes& sizes,
                                  const ChannelRoom& room);
/// Radius (x) and depth (y) of each corner of the pocket's section, from its face inwards.
std::vector<Vec2> pocket_profile(const GrooveEnd& end, const RunOutSizes& sizes);
/// Centre of the pocket in plan.
Vec2 pocket_place(const GrooveEnd& end, const RunOutSizes& sizes);
/// The fixed end with these sizes.
HelicalAnchor anchor_at(const GrooveEnd& end, const RunOutSizes& sizes);
/// Cross-section of a channel: a circle in the plane across the channel (axes `level` and `up`) below a peaked ceiling
/// whose ridge stands vertically over the centre. It is the section of the volume that a ball with a cone on it sweeps
/// along the channel. The ceiling is therefore as steep as the cone wherever the channel bends, dives or widens.
struct ChannelRing {
  Vec3 middle = Vec3::Zero();
  Vec3 level = Vec3::UnitX(), up = Vec3::UnitZ();
  double radius = 0;
  double gap = 0;  ///< angle from `up` to either side at which the ceiling leaves the circle, rad
  Vec3 ridge = Vec3::Zero();
};
/// Sections along the channel, from the open groove into the pocket's cone. The first two lie in the entry.
std::vector<ChannelRing> channel_rings(const GrooveEnd& end, const RunOutSizes& sizes, int variant);
/// The volume to cut, as a closed mesh; empty if channel and pocket do not join. Each `variant` has different facets.
std::optional<solid::TriangleMesh> run_out_tool(const GrooveEnd& end, const RunOutSizes& sizes, int variant);

}  // namespace fusee::helical_solid
