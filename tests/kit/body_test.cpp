// Stacks of convex shapes, whose volumes follow from their outlines.
#include <gmock/gmock.h>

#include <cmath>

#include "fusee/base.h"
#include "fusee/kit.h"
#include "solid/print.h"

namespace {

using namespace fusee;

/// Area of a regular polygon with its corners on the circle.
double area_of_circle(int corners, double radius) {
  return 0.5 * corners * radius * radius * std::sin(k_two_pi / corners);
}

void expect_solid(const kit::SlabBody& body) {
  const solid::TriangleMesh mesh = kit::mesh_of(body);
  for (const Check& check : solid::check_mesh(mesh)) EXPECT_TRUE(check.ok) << check.name << " " << check.where;
  EXPECT_NEAR(solid::enclosed_volume(mesh) / kit::volume_of(body), 1, 1e-5);
}

TEST(KitBody, TubeMatchesPolygonVolume) {
  const kit::SlabBody tube{{{0, 7, {{kit::disc({3, -2}, 5)}, {kit::disc({3, -2}, 2), true}}}}};
  expect_solid(tube);
  EXPECT_NEAR(kit::volume_of(tube), 7 * (area_of_circle(72, 5) - area_of_circle(32, 2)), 1e-9);
}

TEST(KitBody, ConeIsAFrustum) {
  kit::SlabLoop loop{kit::disc({0, 0}, 5)};
  loop.grow_high = -2;
  const kit::SlabBody cone{{{0, 4, {loop}}}};
  expect_solid(cone);
  // Height 4, radii 5 and 3: V = h A₁ (R² + R r + r²)/3, with the area A₁ of the polygon of radius 1.
  const double unit_area = area_of_circle(72, 1);
  EXPECT_NEAR(kit::volume_of(cone), 4 * unit_area * (25 + 15 + 9) / 3, 1e-9);
}

TEST(KitBody, ContinuedLoopsHaveNoSeam) {
  const kit::SlabLoop rim{kit::box({0, 0}, {20, 10}, 1)}, through{kit::disc({5, 5}, 2), true},
      blind{kit::disc({14, 5}, 2), true};
  expect_solid({{{0, 2, {rim, through}}, {2, 5, {rim, through, blind}}, {5, 6, {{kit::disc({14, 5}, 4)}, blind}}}});
}

// A slab that is wider than the one below has a downward face over nothing. The same slabs upside down have none.
TEST(KitBody, PrintCheckFindsOverhangs) {
  const kit::SlabBody mushroom{{{0, 3, {{kit::disc({0, 0}, 2)}}}, {3, 5, {{kit::disc({0, 0}, 6)}}}}};
  expect_solid(mushroom);
  EXPECT_FALSE(all_ok(solid::check_print(kit::mesh_of(mushroom))));
  const kit::SlabBody stood{{{0, 2, {{kit::disc({0, 0}, 6)}}}, {2, 5, {{kit::disc({0, 0}, 2)}}}}};
  EXPECT_TRUE(all_ok(solid::check_print(kit::mesh_of(stood))));
}

TEST(KitBody, TrimmedHolesAdmitTheCircle) {
  const kit::SlabBody plate{{{0, 4, {{kit::box({-10, -10}, {10, 10}, 1)}, {kit::disc({0, 0}, 3), true}}}}};
  const kit::SlabBody made = kit::trimmed(plate, {.scale = 1, .hole = 0.2, .elephant_foot = 0.4});
  expect_solid(made);
  const kit::SlabLoop& hole = made.slabs.back().loops[1];
  EXPECT_NEAR(distance_to_edges(kit::outline_of(hole.hull, hole.grow_low), {0, 0}), 3.0 + 0.5 * 0.2, 1e-9);
  ASSERT_EQ(made.slabs.size(), 2u);
  EXPECT_NEAR(made.slabs[0].high, 0.4, 1e-12);
  EXPECT_NEAR(made.slabs[0].loops[0].grow_low, -0.4, 1e-12);
}

// In a random design two strokes of a digit were merged by the holes' compensation.
TEST(KitBody, EngravedLinesStayApart) {
  const kit::SlabBody plate{{{0,
                              4,
                              {{kit::box({-10, -10}, {10, 10}, 1)},
                               {kit::slot({-2, 0}, {-0.46, 0}, 0.3), true},
                               {kit::slot({0.46, 0}, {2, 0}, 0.3), true}}}}};
  expect_solid(kit::trimmed(plate, {.scale = 1, .hole = 0.5, .elephant_foot = 0}));
}

TEST(KitBody, ThinWallGetsSmallChamfer) {
  const kit::SlabBody tube{{{0, 4, {{kit::disc({0, 0}, 2)}, {kit::disc({0, 0}, 1.6), true}}}}};
  expect_solid(kit::trimmed(tube, {.scale = 1, .hole = 0.2, .elephant_foot = 0.8}));
}

}  // namespace
