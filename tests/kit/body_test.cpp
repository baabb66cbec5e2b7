// Stacks of convex shapes, whose volumes follow from their outlines.
#include "fusee/kit.h"

#include <gmock/gmock.h>

#include <cmath>

#include "fusee/base.h"
#include "solid/print.h"

namespace {

using namespace fusee;

/// Area of a regular polygon with its corners on the circle.
double area_of_circle(int corners, double radius) {
  return 0.5 * corners * radius * radius * std::sin(k_two_pi / corners);
}

void expect_solid(const SlabBody& body) {
  const TriangleMesh mesh = mesh_of(body);
  for (const Check& check : check_mesh(mesh)) EXPECT_TRUE(check.ok) << check.name << " " << check.where;
  EXPECT_NEAR(enclosed_volume(mesh) / volume_of(body), 1, 1e-5);
}

TEST(KitBody, TubeMatchesPolygonVolume) {
  const SlabBody tube{{{0, 7, {{disc({3, -2}, 5)}, {disc({3, -2}, 2), true}}}}};
  expect_solid(tube);
  EXPECT_NEAR(volume_of(tube), 7 * (area_of_circle(72, 5) - area_of_circle(32, 2)), 1e-9);
}

TEST(KitBody, ConeIsAFrustum) {
  SlabLoop loop{disc({0, 0}, 5)};
  loop.grow_high = -2;
  const SlabBody cone{{{0, 4, {loop}}}};
  expect_solid(cone);
  const double unit_area = area_of_circle(72, 1);
  EXPECT_NEAR(volume_of(cone), 4 * unit_area * (25 + 15 + 9) / 3, 1e-9);
}

TEST(KitBody, ContinuedLoopsHaveNoSeam) {
  const SlabLoop rim{box({0, 0}, {20, 10}, 1)}, through{disc({5, 5}, 2), true}, blind{disc({14, 5}, 2), true};
  expect_solid({{{0, 2, {rim, through}}, {2, 5, {rim, through, blind}}, {5, 6, {{disc({14, 5}, 4)}, blind}}}});
}

// If beginning faces looked up, the part would have material in mid-air.
TEST(KitBody, PrintCheckFindsOverhangs) {
  const SlabBody mushroom{{{0, 3, {{disc({0, 0}, 2)}}}, {3, 5, {{disc({0, 0}, 6)}}}}};
  expect_solid(mushroom);
  EXPECT_FALSE(all_ok(check_print(mesh_of(mushroom))));
  const SlabBody stood{{{0, 2, {{disc({0, 0}, 6)}}}, {2, 5, {{disc({0, 0}, 2)}}}}};
  EXPECT_TRUE(all_ok(check_print(mesh_of(stood))));
}

TEST(KitBody, TrimmedHolesAdmitTheCircle) {
  const SlabBody plate{{{0, 4, {{box({-10, -10}, {10, 10}, 1)}, {disc({0, 0}, 3), true}}}}};
  const SlabBody made = trimmed(plate, {1, 0.2, 0.4});
  expect_solid(made);
  const SlabLoop& hole = made.slabs.back().loops[1];
  EXPECT_NEAR(distance_to_edges(outline_of(hole.hull, hole.grow_low), {0, 0}), 3.1, 1e-9);
  ASSERT_EQ(made.slabs.size(), 2u);
  EXPECT_NEAR(made.slabs[0].high, 0.4, 1e-12);
  EXPECT_NEAR(made.slabs[0].loops[0].grow_low, -0.4, 1e-12);
}

// In a random design two strokes of a digit were merged by the holes' compensation.
TEST(KitBody, EngravedLinesStayApart) {
  const SlabBody plate{{{0,
                         4,
                         {{box({-10, -10}, {10, 10}, 1)},
                          {slot({-2, 0}, {-0.46, 0}, 0.3), true},
                          {slot({0.46, 0}, {2, 0}, 0.3), true}}}}};
  expect_solid(trimmed(plate, {1, 0.5, 0}));
}

TEST(KitBody, ThinWallGetsSmallChamfer) {
  const SlabBody tube{{{0, 4, {{disc({0, 0}, 2)}, {disc({0, 0}, 1.6), true}}}}};
  expect_solid(trimmed(tube, {1, 0.2, 0.8}));
}

}  // namespace
