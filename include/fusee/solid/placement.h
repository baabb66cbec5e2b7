/// \file
/// Where a pulley lies in a mesh that somebody moved: grooves, axis, turn and side, found from the mesh alone.
#pragma once

#include <optional>
#include <vector>

#include "fusee/solid/mesh.h"
#include "fusee/transmission/tendon_path.h"

namespace fusee {

/// The largest loop of the section at height z, counter-clockwise whichever way the faces look; none where the plane
/// misses the part.
std::optional<Polygon> outline_at(const TriangleMesh& mesh, double z);

struct GrooveInMesh {
  double z = 0;   ///< middle of its floor
  Polygon floor;  ///< as it stands in the mesh
};
/// The grooves that run round the z axis, from below up: heights at which the part is thinner, by at least
/// `least_depth` times its radius, than above and below. `step` is how finely it is looked at, less than half a
/// groove's width.
std::vector<GrooveInMesh> find_grooves(const TriangleMesh& mesh, double least_depth, double step);

/// The groove floors of a pulley about its axis at home, mm. One may be empty: it is not looked for.
struct GrooveFloors {
  Polygon p1;
  Polygon p2;
};
/// How far apart two outlines are where they lie, mm: rms of the distance between parallel tangents, leaving out the
/// quarter that is worst (channels cut outlines).
double outline_deviation(const GrooveFloors& found, const GrooveFloors& expected);

struct PlacedGroove {
  Side side = Side::left;
  double z = 0;   ///< in the mesh
  Polygon floor;  ///< brought back about the axis at home
};

/// Turned over about the x axis or not, then turned, then moved.
struct Placement {
  std::vector<PlacedGroove> grooves;  ///< P1 and P2, or the only one there is
  Vec2 axis = Vec2::Zero();           ///< where it stands in the mesh: the bore's, where there is a bore
  double turn = 0;                    ///< about it, counter-clockwise from +z, rad
  bool tells_turn = true;             ///< false: round, and `turn` is 0
  bool turned_over = false;
  double deviation = 0;      ///< of the floors, as outline_deviation()
  double bore_off_axis = 0;  ///< how far the bore stands from the axis that the floors have, mm; 0: at it, or none
};

enum class PlacementStatus { found, unknown, mirrored, scaled };

struct PlacementResult {
  PlacementStatus status = PlacementStatus::unknown;
  Placement placement;  ///< of what was found; of its mirror image where it is mirrored
  double scale = 1;     ///< size of the part in sizes of the expected one
};

/// What hangs together, each a mesh of its own; in the order of their first facets.
std::vector<TriangleMesh> bodies_of(const TriangleMesh& mesh);

/// Looks for the pulley with these floors, or for one of the two where the mesh has one groove. Found is what deviates
/// by less than 2 % of its radius; of two ways that fit alike, the one that is not turned over. One groove alone looks
/// the same mirrored and turned over: it is never called mirrored.
PlacementResult find_placement(const TriangleMesh& mesh, const GrooveFloors& expected, double tendon_diameter);

}  // namespace fusee
