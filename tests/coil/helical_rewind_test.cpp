// Strings wound on helical grooves in meshes, against closed forms.
#include "fusee/coil/helical_rewind.h"

#include <gmock/gmock.h>

#include <cmath>

#include "coil/spirals.h"
#include "fusee/base/diagnostics.h"
#include "support/mechanisms.h"
#include "support/shapes.h"

namespace fusee {
namespace {

/// Of a place from the floor that is meant.
double away_from(const Spiral& spiral, const SpiralPlace& place, const Vec3& point) {
  const auto floor = [&](const SpiralRow& row) {
    return Vec3(row.x - 0.5 * std::cos(row.turn), row.y - 0.5 * std::sin(row.turn), place.height(row.z));
  };
  double least = 1e9;
  for (std::size_t k = 0; k + 1 < spiral.rows.size(); ++k) {
    const Vec3 a = floor(spiral.rows[k]), b = floor(spiral.rows[k + 1]);
    const double share = std::clamp((point - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    least = std::min(least, (point - a - share * (b - a)).norm());
  }
  return least;
}

TEST(HelicalFloors, AreTheSpirals) {
  DeclaredMechanism mechanism = testing::forearm();
  mechanism.body = testing::plain_mechanism().body;
  mechanism.print = testing::plain_mechanism().print;
  const double lead = least_lead(helical_section(mechanism), 2.4) + 0.3, slope = lead / (k_two_pi * 12.0);
  const Spiral p1 = testing::spiral_of(testing::growing(12, 2.4, 0.3), 0.3, 5, slope);
  const Spiral p2 = testing::spiral_of(testing::growing(24, -2.4, 1.1), 1.1, 5, slope);
  const HelicalPulley pulley = make_helical_pulley(mechanism, p1, p2);
  ASSERT_TRUE(pulley.made) << pulley.brief();
  const auto floors = helical_floors(pulley.mesh, pulley.layout.scale);
  ASSERT_EQ(floors.size(), 2u);
  for (const auto& [floor, spiral, place] : {std::tuple{&floors[0], &p1, &pulley.p1}, std::tuple{&floors[1], &p2, &pulley.p2}}) {
    EXPECT_NEAR(static_cast<double>(floor->size()), 5 * 720.0 - 16.0, 4.0);  // 4° less at both ends
    double furthest = 0;
    for (const Vec3& point : *floor) furthest = std::max(furthest, away_from(*spiral, *place, point));
    EXPECT_LT(furthest, 0.012);
  }
}

}  // namespace
}  // namespace fusee
