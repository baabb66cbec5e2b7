/// \file
/// Finds the position of a pulley in a mesh that was moved: grooves, axis, turn and side, from the mesh alone.
#pragma once

#include <optional>
#include <vector>

#include "fusee/solid/mesh.h"
#include "fusee/transmission/tendon_path.h"

namespace fusee {

/// The largest loop of the section at height z, counter-clockwise for either face orientation. Empty when the plane
/// misses the part.
std::optional<Polygon> outline_at(const TriangleMesh& mesh, double z);

struct GrooveInMesh {
  double z = 0;   ///< middle of its floor
  Polygon floor;  ///< as it stands in the mesh
};
/// The grooves that run round the z axis, from below: heights at which the part is thinner than above and below by at
/// least `least_depth` times its radius. `step`: sampling distance, less than half a groove's width.
std::vector<GrooveInMesh> find_grooves(const TriangleMesh& mesh, double least_depth, double step);

/// The groove floors of a pulley about its axis at home, mm. An empty floor is not searched for.
struct GrooveFloors {
  Polygon p1;
  Polygon p2;
};
/// Distance between two outlines in their present positions, mm: rms of the distances between parallel tangents,
/// without the worst quarter (channels cut outlines).
double outline_deviation(const GrooveFloors& found, const GrooveFloors& expected);

struct PlacedGroove {
  Side side = Side::left;
  double z = 0;   ///< in the mesh
  Polygon floor;  ///< returned to the axis, at home
};

/// A transformation: optionally turned over about the x axis, then turned, then moved.
struct Placement {
  std::vector<PlacedGroove> grooves;  ///< P1 and P2, or the only groove
  Vec2 axis = Vec2::Zero();           ///< position in the mesh; the bore's, if there is one
  double turn = 0;                    ///< about the axis, counter-clockwise from +z, rad
  bool tells_turn = true;             ///< false for round outlines, with `turn` 0
  bool turned_over = false;
  double deviation = 0;      ///< of the floors, as outline_deviation() defines it
  double bore_off_axis = 0;  ///< distance of the bore from the axis of the floors, mm; 0: none, or no bore
};

enum class PlacementStatus { found, unknown, mirrored, scaled };

struct PlacementResult {
  PlacementStatus status = PlacementStatus::unknown;
  Placement placement;  ///< for a mirrored part: of its mirror image
  double scale = 1;     ///< size of the part relative to the expected one
};

/// The connected components of a mesh, in the order of their first facets.
std::vector<TriangleMesh> bodies_of(const TriangleMesh& mesh);

/// Searches for the pulley with these floors, or for one of the two when the mesh has one groove. The deviation must be
/// below 2 % of the radius. If two placements fit equally well, the one not turned over is chosen. A single groove
/// looks the same mirrored and turned over, so it is never reported as mirrored.
PlacementResult find_placement(const TriangleMesh& mesh, const GrooveFloors& expected, double tendon_diameter);

}  // namespace fusee
