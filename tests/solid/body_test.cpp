// The body as rings, compared with closed formulas of the discretised part.
#include "solid/body.h"

#include <gtest/gtest.h>

#include "solid/bore.h"
#include "solid/broken.h"
#include "solid/channel_entries.h"
#include "solid/groove.h"
#include "solid/heights.h"
#include "solid/plane_distance.h"
#include "support/shapes.h"

namespace fusee::solid {
namespace {

using testing::circle;
using testing::failed;
using testing::plain_mechanism;
using testing::pulley_of;
using testing::SupportShape;

// Volume of a frustum between regular n-gons of radii a and b, or of a prism for a == b.
double frustum(int n, double a, double b, double height) {
  return 0.5 * n * std::sin(k_two_pi / n) * height * (a * a + a * b + b * b) / 3.0;
}

FlangeRims rims_of(const Mechanism& mechanism, const profile::SynthesisResult& shape) {
  return flange_rims(shape.p1, shape.p2, mechanism.tendon.diameter, mechanism.groove_depth(), mechanism.body.flange);
}

BodyLayout layout_of(const Mechanism& mechanism, const profile::SynthesisResult& shape, Parts parts,
                     double hub_radius = 0) {
  BodyLayout layout = axial_layout(mechanism, rims_of(mechanism, shape), parts, k_steep_lean);
  layout.bore = bore_layout(mechanism, 5);
  add_recess_ceiling(layout);
  layout.hub_radius = hub_radius;
  if (hub_radius > 0) layout.z_hub = layout.z_top + 8;
  return layout;
}

// Volume of one half of a groove about a regular n-gon of this radius.
double half_groove(int n, double radius, const std::vector<GroovePoint>& wall) {
  double volume = frustum(n, radius, radius, wall[1].dz);
  for (std::size_t k = 2; k < wall.size(); ++k) {
    volume += frustum(n, radius + wall[k - 1].offset, radius + wall[k].offset, wall[k].dz - wall[k - 1].dz);
  }
  return volume;
}

double groove(int n, double radius, const GrooveWalls& walls) {
  return half_groove(n, radius, walls.below) + half_groove(n, radius, walls.above);
}

void expect_volume(const RingStack& stack, double expected) {
  EXPECT_NEAR(volume_of(stack), expected, 1e-9 * expected);
  EXPECT_NEAR(enclosed_volume(mesh_of(stack)), expected, 1e-9 * expected);
}

TEST(Body, RoundPulleyMatchesFrustumVolumes) {
  const int n = 240;
  const Mechanism mechanism = plain_mechanism();
  const profile::SynthesisResult shape = pulley_of(circle(20), circle(20), n);
  const BodyLayout layout = layout_of(mechanism, shape, Parts::one, 8);
  const RingStack stack = body_stack(shape.p1, shape.p2, 1.0, Flange::follow, layout);
  // plain_mechanism() has ceilings at 45° and a margin of 2.5°, flanges of 1.2 mm, an elephant foot of 0.4 mm.
  const double slope = std::tan(radians(47.5)), flange = 1.2, foot = 0.4, foot_rise = foot * slope;
  const double groove_edge = 19.5 + layout.groove_depth;
  // The rim around both circles: the smooth maximum of their support functions plus a margin.
  const double middle = groove_edge + 0.5 * std::log(2.0) + 0.2;
  // Facets are steepest at their corners. Across their middle they have exactly the requested slope.
  EXPECT_NEAR(layout.middle_cone, (middle - groove_edge) * std::cos(k_pi / n) * slope, 1e-9);
  const double middle_rim = layout.z_p2 - layout.p2.below_width() - layout.z_middle;
  const double upper_rim = layout.z_top - layout.z_p2 - layout.p2.above_width();
  EXPECT_GE(middle_rim, flange - 1e-9);
  EXPECT_GE(upper_rim, flange - 1e-9);
  const double bore = signed_area(layout.bore.outline) * layout.z_hub;
  const double expected = frustum(n, groove_edge - foot, groove_edge, foot_rise) +
                          frustum(n, groove_edge, groove_edge, flange - foot_rise) + groove(n, 19.5, layout.p1) +
                          frustum(n, groove_edge, middle, layout.middle_cone) + frustum(n, middle, middle, middle_rim) +
                          groove(n, 19.5, layout.p2) + frustum(n, groove_edge, groove_edge, upper_rim) +
                          signed_area(stack.hub->outline) * 8 - bore;
  EXPECT_NEAR(signed_area(stack.hub->outline), k_pi * 64, 0.01 * k_two_pi * 8);
  expect_volume(stack, expected);
}

// P1 is chamfered at its print bed, which is its top in the assembly. Each cone is above a groove in print orientation.
TEST(Body, TwoPartPulleyMatchesFrustumVolumes) {
  const int n = 240;
  Mechanism mechanism = plain_mechanism();
  mechanism.body.flange = Flange::round;
  const profile::SynthesisResult shape = pulley_of(circle(20), circle(18), n);
  const BodyLayout layout = layout_of(mechanism, shape, Parts::two);
  const double foot = 0.4, foot_rise = foot * std::tan(radians(47.5));
  const double groove_edge1 = 19.5 + layout.groove_depth, groove_edge2 = 17.5 + layout.groove_depth;
  const double rim1 = groove_edge1 + 0.2, rim2 = groove_edge2 + 0.2, middle = groove_edge1 + 0.2;
  const double bore = signed_area(layout.bore.outline);
  const double lower = layout.z_p1 - layout.p1.below_width() - layout.lower_cone;
  EXPECT_EQ(layout.middle_cone, 0);
  expect_volume(body_stack(shape.p1, shape.p2, 1.0, Flange::round, layout, Piece::p1),
                frustum(n, rim1, rim1, lower) + frustum(n, rim1, groove_edge1, layout.lower_cone) +
                    groove(n, 19.5, layout.p1) +
                    frustum(n, middle, middle, layout.z_mate - foot_rise - layout.z_middle) +
                    frustum(n, middle, middle - foot, foot_rise) - bore * layout.z_mate);
  const double under = layout.z_p2 - layout.p2.below_width() - layout.z_mate - foot_rise;
  const double above = layout.z_top - layout.z_p2 - layout.p2.above_width() - layout.upper_cone;
  expect_volume(body_stack(shape.p1, shape.p2, 1.0, Flange::round, layout, Piece::p2),
                frustum(n, rim2 - foot, rim2, foot_rise) + frustum(n, rim2, rim2, under) + groove(n, 17.5, layout.p2) +
                    frustum(n, groove_edge2, rim2, layout.upper_cone) + frustum(n, rim2, rim2, above) -
                    bore * (layout.z_hub - layout.z_mate));
}

TEST(Body, IsSolidForAnyConvexPair) {
  const std::vector<SupportShape> shapes{
      circle(20), circle(15, {6, -3}), {18, {{2, 2.5, 1}, {3, 0.4, -0.6}}}, {25, {{1, -8, 2}, {2, 0, 3}}}};
  for (const Flange flange : {Flange::follow, Flange::round}) {
    for (const SupportShape& p1 : shapes) {
      for (const SupportShape& p2 : shapes) {
        Mechanism mechanism = plain_mechanism();
        mechanism.body.flange = flange;
        const profile::SynthesisResult shape = pulley_of(p1, p2, 180);
        for (const auto& [parts, piece] : {std::pair{Parts::one, Piece::whole}, std::pair{Parts::two, Piece::whole},
                                           std::pair{Parts::two, Piece::p1}, std::pair{Parts::two, Piece::p2}}) {
          const BodyLayout layout = layout_of(mechanism, shape, parts, 7);
          const RingStack stack = scaled_to_float(body_stack(shape.p1, shape.p2, 1.0, flange, layout, piece), 1.003);
          const TriangleMesh mesh = mesh_of(stack);
          EXPECT_EQ(failed(check_mesh(mesh)), "") << static_cast<int>(piece);
          EXPECT_NEAR(enclosed_volume(mesh), volume_of(stack), 1e-11 * volume_of(stack));
        }
      }
    }
  }
}

TEST(Body, MiddleFlangeContainsBothGrooveEdges) {
  const profile::SynthesisResult shape = pulley_of(circle(20, {4, 0}), circle(20, {-4, 0}), 180);
  const FlangeRims rims = flange_rims(shape.p1, shape.p2, 1.0, 2.0, Flange::follow);
  for (const Polygon* groove_edge : {&rims.groove_edge1, &rims.groove_edge2}) {
    for (const Vec2& point : *groove_edge) EXPECT_GT(depth_inside(rims.middle, point), 0.15);
  }
  // Along +x the larger groove edge ends at 4 + 20 + 1.5 mm. The blend and the margin of 0.2 mm add no more.
  EXPECT_NEAR(rims.middle.front().x(), 25.5 + 0.2, 0.01);
}

TEST(Groove, SeatsTendonHalfADiameterAboveFloor) {
  for (const Groove kind : {Groove::u, Groove::v, Groove::flat}) {
    for (const double angle : {0.0, 30.0, 50.0, 90.0}) {
      Body body = plain_mechanism().body;
      body.groove = kind;
      for (const double d : {0.3, 1.0, 4.0}) {
        const auto section = groove_half(body, radians(0.5 * angle), d, 2.0 * d);
        EXPECT_EQ(section[0].offset, 0.0);
        EXPECT_EQ(section[1].offset, 0.0);
        EXPECT_GT(section[1].dz, 0.0);
        EXPECT_DOUBLE_EQ(section.back().offset, 2.0 * d);
        // No wall is closer than d/2 to the centre line at offset d/2.
        for (std::size_t k = 1; k < section.size(); ++k) {
          const Vec2 a(section[k - 1].offset, section[k - 1].dz), b(section[k].offset, section[k].dz);
          EXPECT_GE(distance_to_segment({0.5 * d, 0}, a, b), 0.5 * d * (1 - 1e-12)) << k;
        }
      }
    }
  }
}

TEST(Groove, VGrooveTouchesTendonOnThreeSides) {
  Body body = plain_mechanism().body;
  body.groove = Groove::v;
  const auto section = groove_half(body, radians(25), 2.0, 4.0);
  const Vec2 corner(section[1].offset, section[1].dz), groove_edge(section[2].offset, section[2].dz);
  EXPECT_NEAR(distance_to_segment({1.0, 0.0}, corner, groove_edge), 1.0, 1e-12);
}

TEST(Groove, ShallowSeatEndsAtGrooveEdge) {
  Body body = plain_mechanism().body;
  body.seat_ratio = 2;
  const auto section = groove_half(body, 0.0, 1.0, 0.5);
  EXPECT_DOUBLE_EQ(section.back().offset, 0.5);
  for (std::size_t k = 2; k < section.size(); ++k) EXPECT_GT(section[k].offset, section[k - 1].offset);
}

// The tendon is a circle, lifted by the depth and moved aside in steps until it touches the wall's line.
TEST(Groove, PlayAtGrooveEdgeMatchesTouchingTendon) {
  for (const Groove kind : {Groove::u, Groove::v, Groove::flat}) {
    for (const double angle : {0.0, 30.0, 50.0, 90.0}) {
      Body body = plain_mechanism().body;
      body.groove = kind;
      const double d = 0.8, depth = 2.0 * d;
      const auto section = groove_half(body, radians(0.5 * angle), d, depth);
      const GroovePoint &low = section[section.size() - 2], &groove_edge = section.back();
      const Vec2 along = Vec2(groove_edge.offset - low.offset, groove_edge.dz - low.dz).normalized();
      // Distance between the wall's line and the tendon's circle, whose centre is moved aside from the middle.
      const auto gap = [&](double aside) {
        const Vec2 from_edge = Vec2(depth + 0.5 * d, aside) - Vec2(groove_edge.offset, groove_edge.dz);
        return along.x() * -from_edge.y() + along.y() * from_edge.x() - 0.5 * d;
      };
      double touches = 0;
      while (gap(touches) > 0) touches += 1e-5;
      EXPECT_NEAR(room_at_groove_edge(section, d), touches, 2e-5) << static_cast<int>(kind) << " " << angle;
      // In a V groove the play is the wall's lean over the depth.
      if (kind == Groove::v) {
        EXPECT_NEAR(room_at_groove_edge(section, d), depth * std::tan(radians(0.5 * angle)), 1e-12);
      }
    }
  }
}

TEST(Bore, EveryShapeAdmitsItsShaft) {
  Mechanism mechanism = plain_mechanism();
  for (const Bore kind : {Bore::round, Bore::d, Bore::hex, Bore::square, Bore::keyway}) {
    mechanism.body.bore = kind;
    for (const double diameter : {2.0, 6.0, 25.0}) {
      const BoreLayout bore = bore_layout(mechanism, diameter);
      EXPECT_GT(signed_area(bore.outline), 0);
      // Half of the shaft and of the compensation, minus the sagitta of the arc. The flat of a D is at 0.4 diameters.
      const double least = kind == Bore::d ? 0.4 * diameter + 0.1 - 0.011 : 0.5 * diameter + 0.1 - 0.011;
      // inradius() requires a convex outline, which a keyway has not.
      if (kind != Bore::keyway) {
        EXPECT_GE(inradius(bore.outline), least) << static_cast<int>(kind) << " " << diameter;
      }
      EXPECT_GE(bore.radius, 0.5 * diameter + 0.1 - 1e-9);
    }
  }
}

TEST(Bore, KeywayMatchesDin6885) {
  Mechanism mechanism = plain_mechanism();
  mechanism.body.bore = Bore::keyway;
  mechanism.material.hole_compensation = 0;
  // 20 mm shaft: key 6 mm wide, 2.8 mm into the hub.
  const BoreLayout bore = bore_layout(mechanism, 20);
  const Vec2& corner = bore.outline[bore.outline.size() - 2];
  EXPECT_NEAR(corner.x(), 3.0, 1e-12);
  EXPECT_NEAR(corner.y(), 12.8, 1e-12);
}

TEST(Bore, HornRecessWithScrewHolesIsSolid) {
  Mechanism mechanism = plain_mechanism();
  mechanism.body.bore = Bore::horn;
  mechanism.body.horn = "disc-25T-M3";
  const profile::SynthesisResult shape = pulley_of(circle(20), circle(20), 180);
  const BodyLayout layout = layout_of(mechanism, shape, Parts::one);
  const RingStack stack = scaled_to_float(body_stack(shape.p1, shape.p2, 1.0, Flange::follow, layout), 1.0);
  EXPECT_EQ(failed(check_mesh(mesh_of(stack))), "");
  EXPECT_NEAR(enclosed_volume(mesh_of(stack)), volume_of(stack), 1e-11 * volume_of(stack));
}

}  // namespace
}  // namespace fusee::solid
