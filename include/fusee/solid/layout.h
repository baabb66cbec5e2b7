/// \file
/// The body's sizes with every "automatic" resolved. Solid, OpenSCAD, plates and report all read them here.
///
/// Bottom to top along z: flange 1 | groove P1 | middle flange | groove P2 | flange 2 | hub. z = 0 is the outer face of
/// flange 1. mm, rad. These are the finished part's sizes. The mesh's coordinates are `scale` times them.
///
/// In one piece the part is printed on flange 1. In two pieces the middle flange is parted at `z_mate`, and each piece
/// is printed on that face: P1 turned over, P2 with its hub up.
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

/// The nominal circle of a hole that is printed as a polygon (polyhole).
struct RoundHole {
  Vec2 centre = Vec2::Zero();
  double diameter = 0;
};

/// The circle that the sides of a polyhole touch.
RoundHole circle_within(const Polygon& facets);

/// Both halves of a groove's cross-section, from its floor to the groove edge: first {0, 0}, last {depth, half the
/// width}. The half that is above during printing is a ceiling.
struct GrooveWalls {
  std::vector<GroovePoint> below;  ///< towards flange 1
  std::vector<GroovePoint> above;

  double below_width() const { return below.back().dz; }
  double above_width() const { return above.back().dz; }
};

/// Pins that locate P1 and P2 on each other: holes through P1 and into P2. Without pins the bore alone locates them.
struct DowelLayout {
  std::vector<Vec2> places;
  double hole_diameter = 0;  ///< compensated
  double pin_diameter = 0;
  double z_end = 0;    ///< end of the holes' straight walls, in P2
  double ceiling = 0;  ///< height of the cone in which they end; 0: flat
};

struct BoreLayout {
  Bore kind = Bore::round;
  double shaft = 0;                 ///< diameter of the shaft, without hole compensation; unused for a horn
  Polygon outline;                  ///< counter-clockwise about the axis, hole compensation included
  std::optional<RoundHole> circle;  ///< circle that the outline's sides touch from outside; set for round bores
  std::size_t arc_points = 0;  ///< number of the outline's first points that lie on one arc about the axis (D, keyway)
  double radius = 0;           ///< radius of the largest circle about the axis that the bore reaches
  std::vector<Polygon> screw_holes;  ///< through holes of a servo horn; with a recess the first is the centre screw's
  double horn_recess = 0;            ///< depth of the horn's pocket from the bottom face; 0: through
  double horn_ceiling = 0;           ///< height of the cone above it, which closes it without a flat ceiling
  int spline_teeth = 0;              ///< teeth of a servo's shaft in the outline; 0: none
};

struct SetScrewLayout {
  bool present = false;
  double hole_diameter = 0;  ///< clearance or tapping diameter, compensated
  double z = 0;              ///< height of its axis, in the hub
  double angle = 0;          ///< direction of its axis about z, rad
  bool nut_trap = false;
  double nut_width = 0;  ///< across flats, compensated
  double nut_thickness = 0;
  double ceiling_slope = 0;  ///< angle of the hole's ceiling above the horizontal, rad
  double nut_distance = 0;   ///< distance from the axis to the middle of the nut
};

struct BodyLayout {
  Parts parts = Parts::one;  ///< number of printed parts; never automatic
  double ceiling_slope = 0;  ///< angle of downward faces above the horizontal, rad; 0: they may be flat
  double entry_lean = 0;     ///< angle between the walls of a channel entry and the normal of the groove edge, rad
  double tendon_diameter = 0;
  GrooveWalls p1, p2;
  double groove_depth = 0;
  double flange_thickness = 0;
  double lower_cone = 0;   ///< height of the cone between a groove edge and flange 1, where the flange projects over it
  double middle_cone = 0;  ///< height of the cone under the middle flange
  double upper_cone = 0;   ///< height of the cone under flange 2
  double z_p1 = 0;         ///< plane of groove P1
  double z_middle = 0;     ///< bottom of the middle flange's rim
  double z_mate = 0;       ///< in two parts: boundary of P1 and P2, within the middle flange
  double z_p2 = 0;
  double z_top = 0;       ///< top of flange 2
  double z_hub = 0;       ///< top of the hub (= z_top without one)
  double hub_radius = 0;  ///< 0: no hub
  BoreLayout bore;
  SetScrewLayout set_screw;
  double channel_width = 0;        ///< width of the tie-off channels
  double channel_fillet = 0;       ///< radius at which a channel leaves the floor's tangent, to its centre line
  double pocket_radius = 0;        ///< radius of the knot pockets
  double channel_ceiling = 0;      ///< rise of the channels' ceilings towards their outer walls; 0: flat
  double pocket_ceiling = 0;       ///< rise of the ceilings of P1's pockets where they open on the bed
  double min_wall = 0;             ///< thickness of the thinnest wall allowed
  double elephant_foot = 0;        ///< width of the chamfer at the bed
  DowelLayout dowels;              ///< of a part in two pieces
  double mark_depth = 0;           ///< depth of engraved marks; raised marks have the height that the file gives
  double scale = 1;                ///< all x, y, z of the mesh are times this: 1/(1 − shrinkage)
  std::vector<std::string> notes;  ///< reductions and omissions of "automatic" features, with reasons
};

/// Height of a chamfer or ceiling of this width that prints without support, mm.
double rise_of(const BodyLayout& layout, double width);
/// Slope of two ceilings that meet in a ridge over a slit, rad.
double ridge_slope(const BodyLayout& layout);

/// Resolves all sizes. Explicit numbers are kept (make_pulley reports impossible ones) and automatic ones are made to
/// fit.
BodyLayout resolve_layout(const Mechanism& mechanism, const SynthesisResult& synthesis);

}  // namespace fusee
