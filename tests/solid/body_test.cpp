// The body as rings, against closed formulas of the discretised part.
#include "solid/body.h"

#include <gtest/gtest.h>

#include "solid/bore.h"
#include "solid/broken.h"
#include "solid/groove.h"
#include "solid/plane_distance.h"
#include "support/shapes.h"

namespace fusee {
namespace {

using testing::circle;
using testing::failed;
using testing::plain_mechanism;
using testing::pulley_of;
using testing::SupportShape;

// A frustum between regular n-gons of radii a and b, or a prism for a == b.
double frustum(int n, double a, double b, double height) {
  return 0.5 * n * std::sin(k_two_pi / n) * height * (a * a + a * b + b * b) / 3.0;
}

BodyLayout layout_of(const Mechanism& mechanism, double hub_radius = 0) {
  BodyLayout layout = axial_layout(mechanism);
  layout.bore = bore_layout(mechanism, 5);
  layout.hub_radius = hub_radius;
  if (hub_radius > 0) layout.z_hub = layout.z_top + 8;
  return layout;
}

TEST(Body, RoundPulleyHasTheVolumeOfItsFrustums) {
  Mechanism mechanism = plain_mechanism();
  const BodyLayout layout = layout_of(mechanism, 8);
  const int n = 240;
  const SynthesisResult shape = pulley_of(circle(20), circle(20), n);
  const RingStack stack = body_stack(shape.p1, shape.p2, 1.0, Flange::follow, layout);
  const double lip = 19.5 + layout.groove_depth, t = layout.flange_thickness, foot = 0.4;
  double groove = 0;
  for (std::size_t k = 2; k < layout.groove.size(); ++k) {
    groove += 2.0 * frustum(n, 19.5 + layout.groove[k - 1].offset, 19.5 + layout.groove[k].offset,
                            layout.groove[k].dz - layout.groove[k - 1].dz);
  }
  groove += frustum(n, 19.5, 19.5, 2.0 * layout.groove[1].dz);
  const FlangeRims rims = flange_rims(shape.p1, shape.p2, 1.0, layout.groove_depth, Flange::follow);
  const double middle = signed_area(rims.middle) * t;
  const double bore = signed_area(layout.bore.outline) * layout.z_hub;
  const double expected = frustum(n, lip - foot, lip, foot) + frustum(n, lip, lip, t - foot) + 2.0 * groove + middle +
                          frustum(n, lip, lip, t) + signed_area(stack.hub->outline) * 8 - bore;
  EXPECT_NEAR(signed_area(stack.hub->outline), k_pi * 64, 0.01 * k_two_pi * 8);
  EXPECT_NEAR(volume_of(stack), expected, 1e-9 * expected);
  EXPECT_NEAR(enclosed_volume(mesh_of(stack)), expected, 1e-9 * expected);
}

TEST(Body, IsASolidForAnyConvexPair) {
  const std::vector<SupportShape> shapes{
      circle(20), circle(15, {6, -3}), {18, {{2, 2.5, 1}, {3, 0.4, -0.6}}}, {25, {{1, -8, 2}, {2, 0, 3}}}};
  for (const Flange flange : {Flange::follow, Flange::round}) {
    for (const SupportShape& p1 : shapes) {
      for (const SupportShape& p2 : shapes) {
        const Mechanism mechanism = plain_mechanism();
        const SynthesisResult shape = pulley_of(p1, p2, 180);
        const RingStack stack =
            scaled_to_float(body_stack(shape.p1, shape.p2, 1.0, flange, layout_of(mechanism, 7)), 1.003);
        const TriangleMesh mesh = mesh_of(stack);
        EXPECT_EQ(failed(check_mesh(mesh)), "");
        EXPECT_NEAR(enclosed_volume(mesh), volume_of(stack), 1e-11 * volume_of(stack));
      }
    }
  }
}

TEST(Body, MiddleFlangeStandsOutsideBothLips) {
  const SynthesisResult shape = pulley_of(circle(20, {4, 0}), circle(20, {-4, 0}), 180);
  const FlangeRims rims = flange_rims(shape.p1, shape.p2, 1.0, 2.0, Flange::follow);
  for (const Polygon* lip : {&rims.lip1, &rims.lip2}) {
    for (const Vec2& point : *lip) EXPECT_GT(depth_inside(rims.middle, point), 0.15);
  }
  // Not more than the blend and the margin above the larger of both.
  EXPECT_NEAR(rims.middle.front().x(), 25.5 + 0.2, 0.01);
}

TEST(Groove, TendonLiesHalfItsDiameterAboveTheFloorInEveryKind) {
  for (const Groove kind : {Groove::u, Groove::v, Groove::flat}) {
    for (const double angle : {0.0, 30.0, 50.0, 90.0}) {
      Body body = plain_mechanism().body;
      body.groove = kind;
      body.groove_angle = radians(angle);
      for (const double d : {0.3, 1.0, 4.0}) {
        const auto section = groove_section(body, d, 2.0 * d);
        EXPECT_EQ(section[0].offset, 0.0);
        EXPECT_EQ(section[1].offset, 0.0);
        EXPECT_GT(section[1].dz, 0.0);
        EXPECT_DOUBLE_EQ(section.back().offset, 2.0 * d);
        // No wall comes nearer to the centre line, at offset d/2, than d/2.
        for (std::size_t k = 1; k < section.size(); ++k) {
          const Vec2 a(section[k - 1].offset, section[k - 1].dz), b(section[k].offset, section[k].dz);
          EXPECT_GE(distance_to_segment({0.5 * d, 0}, a, b), 0.5 * d * (1 - 1e-12)) << k;
        }
      }
    }
  }
}

TEST(Groove, VHoldsTheTendonOnThreeSides) {
  Body body = plain_mechanism().body;
  body.groove = Groove::v;
  const auto section = groove_section(body, 2.0, 4.0);
  const Vec2 corner(section[1].offset, section[1].dz), lip(section[2].offset, section[2].dz);
  EXPECT_NEAR(distance_to_segment({1.0, 0.0}, corner, lip), 1.0, 1e-12);
}

TEST(Groove, ShallowSeatEndsAtTheLip) {
  Body body = plain_mechanism().body;
  body.groove_angle = 0;
  body.seat_ratio = 2;
  const auto section = groove_section(body, 1.0, 0.5);
  EXPECT_DOUBLE_EQ(section.back().offset, 0.5);
  for (std::size_t k = 2; k < section.size(); ++k) EXPECT_GT(section[k].offset, section[k - 1].offset);
}

TEST(Bore, EveryShapePassesItsShaft) {
  Mechanism mechanism = plain_mechanism();
  for (const Bore kind : {Bore::round, Bore::d, Bore::hex, Bore::square, Bore::keyway}) {
    mechanism.body.bore = kind;
    for (const double diameter : {2.0, 6.0, 25.0}) {
      const BoreLayout bore = bore_layout(mechanism, diameter);
      EXPECT_GT(signed_area(bore.outline), 0);
      const double least = kind == Bore::d ? 0.4 * diameter + 0.1 - 0.011 : 0.5 * diameter + 0.1 - 0.011;
      EXPECT_GE(inradius(bore.outline), (kind == Bore::keyway ? -1e9 : least))
          << static_cast<int>(kind) << " " << diameter;
      EXPECT_GE(bore.radius, 0.5 * diameter + 0.1 - 1e-9);
    }
  }
}

TEST(Bore, KeywayOfDin6885) {
  Mechanism mechanism = plain_mechanism();
  mechanism.body.bore = Bore::keyway;
  mechanism.material.hole_compensation = 0;
  // 20 mm shaft: key 6 mm wide, 2.8 mm into the hub.
  const BoreLayout bore = bore_layout(mechanism, 20);
  const Vec2& corner = bore.outline[bore.outline.size() - 2];
  EXPECT_NEAR(corner.x(), 3.0, 1e-12);
  EXPECT_NEAR(corner.y(), 12.8, 1e-12);
}

TEST(Bore, ScrewHolesOfAHornAreCutWithItsRecess) {
  Mechanism mechanism = plain_mechanism();
  mechanism.body.bore = Bore::horn;
  mechanism.body.horn = "disc-25T-M3";
  const SynthesisResult shape = pulley_of(circle(20), circle(20), 180);
  BodyLayout layout = layout_of(mechanism);
  const RingStack stack = scaled_to_float(body_stack(shape.p1, shape.p2, 1.0, Flange::follow, layout), 1.0);
  EXPECT_EQ(failed(check_mesh(mesh_of(stack))), "");
  EXPECT_NEAR(enclosed_volume(mesh_of(stack)), volume_of(stack), 1e-11 * volume_of(stack));
}

}  // namespace
}  // namespace fusee
