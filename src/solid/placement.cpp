#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/decompositions.h"
#include "fusee/base.h"
#include "fusee/solid.h"
#include "solid/corners.h"
#include "solid/disjoint_sets.h"
#include "solid/outline_fit.h"

namespace fusee::solid {
namespace {

// Largest deviation of the same pulley, relative to its radius: 0.3 mm at 16 mm, more than the error of a print or a
// scan.
constexpr double k_most_deviation = 0.02;
// Largest relative deviation of a file that a program scaled or mirrored: 16 µm at 16 mm, slightly more than facets
// differ. A pulley for another r1 is nearly a scaled copy, to within some 0.1 %.
constexpr double k_most_deviation_of_copy = 0.001;
// A size that differs by more is a wrong unit or a slicer's scaling, not shrinkage.
constexpr double k_most_rescaled = 0.02;
// Factor by which a more complex placement must fit better: curves that are their own mirror image fit both ways.
constexpr double k_clearly_better = 0.5;
// Least depth of a groove, in tendon diameters.
constexpr double k_least_groove = 0.3;
// Slices per tendon diameter. A groove's floor and walls are 1 to 2 diameters wide.
constexpr double k_slices = 4.0;
// Limits for a bore: roundness relative to its radius, and largest distance from the axis (mm). Other holes are
// ignored. Below the accuracy of facets the distance counts as zero.
constexpr double k_bore_roundness = 0.01;
constexpr double k_bore_reach = 1.0;
constexpr double k_bore_at_axis = 0.01;

double radius_of(const Polygon& outline) { return std::sqrt(std::abs(signed_area(convex_hull(outline))) / k_pi); }

/// Mean radius of the floors that are searched for.
double mean_radius(const GrooveFloors& floors) {
  if (floors.p1.empty()) return radius_of(floors.p2);
  return floors.p2.empty() ? radius_of(floors.p1) : 0.5 * (radius_of(floors.p1) + radius_of(floors.p2));
}

const Polygon& floor_of(const GrooveFloors& floors, transmission::Side side) {
  return side == transmission::Side::left ? floors.p1 : floors.p2;
}

// ---- assignments of the mesh's grooves to those of the pulley -------------------------------------------------------

/// A groove of the mesh that is assigned to one side.
struct Match {
  transmission::Side side = transmission::Side::left;
  const GrooveInMesh* groove = nullptr;
};

/// An assignment of grooves of the mesh to the pulley's sides.
struct Assignment {
  std::vector<Match> matches;
  bool flipped = false;  ///< outlines seen from below: turned over, or mirrored
  bool mirrored = false;
};

/// (x, y) → (x, −y), counter-clockwise again: the outline of a part that was turned over about x.
Polygon seen_from_below(Polygon outline) {
  for (Vec2& point : outline) point.y() = -point.y();
  std::reverse(outline.begin(), outline.end());
  return outline;
}

Polygon seen(const Polygon& outline, bool flipped) { return flipped ? seen_from_below(outline) : outline; }

std::vector<OutlinePair> pairs_of(const Assignment& assignment, const GrooveFloors& expected, double scale) {
  std::vector<OutlinePair> pairs;
  for (const Match& match : assignment.matches) {
    OutlinePair pair{seen(match.groove->floor, assignment.flipped), floor_of(expected, match.side)};
    for (Vec2& point : pair.found) point /= scale;
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

double scale_of(const Assignment& assignment, const GrooveFloors& expected) {
  double found = 0, wanted = 0;
  for (const OutlinePair& pair : pairs_of(assignment, expected, 1.0)) {
    found += perimeter(convex_hull(pair.found));
    wanted += perimeter(convex_hull(pair.expected));
  }
  return found / wanted;
}

struct FittedAssignment {
  Assignment assignment;
  OutlineFit fit;
  double scale = 1;
  double deviation = std::numeric_limits<double>::infinity();  ///< in units of the expected part
};

/// A part of another size is scaled to the expected size before it is fitted.
FittedAssignment fit_assignment(const Assignment& assignment, const GrooveFloors& expected) {
  const double scale = scale_of(assignment, expected);
  FittedAssignment result{assignment, {}, std::abs(scale - 1) > k_most_rescaled ? scale : 1.0};
  const std::vector<OutlinePair> pairs = pairs_of(assignment, expected, result.scale);
  result.fit = fit_outlines(pairs);
  result.deviation = deviation(pairs, result.fit.motion);
  return result;
}

/// P1 is below P2 as built. Seen from below the upper one is P1. The other two orders are mirror images.
std::vector<Assignment> assignments_of_both(const std::vector<GrooveInMesh>& grooves, const GrooveFloors& expected) {
  std::vector<Assignment> assignments;
  if (expected.p1.empty() || expected.p2.empty()) return assignments;
  for (std::size_t low = 0; low < grooves.size(); ++low) {
    // A part may be thinner between the grooves as well: where two prints meet, or under a hub.
    for (std::size_t high = low + 1; high < grooves.size(); ++high) {
      const std::vector<Match> upright{{transmission::Side::left, &grooves[low]},
                                       {transmission::Side::right, &grooves[high]}};
      const std::vector<Match> upside_down{{transmission::Side::left, &grooves[high]},
                                           {transmission::Side::right, &grooves[low]}};
      assignments.push_back({.matches = upright, .flipped = false, .mirrored = false});
      assignments.push_back({.matches = upside_down, .flipped = true, .mirrored = false});
      assignments.push_back({.matches = upright, .flipped = true, .mirrored = true});
      assignments.push_back({.matches = upside_down, .flipped = false, .mirrored = true});
    }
  }
  return assignments;
}

std::vector<Assignment> assignments_of_one(const std::vector<GrooveInMesh>& grooves, const GrooveFloors& expected) {
  std::vector<Assignment> assignments;
  // With two grooves, one alone could belong to many pulleys.
  if (grooves.size() != 1) return assignments;
  for (const bool flipped : {false, true}) {
    for (const transmission::Side side : {transmission::Side::left, transmission::Side::right}) {
      if (!floor_of(expected, side).empty()) assignments.push_back({{{side, &grooves.front()}}, flipped, false});
    }
  }
  return assignments;
}

bool fits(const FittedAssignment& fitted, double radius) {
  // Every circle is a scaled copy of every other circle.
  if (fitted.scale != 1.0 && !fitted.fit.tells_turn) return false;
  const bool is_copy = fitted.scale != 1.0 || fitted.assignment.mirrored;
  return fitted.deviation < (is_copy ? k_most_deviation_of_copy : k_most_deviation) * radius;
}

/// Rank of a placement by complexity: turned over, then mirrored, then scaled. The simplest has 0.
int complexity(const FittedAssignment& fitted) {
  return 4 * static_cast<int>(fitted.scale != 1.0) + 2 * static_cast<int>(fitted.assignment.mirrored) +
         static_cast<int>(fitted.assignment.flipped && !fitted.assignment.mirrored);
}

/// Empty if no assignment fits.
std::optional<FittedAssignment> best_of(const std::vector<Assignment>& assignments, const GrooveFloors& expected) {
  std::vector<FittedAssignment> all;
  for (const Assignment& assignment : assignments) {
    FittedAssignment one = fit_assignment(assignment, expected);
    if (fits(one, mean_radius(expected))) all.push_back(std::move(one));
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const FittedAssignment& a, const FittedAssignment& b) { return complexity(a) < complexity(b); });
  std::optional<FittedAssignment> best;
  for (const FittedAssignment& one : all) {
    // Assignments are in the order of complexity.
    const double required_factor = best && complexity(one) != complexity(*best) ? k_clearly_better : 1.0;
    if (!best || one.deviation < required_factor * best->deviation) best = one;
  }
  return best;
}

// ---- the bore -------------------------------------------------------------------------------------------------------

/// Centre of the circle through the corners; empty if they are on no circle. A flat is a chord, whose ends are on the
/// circle too. Least squares for |p|² = 2 p · c + r² − |c|², with points relative to one corner.
std::optional<Vec2> centre_of_round(const Polygon& hole) {
  const Polygon corners = corners_of(hole);
  if (corners.size() < 4) return std::nullopt;
  const auto rows = static_cast<Eigen::Index>(corners.size());
  Eigen::MatrixXd lines(rows, 3);
  Eigen::VectorXd squares(rows);
  const Vec2& origin = corners.front();
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Vec2 point = corners[static_cast<std::size_t>(i)] - origin;
    lines.row(i) << 2 * point.x(), 2 * point.y(), 1;
    squares[i] = point.squaredNorm();
  }
  const Eigen::Vector3d solution = LeastSquares(lines).nearest(squares);
  const Vec2 centre = origin + solution.head<2>();
  const double radius = std::sqrt(std::max(0.0, solution[2] + solution.head<2>().squaredNorm()));
  const bool is_round = std::all_of(corners.begin(), corners.end(), [&](const Vec2& corner) {
    return std::abs((corner - centre).norm() - radius) < k_bore_roundness * radius;
  });
  return is_round ? std::optional(centre) : std::nullopt;
}

/// Centre of the round hole nearest to an approximately known axis, if one is close to it. The outline is no hole.
std::optional<Vec2> bore_near(const TriangleMesh& mesh, double z, const Vec2& axis) {
  std::optional<Vec2> nearest;
  const std::vector<Polygon> loops = section(mesh, z);
  const std::optional<Polygon> outline = outline_at(mesh, z);
  for (const Polygon& loop : loops) {
    if (std::abs(signed_area(loop)) >= signed_area(*outline)) continue;
    const std::optional<Vec2> centre = centre_of_round(loop);
    if (!centre || (*centre - axis).norm() > k_bore_reach) continue;
    if (!nearest || (*centre - axis).norm() < (*nearest - axis).norm()) nearest = centre;
  }
  return nearest;
}

// ---- placement ------------------------------------------------------------------------------------------------------

Vec2 flipped(const Vec2& point, bool is_flipped) { return is_flipped ? Vec2(point.x(), -point.y()) : point; }

/// The axis in the mesh: the point that the motion maps to the origin.
Vec2 axis_of(const PlaneMotion& motion, bool is_flipped) {
  return flipped(turned(-motion.shift, -motion.turn), is_flipped);
}

double within_half_a_turn(double angle) { return angle - k_two_pi * std::round(angle / k_two_pi); }

Placement placement_of(const TriangleMesh& mesh, const FittedAssignment& fitted) {
  const bool upside_down = fitted.assignment.flipped;
  PlaneMotion motion = fitted.fit.motion;
  motion.shift *= fitted.scale;
  Placement placement;
  placement.turned_over = upside_down;
  placement.tells_turn = fitted.fit.tells_turn;
  placement.deviation = fitted.deviation;
  placement.turn = within_half_a_turn(upside_down ? motion.turn : -motion.turn);
  placement.axis = axis_of(motion, upside_down);
  if (const auto bore = bore_near(mesh, fitted.assignment.matches.front().groove->z, placement.axis)) {
    const double off = (*bore - placement.axis).norm();
    if (off > k_bore_at_axis) {
      // The bore defines the axis of rotation. A groove that is eccentric to it runs out of true on the joint.
      placement.bore_off_axis = off;
      placement.axis = *bore;
      motion.shift = -turned(flipped(*bore, upside_down), motion.turn);
    }
  }
  for (const Match& match : fitted.assignment.matches) {
    PlacedGroove groove{match.side, match.groove->z, seen(match.groove->floor, upside_down)};
    for (Vec2& point : groove.floor) point = motion(point);
    placement.grooves.push_back(std::move(groove));
  }
  return placement;
}

PlacementStatus status_of(const FittedAssignment& fitted) {
  if (fitted.scale != 1.0) return PlacementStatus::scaled;
  return fitted.assignment.mirrored ? PlacementStatus::mirrored : PlacementStatus::found;
}

}  // namespace

double outline_deviation(const GrooveFloors& found, const GrooveFloors& expected) {
  return deviation({{found.p1, expected.p1}, {found.p2, expected.p2}}, PlaneMotion());
}

std::vector<TriangleMesh> bodies_of(const TriangleMesh& mesh) {
  const TriangleMesh welded = weld(mesh);
  DisjointSets sets(welded.vertices.size());
  const auto is_whole = [&](const std::array<std::uint32_t, 3>& triangle) {
    return *std::max_element(triangle.begin(), triangle.end()) < welded.vertices.size();
  };
  for (const auto& triangle : welded.triangles) {
    if (!is_whole(triangle)) continue;
    sets.unite(triangle[0], triangle[1]);
    sets.unite(triangle[0], triangle[2]);
  }
  std::vector<TriangleMesh> bodies;
  std::vector<std::optional<std::size_t>> body_of(welded.vertices.size());
  for (const auto& triangle : welded.triangles) {
    if (!is_whole(triangle)) continue;
    std::optional<std::size_t>& body = body_of[sets.root(triangle[0])];
    if (!body) {
      body = bodies.size();
      bodies.emplace_back();
    }
    TriangleMesh& part = bodies[*body];
    const auto first = static_cast<std::uint32_t>(part.vertices.size());
    for (const std::uint32_t vertex : triangle) part.vertices.push_back(welded.vertices[vertex]);
    part.triangles.push_back({first, first + 1, first + 2});
  }
  return bodies;
}

PlacementResult find_placement(const TriangleMesh& mesh, const GrooveFloors& expected, double tendon_diameter) {
  const double radius = mean_radius(expected);
  const Bounds box = bounds(mesh);
  // In another unit the part has the same number of slices.
  const double unit_here = (box.high - box.low).head<2>().maxCoeff() / (2.0 * radius);
  const std::vector<GrooveInMesh> grooves =
      find_grooves(mesh, k_least_groove * tendon_diameter / radius, unit_here * tendon_diameter / k_slices);
  for (const std::vector<Assignment>& assignments :
       {assignments_of_both(grooves, expected), assignments_of_one(grooves, expected)}) {
    if (const auto best = best_of(assignments, expected))
      return {status_of(*best), placement_of(mesh, *best), best->scale};
  }
  return {};
}

}  // namespace fusee::solid
