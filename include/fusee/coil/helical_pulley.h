/// \file
/// Two spirals → one closed mesh: P1's helical groove under P2's, stacked along the axis. mm, rad.
///
/// Printed as it stands, without supports: every face that looks down is a groove's roof, a step between turns of
/// different radius or the cone under P2, and all of them are as steep as print.overhang asks. The ends of the grooves
/// at which the tendons stay wound, P1's last row and P2's first, lie at the two outer faces: each runs out
/// tangentially, along an arc inwards and down (up), into a knot pocket in its face. The other ends stop at a wall
/// inside of the part; no tendon is tied there.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "fusee/helix/spiral.h"
#include "fusee/mechanism/mechanism.h"
#include "fusee/profile/synthesis.h"
#include "fusee/solid/layout.h"
#include "fusee/solid/mesh.h"
#include "fusee/solid/pulley.h"
#include "fusee/transmission/tendon_path.h"

namespace fusee {

/// What a groove's section takes, for a synthesis that chooses a lead.
struct HelicalSection {
  GrooveWalls walls;
  double depth = 0;       ///< lip above the floor
  double rib = 0;         ///< thickness of a rib at its top
  double roof_slope = 0;  ///< of faces that look down, above the horizontal; 0: printed with supports

  double width() const { return walls.below_width() + walls.above_width(); }
};
HelicalSection helical_section(const Mechanism& mechanism);
/// The least axial distance of two neighbouring turns: the groove's width, a rib, and where the upper turn's lip stands
/// out by `growth` over the lower one's as much as its step takes to print. `growth` below 0: the upper is the smaller.
double least_lead(const HelicalSection& section, double growth);
/// In the part the turns of larger angle lie lower, whatever the sign of a spiral's slope: P1's last row and P2's first
/// are then at the outer faces. (To a tendon, a spiral and its image in z are one.) So of a turn and its next one, by
/// angle, whose radius is larger by `step`, `growth` is −step.
/// Where a spiral lies in the part: height above the lower face = offset + direction · SpiralRow::z.
struct SpiralPlace {
  double offset = 0;
  double direction = 1;

  double height(double z) const { return offset + direction * z; }
};

/// Where a tendon's end is tied.
struct HelicalAnchor {
  Side side = Side::left;
  Vec3 exit = Vec3::Zero();    ///< on the tendon's centre line, where the groove ends
  Vec3 pocket = Vec3::Zero();  ///< middle of the knot pocket in the face
  double pocket_radius = 0;
  double pocket_depth = 0;  ///< of its straight part; a cone leads on to the channel
  double bend_radius = 0;   ///< of the arc between the two, to the tendon's centre line
};

struct HelicalPlan;  // coil/helical_plan.h

struct HelicalPulley {
  bool made = false;
  BodyLayout layout;   ///< of hub, bore, screw, walls; z_p1 and z_p2: heights of the anchors' ends of the grooves
  SpiralPlace p1, p2;  ///< finished part's mm, times layout.scale in the mesh
  TriangleMesh mesh;   ///< coordinates are floats already
  std::vector<HelicalAnchor> anchors;
  std::vector<Condition> conditions;  ///< all, those that hold too
  double expected_volume = 0;         ///< of the grid, less what was cut out of it, mm³
  int expected_euler = 0;
  std::vector<Check> mesh_checks;           ///< check_mesh() of `mesh`
  std::shared_ptr<const HelicalPlan> plan;  ///< of one that is made

  std::string brief() const;
};

/// Both spirals at least a turn long, spare turns included, rows of strictly growing `turn`. `tolerance`: largest
/// sagitta of a chord, on the pitch curve and on all its parallels up to the lip. A brief search cuts it in fewer ways.
HelicalPulley make_helical_pulley(const Mechanism& mechanism, const Spiral& p1, const Spiral& p2,
                                  double tolerance = 0.01, TieOffSearch search = TieOffSearch::thorough);

/// Why it cannot be made, as far as is known before it is cut.
std::vector<Condition> helical_obstacles(const Mechanism& mechanism, const Spiral& p1, const Spiral& p2,
                                         double tolerance = 0.01);

/// What a mesh of this pulley must be, measured on `mesh`: check_mesh, Euler number, volume, and by half-planes through
/// the axis the thinnest rib, the shallowest groove and the thinnest wall to the bore.
std::vector<Check> check_helical_pulley(const TriangleMesh& mesh, const HelicalPulley& pulley,
                                        const HelicalSection& section, double tolerance = 0.01);

}  // namespace fusee
