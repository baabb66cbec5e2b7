// The cone between a horn's recess and its centre screw's hole, on polygons with known corners.
#include "solid/bore.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fusee/base.h"
#include "mechanism/catalogue.h"
#include "support/shapes.h"

namespace fusee::solid {
namespace {

using testing::plain_mechanism;

double angle_between(const Vec2& a, const Vec2& b) { return std::abs(std::atan2(cross(a, b), a.dot(b))); }

bool has(const Polygon& polygon, const Vec2& corner) {
  return std::any_of(polygon.begin(), polygon.end(),
                     [&](const Vec2& point) { return (point - corner).norm() < 1e-12; });
}

BoreLayout recess(const Polygon& outline, const Polygon& hole) {
  BoreLayout bore;
  bore.outline = outline;
  bore.screw_holes = {hole};
  bore.horn_recess = 2;
  return bore;
}

// Checks that the cone joins the whole outline to the whole hole.
void expect_cone(const BoreLayout& bore) {
  const RecessCone cone = recess_cone(bore);
  const Polygon& hole = bore.screw_holes.front();
  ASSERT_EQ(cone.rim.size(), cone.hole.size());
  double furthest = 0;
  for (std::size_t i = 0; i < cone.rim.size(); ++i) {
    // Two corners within 0.01 rad of one ray count as one.
    EXPECT_LT(angle_between(cone.rim[i], cone.hole[i]), 0.0101);
    EXPECT_GT(cross(cone.rim[i], cone.rim[(i + 1) % cone.rim.size()]), 0) << "corners not counter-clockwise";
    EXPECT_LT(distance_to_edges(bore.outline, cone.rim[i]), 1e-12);
    EXPECT_LT(distance_to_edges(hole, cone.hole[i]), 1e-12);
    furthest = std::max(furthest, (cone.rim[i] - cone.hole[i]).norm());
  }
  for (const Vec2& corner : bore.outline) EXPECT_TRUE(has(cone.rim, corner));
  for (const Vec2& corner : hole) EXPECT_TRUE(has(cone.hole, corner)) << "cut off: a ledge is left";
  EXPECT_NEAR(signed_area(cone.rim), signed_area(bore.outline), 1e-9);
  EXPECT_NEAR(signed_area(cone.hole), signed_area(hole), 1e-9);
  EXPECT_DOUBLE_EQ(cone.travel, furthest);
}

// Inscribed in a circle, with the first corner at `turn`.
Polygon regular(int n, double radius, double turn) {
  Polygon points;
  for (int k = 0; k < n; ++k) points.push_back(radius * unit(turn + k_two_pi * k / n));
  return points;
}

TEST(RecessCone, SimilarPolygonsKeepTheirCorners) {
  const BoreLayout bore = recess(regular(12, 4, 0.2), regular(12, 1.6, 0.2));
  const RecessCone cone = recess_cone(bore);
  EXPECT_EQ(cone.rim.size(), 12u);
  EXPECT_NEAR(cone.travel, 2.4, 1e-12);
  expect_cone(bore);
}

TEST(RecessCone, ContainsCornersOfBothPolygons) {
  for (const int outer : {4, 7, 16}) {
    for (const int inner : {3, 8, 10}) {
      for (const double turn : {0.0, 0.05, 0.4, 3.0}) {
        SCOPED_TRACE(std::to_string(outer) + " and " + std::to_string(inner) + " corners, turned by " +
                     std::to_string(turn));
        expect_cone(recess(regular(outer, 5, 0.3), regular(inner, 1.5, turn)));
      }
    }
  }
}

TEST(RecessCone, MergesCornersOnNearlyEqualRays) {
  for (const double turn : {1e-9, 1e-4, 0.009}) {
    const BoreLayout bore = recess(regular(8, 5, 0.1), regular(8, 1.5, 0.1 + turn));
    EXPECT_EQ(recess_cone(bore).rim.size(), 8u) << turn;
    expect_cone(bore);
  }
  EXPECT_EQ(recess_cone(recess(regular(8, 5, 0.1), regular(8, 1.5, 0.12))).rim.size(), 16u);
}

TEST(RecessCone, EndsInTheHoleForEveryCatalogueHorn) {
  int recesses = 0;
  Mechanism mechanism = plain_mechanism();
  mechanism.body.bore = Bore::horn;
  for (const HornType& horn : horns()) {
    mechanism.body.horn = horn.name;
    const BoreLayout bore = bore_layout(mechanism, 0.0);
    if (bore.horn_recess <= 0) continue;
    ++recesses;
    SCOPED_TRACE(horn.name);
    expect_cone(bore);
  }
  EXPECT_GE(recesses, 5);
}

}  // namespace
}  // namespace fusee::solid
