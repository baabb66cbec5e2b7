// Finds parts that a slicer moved, and identifies parts that were damaged on purpose.
#include <gmock/gmock.h>

#include <cmath>
#include <map>

#include "fusee/base.h"
#include "fusee/solid.h"
#include "support/mechanisms.h"
#include "support/shapes.h"

namespace fusee::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// A pulley as built, and the floors that identify it.
struct BuiltPiece {
  double tendon = 0;
  solid::BodyLayout layout;
  solid::TriangleMesh mesh;
  solid::GrooveFloors floors;
};

DeclaredMechanism with_body(DeclaredMechanism mechanism) {
  mechanism.body = plain_mechanism().body;
  return mechanism;
}

/// Built once for all tests.
const BuiltPiece& made(const std::string& name) {
  static const std::map<std::string, DeclaredMechanism> mechanisms = {{"forearm", with_body(forearm())},
                                                                      {"unsymmetric", with_body(unsymmetric())},
                                                                      {"linear_wrist", with_body(linear_wrist())}};
  static std::map<std::string, BuiltPiece> all;
  if (const auto found = all.find(name); found != all.end()) return found->second;
  const Mechanism mechanism = mechanisms.at(name);
  const profile::SynthesisResult synthesis = profile::synthesise(mechanism);
  const solid::Pulley pulley = solid::make_pulley(mechanism, synthesis);
  EXPECT_TRUE(pulley.made()) << pulley.brief();
  const double half = 0.5 * mechanism.tendon.diameter;
  return all[name] = {mechanism.tendon.diameter,
                      pulley.layout,
                      pulley.mesh,
                      {profile::parallel(synthesis.p1, -half), profile::parallel(synthesis.p2, -half)}};
}

/// The operations of a slicer, in its order, written as floats, as in an STL.
struct Move {
  bool turned_over = false;
  double turn_deg = 0;
  Vec3 by = Vec3::Zero();
  double scale = 1;
  bool mirrored = false;
};

solid::TriangleMesh moved(solid::TriangleMesh mesh, const Move& move) {
  for (Vec3& v : mesh.vertices) {
    if (move.mirrored) v.x() = -v.x();
    if (move.turned_over) v = Vec3(v.x(), -v.y(), -v.z());
    v.head<2>() = turned(v.head<2>(), radians(move.turn_deg));
    v = move.scale * v + move.by;
  }
  if (move.mirrored) {
    for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  }
  return solid::rounded_to_float(mesh);
}

solid::PlacementResult found(const BuiltPiece& part, const Move& move) {
  return solid::find_placement(moved(part.mesh, move), part.floors, part.tendon);
}

/// The facets on one side of a height: half a part, without the facets across it.
solid::TriangleMesh half(const solid::TriangleMesh& mesh, double z, bool upper) {
  solid::TriangleMesh kept{mesh.vertices, {}};
  for (const auto& triangle : mesh.triangles) {
    const bool inside = std::all_of(triangle.begin(), triangle.end(), [&](std::uint32_t vertex) {
      return upper ? mesh.vertices[vertex].z() > z : mesh.vertices[vertex].z() < z;
    });
    if (inside) kept.triangles.push_back(triangle);
  }
  return kept;
}

/// The height half-way between both grooves.
double between_grooves(const solid::BodyLayout& layout) { return 0.5 * (layout.z_p1 + layout.z_p2); }

double largest_distance(const Polygon& a, const Polygon& b) {
  double largest = 0;
  for (const Vec2& corner : convex_hull(a)) largest = std::max(largest, distance_to_edges(convex_hull(b), corner));
  return largest;
}

class EveryPulley : public ::testing::TestWithParam<const char*> {
 protected:
  const BuiltPiece& part = made(GetParam());
};
INSTANTIATE_TEST_SUITE_P(Profiles, EveryPulley, ::testing::Values("forearm", "unsymmetric"),
                         [](const auto& tested) { return std::string(tested.param); });

TEST_P(EveryPulley, HasTwoGroovesAtLayoutHeights) {
  const std::vector<solid::GrooveInMesh> grooves =
      solid::find_grooves(part.mesh, 0.3 * part.tendon / 16, part.tendon / 4);
  ASSERT_THAT(grooves, SizeIs(2));
  EXPECT_NEAR(grooves[0].z, part.layout.z_p1, 0.01);
  EXPECT_NEAR(grooves[1].z, part.layout.z_p2, 0.01);
}

TEST_P(EveryPulley, IsFoundInAnyPosition) {
  for (const bool over : {false, true}) {
    for (const double turn : {0.0, 90.0, -37.3, 181.7}) {
      const Move move{over, turn, Vec3(123.4, -41.5, 17)};
      const solid::PlacementResult result = found(part, move);
      SCOPED_TRACE("turned by " + std::to_string(turn) + (over ? ", upside down" : ""));
      ASSERT_EQ(result.status, solid::PlacementStatus::found);
      const solid::Placement& placement = result.placement;
      EXPECT_EQ(placement.turned_over, over);
      // Floats of 123 mm are 8e-6 mm apart. The fit averages over all directions.
      EXPECT_LT((placement.axis - move.by.head<2>()).norm(), 2e-6);
      EXPECT_NEAR(std::remainder(degrees(placement.turn) - turn, 360.0), 0, 2e-5);
      EXPECT_LT(placement.deviation, 1e-5);
      EXPECT_EQ(placement.bore_off_axis, 0);
      ASSERT_THAT(placement.grooves, SizeIs(2));
      EXPECT_EQ(placement.grooves[0].side, transmission::Side::left);
      EXPECT_NEAR(placement.grooves[0].z, 17 + (over ? -1 : 1) * part.layout.z_p1, 0.01);
      EXPECT_NEAR(placement.grooves[1].z, 17 + (over ? -1 : 1) * part.layout.z_p2, 0.01);
      const Polygon unmoved = *solid::outline_at(part.mesh, part.layout.z_p2);
      EXPECT_LT(largest_distance(placement.grooves[1].floor, unmoved), 2e-5);
    }
  }
}

TEST_P(EveryPulley, IsReportedMirroredInAnyPosition) {
  for (const bool over : {false, true})
    EXPECT_EQ(found(part, {over, 65, Vec3(10, 20, 0), 1, true}).status, solid::PlacementStatus::mirrored);
}

TEST_P(EveryPulley, ReportsItsScale) {
  for (const double scale : {1 / 25.4, 0.9, 1.05, 25.4}) {
    const solid::PlacementResult result = found(part, {true, 65, Vec3(10, 20, 0), scale});
    EXPECT_EQ(result.status, solid::PlacementStatus::scaled);
    EXPECT_NEAR(result.scale / scale, 1, 1e-3);
  }
  // A print that shrank is the same pulley.
  EXPECT_EQ(found(part, {false, 0, Vec3(10, 20, 0), 0.995}).status, solid::PlacementStatus::found);
}

TEST_P(EveryPulley, FindsTurnOfP2Alone) {
  const solid::TriangleMesh upper = half(part.mesh, between_grooves(part.layout), true);
  for (const bool over : {false, true}) {
    const solid::PlacementResult result =
        solid::find_placement(moved(upper, {over, -70, Vec3(-30, 9, 0)}), part.floors, part.tendon);
    ASSERT_EQ(result.status, solid::PlacementStatus::found);
    ASSERT_THAT(result.placement.grooves, SizeIs(1));
    EXPECT_EQ(result.placement.grooves[0].side, transmission::Side::right);
    EXPECT_EQ(result.placement.turned_over, over);
    EXPECT_NEAR(degrees(result.placement.turn), -70, 1e-4);
    EXPECT_LT((result.placement.axis - Vec2(-30, 9)).norm(), 1e-5);
  }
}

TEST(RoundP1, HasNoTurn) {
  const BuiltPiece& part = made("forearm");
  const solid::TriangleMesh lower = half(part.mesh, between_grooves(part.layout), false);
  const solid::PlacementResult result =
      solid::find_placement(moved(lower, {false, -70, Vec3(-30, 9, 0)}), part.floors, part.tendon);
  ASSERT_EQ(result.status, solid::PlacementStatus::found);
  ASSERT_THAT(result.placement.grooves, SizeIs(1));
  EXPECT_EQ(result.placement.grooves[0].side, transmission::Side::left);
  EXPECT_FALSE(result.placement.tells_turn);
  EXPECT_EQ(result.placement.turn, 0);
  EXPECT_LT((result.placement.axis - Vec2(-30, 9)).norm(), 1e-4);
  EXPECT_TRUE(found(part, {false, -70, Vec3(-30, 9, 0)}).placement.tells_turn);
}

// P1 is the mirror image of P2, so that the pulley is the same upside down.
TEST(MirrorTwins, AreNotReportedTurnedOver) {
  const solid::PlacementResult result = found(made("linear_wrist"), {true, 40, Vec3(50, 60, 70)});
  EXPECT_EQ(result.status, solid::PlacementStatus::found);
  EXPECT_FALSE(result.placement.turned_over);
  EXPECT_LT(result.placement.deviation, 1e-5);
}

TEST(Bores, DefineTheAxis) {
  const BuiltPiece& part = made("forearm");
  solid::TriangleMesh mesh = part.mesh;
  // Moves the bore alone, including its walls, off the axis of the grooves.
  for (Vec3& v : mesh.vertices) {
    if (v.head<2>().norm() < part.layout.bore.radius + 0.1) v.x() += 0.2;
  }
  const solid::PlacementResult result =
      solid::find_placement(moved(mesh, {true, 30, Vec3(40, 50, 0)}), part.floors, part.tendon);
  ASSERT_EQ(result.status, solid::PlacementStatus::found);
  EXPECT_NEAR(result.placement.bore_off_axis, 0.2, 1e-4);
  const Vec2 bore = Vec2(40, 50) + turned(Vec2(0.2, 0), radians(30));
  EXPECT_LT((result.placement.axis - bore).norm(), 1e-4);
  // About the bore the floors are shifted by 0.2 mm: the rms distance of their tangents is 0.2 mm/√2.
  EXPECT_NEAR(
      solid::outline_deviation({result.placement.grooves[0].floor, result.placement.grooves[1].floor}, part.floors),
      0.2 / std::sqrt(2.0), 0.05);
}

TEST(OtherParts, AreNotRecognised) {
  const BuiltPiece& part = made("forearm");
  EXPECT_EQ(solid::find_placement(solid::TriangleMesh(), part.floors, 1).status, solid::PlacementStatus::unknown);
  EXPECT_EQ(solid::find_placement(made("unsymmetric").mesh, {made("linear_wrist").floors.p1, part.floors.p2}, 1).status,
            solid::PlacementStatus::unknown);
  const solid::TriangleMesh cut = half(part.mesh, part.layout.z_p1, false);
  EXPECT_EQ(solid::find_placement(cut, part.floors, 1).status, solid::PlacementStatus::unknown);
  EXPECT_THAT(solid::find_grooves(cut, 0.02, 0.25), IsEmpty());
}

TEST(Bodies, AreSeparated) {
  const BuiltPiece& part = made("forearm");
  solid::TriangleMesh both = moved(part.mesh, {});
  const solid::TriangleMesh other = moved(part.mesh, {false, 0, Vec3(100, 0, 0)});
  const auto first = static_cast<std::uint32_t>(both.vertices.size());
  both.vertices.insert(both.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& [a, b, c] : other.triangles) both.triangles.push_back({first + a, first + b, first + c});
  const std::vector<solid::TriangleMesh> bodies = solid::bodies_of(both);
  ASSERT_THAT(bodies, SizeIs(2));
  EXPECT_THAT(bodies[0].triangles, SizeIs(part.mesh.triangles.size()));
  EXPECT_NEAR(solid::enclosed_volume(bodies[1]) / solid::enclosed_volume(part.mesh), 1, 1e-6);
  EXPECT_THAT(solid::bodies_of(part.mesh), SizeIs(1));
}

}  // namespace
}  // namespace fusee::testing
