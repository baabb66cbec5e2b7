/// \file
/// The body's sizes with every "automatic" resolved: one place that solid, OpenSCAD, plates and report read.
///
/// Bottom to top along z: flange 1 | groove P1 | middle flange | groove P2 | flange 2 | hub. z = 0 is the outer face of
/// flange 1. mm, rad. These are the finished part's sizes; the mesh's coordinates are `scale` times them.
///
/// In one piece the part is printed as it stands, on flange 1. In two pieces the middle flange is parted at `z_mate`,
/// and each piece is printed on that face: P1 turned over, P2 with its hub up.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "fusee/mechanism/mechanism.h"
#include "fusee/profile/synthesis.h"

namespace fusee {

/// A point of a groove's cross-section: outward offset from the floor, axial distance from the groove's plane.
struct GroovePoint {
  double offset = 0;
  double dz = 0;
};

/// The circle that is wanted where a print has a polygon around it.
struct RoundHole {
  Vec2 centre = Vec2::Zero();
  double diameter = 0;
};

/// The circle that the sides of a print's round hole touch.
RoundHole circle_within(const Polygon& facets);

/// Both halves of a groove's cross-section, from its floor to its lip: first {0, 0}, last {depth, half's width}. In
/// print the one that is above is a roof.
struct GrooveWalls {
  std::vector<GroovePoint> below;  ///< towards flange 1
  std::vector<GroovePoint> above;

  double below_width() const { return below.back().dz; }
  double above_width() const { return above.back().dz; }
};

/// Pins that locate P1 and P2 on each other: holes through P1 and into P2. None: the bore alone locates them.
struct DowelLayout {
  std::vector<Vec2> places;
  double hole_diameter = 0;  ///< compensated
  double pin_diameter = 0;
  double z_end = 0;  ///< end of the holes' straight walls, in P2
  double roof = 0;   ///< height of the cone in which they end; 0: flat
};

struct BoreLayout {
  Bore kind = Bore::round;
  double shaft = 0;  ///< diameter of the shaft it is for, hole compensation left out; of no meaning for a horn
  Polygon outline;   ///< counter-clockwise about the axis, hole compensation included
  std::optional<RoundHole> circle;  ///< that the outline's sides touch from outside, where the bore is a circle
  std::size_t arc_points = 0;  ///< how many of the outline's first points lie on one arc about the axis (D, keyway)
  double radius = 0;           ///< of the largest circle about the axis that the bore reaches
  std::vector<Polygon> screw_holes;  ///< of a servo horn, through holes; with a recess the first is the centre screw's
  double horn_recess = 0;            ///< depth of the horn's pocket from the bottom face; 0: through
  double horn_roof = 0;              ///< height of the cone above it, which closes it without a flat ceiling
  int spline_teeth = 0;              ///< of an outline that takes a servo's toothed shaft; 0: it has none
};

struct SetScrewLayout {
  bool present = false;
  double hole_diameter = 0;  ///< clearance or tapping diameter, compensated
  double z = 0;              ///< of its axis, in the hub
  double angle = 0;          ///< direction of its axis about z, rad
  bool nut_trap = false;
  double nut_width = 0;  ///< across flats, compensated
  double nut_thickness = 0;
  double roof_slope = 0;    ///< of the hole's roof above the horizontal, rad
  double nut_distance = 0;  ///< from the axis to the middle of the nut
};

struct BodyLayout {
  Parts parts = Parts::one;  ///< as it is printed; never automatic
  double roof_slope = 0;     ///< of faces made to look down, above the horizontal, rad; 0: they may be flat
  double mouth_lean = 0;     ///< of a channel's mouth's walls against the groove's edge, rad
  double tendon_diameter = 0;
  GrooveWalls p1, p2;
  double groove_depth = 0;
  double flange_thickness = 0;
  double lower_cone = 0;   ///< height of the cone between a groove's lip and a flange that stands out over it: flange 1
  double middle_cone = 0;  ///< under the middle flange
  double upper_cone = 0;   ///< under flange 2
  double z_p1 = 0;         ///< plane of groove P1
  double z_middle = 0;     ///< bottom of the middle flange's rim
  double z_mate = 0;       ///< in two parts: where P1 ends and P2 begins, within the middle flange
  double z_p2 = 0;
  double z_top = 0;       ///< top of flange 2
  double z_hub = 0;       ///< top of the hub (= z_top without one)
  double hub_radius = 0;  ///< 0: no hub
  BoreLayout bore;
  SetScrewLayout set_screw;
  double channel_width = 0;        ///< of the tie-off channels
  double channel_fillet = 0;       ///< radius at which a channel leaves the floor's tangent, to its centre line
  double pocket_radius = 0;        ///< of the knot pockets
  double channel_roof = 0;         ///< how far the channels' ceilings rise towards their outer walls; 0: flat
  double pocket_roof = 0;          ///< the same of P1's pockets where they open on the bed
  double min_wall = 0;             ///< no wall is thinner
  double elephant_foot = 0;        ///< width of the chamfer at the bed
  DowelLayout dowels;              ///< of a part in two
  double mark_depth = 0;           ///< of what is engraved; what is raised is as high as the file says
  double scale = 1;                ///< all x, y, z of the mesh are times this: 1/(1 − shrinkage)
  std::vector<std::string> notes;  ///< what "automatic" had to leave out or make small, and why
};

/// Height of a chamfer or roof of this width that prints without support, mm.
double rise_of(const BodyLayout& layout, double width);
/// Slope of two roofs that meet over a slit, rad.
double gable_slope(const BodyLayout& layout);

/// All sizes. Explicit numbers are taken as they are (make_pulley refuses what is impossible); automatic ones are made
/// to fit.
BodyLayout resolve_layout(const Mechanism& mechanism, const SynthesisResult& synthesis);

}  // namespace fusee
