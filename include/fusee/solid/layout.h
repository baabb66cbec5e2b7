/// \file
/// The body's sizes with every "automatic" resolved: one place that solid, OpenSCAD, plates and report read.
///
/// Bottom to top along z: flange 1 | groove P1 | middle flange | groove P2 | flange 2 | hub. z = 0 is the bed. mm, rad.
/// These are the finished part's sizes; the mesh's coordinates are `scale` times them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "fusee/mechanism/mechanism.h"
#include "fusee/profile/synthesis.h"

namespace fusee {

/// Half of a groove's cross-section, from its floor to its lip: outward offset from the floor, axial distance from the groove's plane.
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

struct BoreLayout {
  Bore kind = Bore::round;
  Polygon outline;     ///< counter-clockwise about the axis, hole compensation included
  std::optional<RoundHole> circle;   ///< that the outline's sides touch from outside, where the bore is a circle
  std::size_t arc_points = 0;        ///< how many of the outline's first points lie on one arc about the axis (D, keyway)
  double radius = 0;   ///< of the largest circle about the axis that the bore reaches
  std::vector<Polygon> screw_holes;  ///< of a servo horn, through holes; with a recess the first is the centre screw's
  double horn_recess = 0;            ///< depth of the horn's pocket from the bottom face; 0: through
};

struct SetScrewLayout {
  bool present = false;
  double hole_diameter = 0;  ///< clearance or tapping diameter, compensated
  double z = 0;              ///< of its axis, in the hub
  double angle = 0;          ///< direction of its axis about z, rad
  bool nut_trap = false;
  double nut_width = 0;      ///< across flats, compensated
  double nut_thickness = 0;
  double nut_distance = 0;   ///< from the axis to the middle of the nut
};

struct BodyLayout {
  std::vector<GroovePoint> groove;  ///< first {0, 0}, last {groove_depth, groove_half_width}
  double groove_depth = 0;
  double groove_half_width = 0;
  double flange_thickness = 0;
  double z_p1 = 0;                  ///< plane of groove P1
  double z_p2 = 0;
  double z_top = 0;                 ///< top of flange 2
  double z_hub = 0;                 ///< top of the hub (= z_top without one)
  double hub_radius = 0;            ///< 0: no hub
  BoreLayout bore;
  SetScrewLayout set_screw;
  double channel_width = 0;         ///< of the tie-off channels
  double channel_fillet = 0;        ///< radius at which a channel leaves the floor's tangent, to its centre line
  double pocket_radius = 0;         ///< of the knot pockets
  double min_wall = 0;              ///< no wall is thinner
  double elephant_foot = 0;
  double mark_depth = 0;
  double scale = 1;                 ///< all x, y, z of the mesh are times this: 1/(1 − shrinkage)
  std::vector<std::string> notes;   ///< what "automatic" had to leave out or make small, and why
};

/// Sizes that follow from the mechanism alone (the grooves' section and heights): what rewinding a foreign file needs.
BodyLayout axial_layout(const Mechanism& mechanism);
/// All sizes. Explicit numbers are taken as they are (make_pulley refuses what is impossible); automatic ones are made to fit.
BodyLayout resolve_layout(const Mechanism& mechanism, const SynthesisResult& synthesis);

}  // namespace fusee
