// Complete bodies with all features, and a damaged part for each check.
#include <gmock/gmock.h>

#include "base/text.h"
#include "fusee/mechanism_file.h"
#include "fusee/solid.h"
#include "mechanism/catalogue.h"
#include "solid/broken.h"
#include "support/shapes.h"

namespace fusee::solid {
namespace {

using testing::check_named;
using testing::circle;
using testing::failed;
using testing::plain_mechanism;
using testing::pulley_of;
using testing::SupportShape;

constexpr double k_tolerance = 0.01;  // chord error, mm

std::string failures(const Pulley& pulley, const Mechanism& mechanism, const profile::SynthesisResult& shape) {
  return failed(check_pulley(pulley.mesh, mechanism, shape, pulley, k_tolerance));
}

struct BuiltPiece {
  Mechanism mechanism = plain_mechanism();
  profile::SynthesisResult shape = pulley_of(circle(20), circle(18, {3, 1}));
  Pulley pulley = make_pulley(mechanism, shape);
};

TEST(Pulley, DefaultBodyPassesEveryCheck) {
  const BuiltPiece made;
  ASSERT_TRUE(made.pulley.made()) << made.pulley.brief();
  EXPECT_EQ(failures(made.pulley, made.mechanism, made.shape), "");
  EXPECT_THAT(made.pulley.layout.notes, ::testing::IsEmpty());
  EXPECT_EQ(made.pulley.anchors.size(), 4u);
  EXPECT_TRUE(made.pulley.layout.set_screw.present);
  // Bore 1, tie-offs 4, set screw 1, nut trap 1 handles.
  EXPECT_EQ(made.pulley.expected_euler, 2 - 2 * 7);
}

TEST(Pulley, IsDeterministic) {
  const BuiltPiece first, second;
  ASSERT_EQ(first.pulley.mesh.triangles, second.pulley.mesh.triangles);
  EXPECT_TRUE(first.pulley.mesh.vertices == second.pulley.mesh.vertices);
}

TEST(Pulley, BuildsEveryKindOfBody) {
  const profile::SynthesisResult shape = pulley_of({22, {{2, 2, 0.5}, {1, 3, 0}}}, {25, {{2, -1.5, 1}}});
  for (const Bore bore : {Bore::round, Bore::d, Bore::hex, Bore::square, Bore::keyway}) {
    for (const Flange flange : {Flange::follow, Flange::round}) {
      Mechanism mechanism = plain_mechanism();
      mechanism.body.bore = bore;
      mechanism.body.flange = flange;
      mechanism.body.groove = Groove::u;
      if (bore == Bore::hex) mechanism.body.groove = Groove::v;
      if (bore == Bore::d) mechanism.body.groove = Groove::flat;
      const Pulley pulley = make_pulley(mechanism, shape);
      ASSERT_TRUE(pulley.made()) << pulley.brief();
      EXPECT_EQ(failures(pulley, mechanism, shape), "") << static_cast<int>(bore);
    }
  }
}

TEST(Pulley, RaisedMarksProjectFromFace) {
  Mechanism mechanism = plain_mechanism();
  mechanism.body.marks = Marks::none;
  mechanism.body.hub_height = 0;
  mechanism.body.set_screw = "none";
  const profile::SynthesisResult shape = pulley_of(circle(20), circle(20));
  const Pulley plain = make_pulley(mechanism, shape);
  mechanism.body.marks = Marks::raised;
  const Pulley raised = make_pulley(mechanism, shape);
  EXPECT_EQ(failures(raised, mechanism, shape), "");
  EXPECT_NEAR(bounds(raised.mesh).high.z(), bounds(plain.mesh).high.z() + mechanism.body.mark_depth, 1e-5);
}

TEST(Pulley, ShrinkageScalesMeshOnly) {
  Mechanism mechanism = plain_mechanism();
  const profile::SynthesisResult shape = pulley_of(circle(20), circle(18, {3, 1}));
  const Pulley plain = make_pulley(mechanism, shape);
  mechanism.material.shrinkage = 0.02;
  const Pulley larger = make_pulley(mechanism, shape);
  EXPECT_EQ(failures(larger, mechanism, shape), "");
  EXPECT_NEAR(larger.expected_volume * std::pow(0.98, 3), plain.expected_volume, 1e-5 * plain.expected_volume);
  EXPECT_NEAR(bounds(larger.mesh).high.z() * 0.98, bounds(plain.mesh).high.z(), 1e-5);
}

TEST(Pulley, SectionsAtGroovesAreFloors) {
  const BuiltPiece made;
  const Polygon floor = profile::parallel(made.shape.p1, -0.5);
  const Polygon loop = outer_loop(section(made.pulley.mesh, made.pulley.layout.z_p1));
  // Every point of the active arc is a point of the section.
  for (std::size_t i = 0; i < floor.size(); ++i) {
    if (!made.shape.p1.is_active(i)) continue;
    double least = 1e9;
    for (const Vec2& point : loop) least = std::min(least, (point - floor[i]).norm());
    EXPECT_LT(least, 2e-6);
  }
}

TEST(Pulley, TieOffsStartPastWoundEnds) {
  const BuiltPiece made;
  for (const Anchor& anchor : made.pulley.anchors) {
    if (!anchor.wound_end) continue;
    const profile::Outline& outline = anchor.side == transmission::Side::left ? made.shape.p1 : made.shape.p2;
    const Vec2 end = outline.points[outline.anchor_end()].position;
    // An entry lies at least 1.6 tendon diameters, 1.6 mm, along the curve from the end.
    EXPECT_GE((anchor.exit - end).norm(), 1.5);
    // P1's tendon continues counter-clockwise, P2's clockwise.
    EXPECT_EQ(cross(end, anchor.exit) > 0, anchor.side == transmission::Side::left);
    EXPECT_GT(signed_area(anchor.channel), 0);
  }
}

// ---- each check fails on a part with its kind of damage -------------------------------------------------------------

TEST(CheckPulley, DetectsWrongRadius) {
  BuiltPiece made;
  const profile::SynthesisResult larger = pulley_of(circle(20.05), circle(18, {3, 1}));
  const auto checks = check_pulley(made.pulley.mesh, made.mechanism, larger, made.pulley, k_tolerance);
  EXPECT_EQ(failed(checks), "floor_deviation_P1 groove_depth_P1");
  EXPECT_NEAR(check_named(checks, "floor_deviation_P1").value, 0.05, 0.005);
}

TEST(CheckPulley, DetectsMovedFloorVertex) {
  BuiltPiece made;
  const double z = made.pulley.layout.z_p2;
  const GrooveWalls& walls = made.pulley.layout.p2;
  Vec3* moved = nullptr;
  for (Vec3& vertex : made.pulley.mesh.vertices) {
    const bool on_band = vertex.z() > z - 1.01 * walls.below[1].dz && vertex.z() < z + 1.01 * walls.above[1].dz;
    if (on_band && std::abs((vertex.head<2>() - Vec2(3, 1)).norm() - 17.5) < 1e-3 && vertex.y() < -10) moved = &vertex;
  }
  ASSERT_NE(moved, nullptr);
  moved->head<2>() *= 1.05;
  const auto checks = check_pulley(made.pulley.mesh, made.mechanism, made.shape, made.pulley, k_tolerance);
  EXPECT_FALSE(check_named(checks, "floor_deviation_P2").ok);
  EXPECT_FALSE(check_named(checks, "volume_deviation").ok);
}

TEST(CheckPulley, MissingFeatureChangesVolumeAndEulerNumber) {
  BuiltPiece made;
  Mechanism without = made.mechanism;
  without.body.set_screw = "none";
  without.body.hub_diameter = 2.0 * made.pulley.layout.hub_radius;
  const Pulley other = make_pulley(without, made.shape);
  ASSERT_TRUE(other.made()) << other.brief();
  EXPECT_EQ(failed(check_pulley(other.mesh, made.mechanism, made.shape, made.pulley, k_tolerance)),
            "euler_number volume_deviation");
}

TEST(CheckPulley, DetectsThinWall) {
  BuiltPiece made;
  made.pulley.layout.min_wall = 8.5;
  EXPECT_EQ(failures(made.pulley, made.mechanism, made.shape), "wall_P2");
}

TEST(CheckPulley, DetectsShallowAndNarrowGroove) {
  BuiltPiece made;
  made.pulley.layout.groove_depth += 0.5;
  made.mechanism.tendon.diameter = 1.0;
  EXPECT_EQ(failures(made.pulley, made.mechanism, made.shape), "groove_depth_P1 groove_depth_P2");
  BuiltPiece narrow;
  narrow.mechanism.tendon.diameter = 1.4;
  const std::string names = failures(narrow.pulley, narrow.mechanism, narrow.shape);
  EXPECT_NE(names.find("groove_width_P1"), std::string::npos);
  EXPECT_NE(names.find("groove_width_P2"), std::string::npos);
}

// The flange is measured outside the features cut into it. In this pulley the tail's slot lies in the section of the
// groove edge.
TEST(CheckPulley, MeasuresGrooveDepthBesideTailSlot) {
  const Mechanism mechanism = parse_mechanism(find_template("paper_optimum"), "paper_optimum.toml", ".",
                                              {{"body.flange", "round"}, {"print.parts", "two"}});
  const profile::SynthesisResult shape = profile::synthesise(mechanism);
  ASSERT_TRUE(shape.made());
  const Pulley pulley = make_pulley(mechanism, shape);
  ASSERT_TRUE(pulley.made()) << pulley.brief();
  EXPECT_EQ(failures(pulley, mechanism, shape), "");
}

TEST(CheckPulley, HandlesEmptyAndDamagedMeshes) {
  BuiltPiece made;
  EXPECT_NE(failed(check_pulley({}, made.mechanism, made.shape, made.pulley, k_tolerance)), "");
  TriangleMesh flat = made.pulley.mesh;
  for (Vec3& vertex : flat.vertices) vertex.z() = 0;
  const std::string names = failed(check_pulley(flat, made.mechanism, made.shape, made.pulley, k_tolerance));
  EXPECT_NE(names.find("floor_deviation_P1"), std::string::npos);
}

// Sixteen shapes and bodies. The tests of the laws run hundreds of whole mechanisms.
TEST(Pulley, PassesChecksOrReportsWhyNot) {
  int made = 0;
  for (int k = 0; k < 16; ++k) {
    const double r = 6.0 + 2.1 * k, ratio = 0.7 + 0.03 * k;
    const double wobble = 0.03 * r * std::sin(1.7 * k);
    const SupportShape p1{r, {{1, 0.1 * r * std::sin(k), 0}, {2, wobble, 0.02 * r}}},
        p2{r * ratio, {{1, 0, 0.1 * r}, {3, 0.01 * r, 0}}};
    Mechanism mechanism = plain_mechanism();
    mechanism.tendon.diameter = 0.3 + 0.1 * (k % 7);
    mechanism.body.groove = static_cast<Groove>(k % 3);
    mechanism.body.flange = static_cast<Flange>(k % 2);
    const profile::SynthesisResult shape = pulley_of(p1, p2, 160 + 16 * k);
    const Pulley pulley = make_pulley(mechanism, shape);
    if (!pulley.made()) {
      EXPECT_NE(pulley.brief().find(" mm"), std::string::npos) << pulley.brief();
      continue;
    }
    ++made;
    EXPECT_EQ(failed(check_pulley(pulley.mesh, mechanism, shape, pulley, 0.05)), "") << "k = " << k;
  }
  EXPECT_GE(made, 13);
}

}  // namespace
}  // namespace fusee::solid
