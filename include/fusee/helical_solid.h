/// \file
/// Multi-turn pulleys as one checked solid, and strings wound on them in space.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "fusee/base.h"
#include "fusee/helix.h"
#include "fusee/mechanism.h"
#include "fusee/profile.h"
#include "fusee/solid.h"
#include "fusee/transmission.h"

namespace fusee::helical_solid {

// ---- Helical pulley -------------------------------------------------------------------------------------------------
// Two spirals → one closed mesh: P1's helical groove below P2's, stacked along the axis. mm, rad.
//
// The part prints upright without supports. Its downward faces are groove ceilings, steps between turns of different
// radius and the cone under P2. All of them are as steep as print.overhang requires. The groove ends at which the
// tendons stay wound, P1's last row and P2's first, lie at the two outer faces. Each continues tangentially, along an
// arc inwards and towards the face, into a knot pocket in that face. The other ends stop at a wall inside the part,
// where no tendon is tied.

/// The groove's cross-section, from which a synthesis chooses a lead.
struct HelicalSection {
  solid::GrooveWalls walls;
  double depth = 0;          ///< height of the groove edge above the floor
  double rib = 0;            ///< thickness of a rib at its top
  double ceiling_slope = 0;  ///< angle of downward faces above the horizontal; 0: printed with supports

  double width() const { return walls.below_width() + walls.above_width(); }
};
/// The cross-section of the mechanism's helical grooves, automatic sizes resolved. mm, rad.
HelicalSection helical_section(const Mechanism& mechanism);
/// The least axial distance of two neighbouring turns: the groove's width, a rib, and the height that a printable step
/// needs when the upper turn's edge projects over the lower one's by `growth`. `growth` is negative when the upper turn
/// is smaller.
double least_lead(const HelicalSection& section, double growth);
/// The position of a spiral in the part: height above the lower face = offset + direction · SpiralRow::z. Turns of
/// larger angle always lie lower, whatever the sign of the spiral's slope. P1's last row and P2's first are then at the
/// outer faces. (A spiral and its mirror image in z are equivalent for a tendon.) If the radius grows by `step` from
/// one turn to the next, the upper turn is smaller: the `growth` of least_lead() is −step.
struct SpiralPlace {
  double offset = 0;
  double direction = 1;

  double height(double z) const { return offset + direction * z; }
};

/// The fixed end of a tendon.
struct HelicalAnchor {
  transmission::Side side = transmission::Side::left;
  Vec3 exit = Vec3::Zero();    ///< on the tendon's centre line, where the groove ends
  Vec3 pocket = Vec3::Zero();  ///< middle of the knot pocket in the face
  double pocket_radius = 0;
  double pocket_depth = 0;  ///< depth of the cylindrical part; a cone joins it to the channel
  double bend_radius = 0;   ///< radius of the arc between exit and pocket, to the tendon's centre line
};

struct HelicalPlan;  // helical_solid/helical_plan.h

/// A multi-turn pulley as one solid, or the conditions that fail.
struct HelicalPulley {
  bool made = false;
  solid::BodyLayout layout;  ///< hub, bore, screw and walls; z_p1 and z_p2: heights of the groove ends at the anchors
  SpiralPlace p1, p2;        ///< in mm of the finished part, times layout.scale in the mesh
  solid::TriangleMesh mesh;  ///< coordinates are rounded to float
  std::vector<HelicalAnchor> anchors;
  std::vector<profile::Condition> conditions;  ///< all conditions, including those that hold
  double expected_volume = 0;                  ///< volume of the blank minus the volume cut from it, mm³
  int expected_euler = 0;
  std::vector<Check> mesh_checks;           ///< check_mesh() of `mesh`
  std::shared_ptr<const HelicalPlan> plan;  ///< set when `made`

  /// Summary: the result, or the failed conditions.
  std::string brief() const;
};

/// Requires both spirals to be at least a turn long, spare turns included, with rows of strictly growing `turn`.
/// `chord_error_mm`: largest sagitta, on the pitch curve and on all its parallels up to the groove edge. A brief
/// search tries fewer cut variants.
HelicalPulley make_helical_pulley(const Mechanism& mechanism, const helix::Spiral& p1, const helix::Spiral& p2,
                                  double chord_error_mm = 0.01,
                                  solid::TieOffSearch search = solid::TieOffSearch::thorough);

/// The conditions that fail, as far as they are known before the cuts.
std::vector<profile::Condition> helical_obstacles(const Mechanism& mechanism, const helix::Spiral& p1,
                                                  const helix::Spiral& p2, double chord_error_mm = 0.01);

/// Checks of a mesh against its pulley: check_mesh, Euler number and volume. Half-planes through the axis measure the
/// thinnest rib, the shallowest groove and the thinnest wall to the bore.
std::vector<Check> check_helical_pulley(const solid::TriangleMesh& mesh, const HelicalPulley& pulley,
                                        const HelicalSection& section, double chord_error_mm = 0.01);

// ---- Rewinding ------------------------------------------------------------------------------------------------------
// Winds two inextensible strings in space on the helical grooves of a mesh and computes the joint angle they give.
// Shares no equation with the synthesis and uses no spiral. Floors are found where half-planes through the axis cut
// the mesh, lengths are summed piece by piece, and the joint angle is found by bisection. mm, rad.

/// A groove's floor in a mesh: the middle of its band, counter-clockwise seen from +z.
using FloorLine = std::vector<Vec3>;

/// All grooves of a mesh that go round the axis for at least half a turn, from below. `scale`: size of the mesh
/// relative to the finished part. Degenerate facets are skipped. The mesh should be a solid.
std::vector<FloorLine> helical_floors(const solid::TriangleMesh& mesh, double scale = 1.0, int half_planes = 720);

/// Axial positions of the tendons on the part. Heights are above its lower face.
struct TendonsLaid {
  /// Heights of the fixed ends of the sloping free paths: the attachments, or the collars of the pins.
  double z1 = 0, z2 = 0;
  bool collar = false;  ///< the pins hold the tendons at these heights, so that only the span below them slopes
  double spare1 = 0, spare2 = 0;  ///< angle by which the grooves continue past the working arcs to the knots, rad
};
/// `attachment1`, `attachment2`: heights in the frames of the spirals.
TendonsLaid tendons_laid(const HelicalPulley& pulley, const helix::Spiral& p1, const helix::Spiral& p2,
                         double attachment1, double attachment2, bool collar);

/// Joint angles of wound strings, and their fleet angles. rad.
struct HelicalRewind {
  profile::RewindResult result;  ///< as for one-turn pulleys
  double max_fleet = 0;          ///< largest angle between a span and its groove at the take-off
  double max_fleet_at = 0;       ///< α
  transmission::Side max_fleet_side = transmission::Side::left;
};

/// `stroke`: α in growing order through home, with the declared θ. Throws InputError when the mesh does not have
/// exactly two grooves, or when one ends within the range.
HelicalRewind rewind_helical(const solid::TriangleMesh& mesh, const Mechanism& mechanism,
                             const std::vector<transmission::TransmissionPoint>& stroke, const TendonsLaid& laid,
                             double scale = 1.0);
/// Winds on floors that were found before.
HelicalRewind rewind_floors(const FloorLine& floor1, const FloorLine& floor2, const Mechanism& mechanism,
                            const std::vector<transmission::TransmissionPoint>& stroke, const TendonsLaid& laid);

}  // namespace fusee::helical_solid
