// Formulas of the plane, compared with known values.
#include <gmock/gmock.h>

#include "fusee/base.h"

namespace fusee {
namespace {

const Polygon k_square{{-1, -1}, {3, -1}, {3, 3}, {-1, 3}};

TEST(Plane, RotationIsCounterClockwise) {
  EXPECT_EQ(turned({2, 1}, 0), Vec2(2, 1));
  EXPECT_LT((turned({2, 1}, 0.5 * k_pi) - turned_left({2, 1})).norm(), 1e-15);
  EXPECT_LT((turned(unit(0.3), 0.4) - unit(0.7)).norm(), 1e-15);
}

TEST(Plane, MeasuresDistanceToSegment) {
  EXPECT_DOUBLE_EQ(distance_to_segment({1, 2}, {0, 0}, {4, 0}), 2);  // beside it
  EXPECT_DOUBLE_EQ(distance_to_segment({7, 4}, {0, 0}, {4, 0}), 5);  // beyond an end
  EXPECT_DOUBLE_EQ(distance_to_segment({3, 4}, {0, 0}, {0, 0}), 5);  // degenerate segment
}

TEST(Plane, MeasuresDistanceToEdgesOnBothSides) {
  EXPECT_DOUBLE_EQ(distance_to_edges(k_square, {0, 0}), 1);
  EXPECT_DOUBLE_EQ(distance_to_edges(k_square, {-2, 0}), 1);
  EXPECT_DOUBLE_EQ(distance_to_edges(k_square, {6, 7}), 5);
  EXPECT_TRUE(std::isinf(distance_to_edges({}, {0, 0})));
}

TEST(Plane, CircumradiusReachesFurthestCorner) { EXPECT_DOUBLE_EQ(circumradius(k_square), std::hypot(3, 3)); }

}  // namespace
}  // namespace fusee
