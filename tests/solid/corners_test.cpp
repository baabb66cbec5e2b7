// Corners of known outlines are found despite additional points.
#include "solid/corners.h"

#include <gmock/gmock.h>

#include <cmath>

#include "fusee/base.h"

namespace fusee::solid {
namespace {

using ::testing::ElementsAreArray;

Polygon regular(int n, double radius) {
  Polygon points;
  for (int k = 0; k < n; ++k) points.push_back(radius * unit(k_two_pi * k / n));
  return points;
}

// Expects a point within `within` mm of each corner. Of two points split from one, either may remain.
void expect_near(const Polygon& found, const Polygon& expected, double within) {
  ASSERT_EQ(found.size(), expected.size());
  for (const Vec2& corner : expected) {
    const bool is_there =
        std::any_of(found.begin(), found.end(), [&](const Vec2& point) { return (point - corner).norm() <= within; });
    EXPECT_TRUE(is_there) << corner.x() << " " << corner.y();
  }
}

TEST(Corners, KeepsAllTrueCorners) {
  for (const int n : {3, 4, 8, 200}) EXPECT_THAT(corners_of(regular(n, 5)), ElementsAreArray(regular(n, 5)));
}

TEST(Corners, RemovesPointsOnStraightLines) {
  for (const int n : {3, 6, 24}) {
    const Polygon corners = regular(n, 5);
    Polygon points;
    for (int k = 0; k < n; ++k) {
      const Vec2 &a = corners[k], &b = corners[(k + 1) % n];
      for (const double share : {0.0, 1e-6, 0.3, 0.31, 0.9999}) points.push_back(a + share * (b - a));
    }
    // The last point before a corner, 1e-4 of a side or at most 0.00087 mm away, may remain in the corner's place.
    expect_near(corners_of(points), corners, 1e-4 * 10);
  }
}

// One of two, three or many points at the same place, or closer than a corner must project (1e-4 mm), remains.
TEST(Corners, MergesNearlyEqualPoints) {
  const Polygon corners = regular(8, 5);
  for (const double distance : {0.0, 1e-12, 5e-7, 5e-5}) {
    for (const int times : {2, 3, 7}) {
      Polygon points;
      for (const Vec2& corner : corners) {
        for (int k = 0; k < times; ++k) points.push_back(corner + distance / times * unit(2.4 * k));
      }
      SCOPED_TRACE(std::to_string(distance) + " mm, " + std::to_string(times) + " times");
      expect_near(corners_of(points), corners, distance + 1e-12);
    }
  }
}

TEST(Corners, KeepsThreePointsOfDegenerateOutline) {
  EXPECT_EQ(corners_of(Polygon(9, Vec2(1, 2))).size(), 3u);
  EXPECT_EQ(corners_of({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}}).size(), 3u);
  EXPECT_TRUE(corners_of({}).empty());
}

}  // namespace
}  // namespace fusee::solid
