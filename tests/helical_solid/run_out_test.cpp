// Channels from a groove's end to the knot. Their ceilings become downward faces of the part.
#include "helical_solid/run_out.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "fusee/base.h"
#include "solid/self_intersection.h"

namespace fusee::helical_solid {
namespace {

// Radius of the pitch curve, and distance of the groove's end from the face. mm
constexpr double k_radius = 12.0, k_from_face = 9.0;

GrooveEnd end_on(transmission::Side side) {
  GrooveEnd end;
  end.side = side;
  end.row = {{k_radius, 0}, {1, 0}, 0, k_radius, 20};  // position, normal, turn, radius of curvature, height
  end.along = side == transmission::Side::left ? 1 : -1;
  end.outward = side == transmission::Side::left ? -1 : 1;
  end.face = end.row.height + end.outward * k_from_face;
  return end;
}

struct Sizes {
  double radius;       ///< of the channel, mm
  double bend_ratio;   ///< radius of the arc, in channel radii
  double entry;        ///< radius at the entry, mm
  double growth;       ///< of the radius, per length along the arc
  double peak = 57.5;  ///< slope of the ceiling, deg
};

/// Sizes with pocket cones of 47.5°, for an overhang of 45° and a margin of 2.5°. A tip ends at a fifth of the channel's
/// radius.
RunOutSizes sizes_of(const Sizes& wanted) {
  RunOutSizes sizes;
  sizes.channel_radius = wanted.radius;
  sizes.entry_radius = wanted.entry;
  sizes.pocket_radius = 1.4 * wanted.radius;
  sizes.pocket_depth = sizes.pocket_radius;
  sizes.cone = (sizes.pocket_radius - wanted.radius) * std::tan(radians(47.5));
  sizes.tip = 0.8 * wanted.radius * std::tan(radians(47.5));
  sizes.bend_radius = wanted.bend_ratio * wanted.radius;
  sizes.inward = std::max(sizes.bend_radius / std::sqrt(2.0), 3 * wanted.radius);
  sizes.ceiling_slope = radians(wanted.peak);
  for (int k = 1; k <= 9; ++k)
    sizes.channel_radii.push_back(
        std::min(wanted.radius, wanted.entry + wanted.growth * 0.5 * k_pi * k / 9 * sizes.bend_radius));
  return sizes;
}

/// Angle of the flattest ceiling of the channel inside the part.
double flattest_ceiling(const solid::TriangleMesh& tool, const GrooveEnd& end) {
  double flattest = 0.5 * k_pi;
  for (const auto& [ia, ib, ic] : tool.triangles) {
    const Vec3 &a = tool.vertices[ia], &b = tool.vertices[ib], &c = tool.vertices[ic];
    const Vec3 normal = (b - a).cross(c - a).normalized();
    const bool is_outside = end.outward > 0 && std::min({a.z(), b.z(), c.z()}) > end.face;
    if (normal.z() < 1e-6 || is_outside) continue;
    flattest = std::min(flattest, std::atan2(normal.head<2>().norm(), normal.z()));
  }
  return flattest;
}

// A ball with a cone on it sweeps the channel: its ceiling is as steep as the cone, 57.5°, except for the twist of
// facets: 47° leaves a margin of 2° to an overhang of 45°. A ceiling built across the channel was only 37° steep on the
// sharpest bends and needed supports.
TEST(RunOut, CeilingsKeepTheirSlope) {
  for (const transmission::Side side : {transmission::Side::left, transmission::Side::right}) {
    for (const Sizes& wanted :
         {Sizes{0.6, 2.8, 0.6, 0}, Sizes{1.0, 2.8, 0.3, 0.3}, Sizes{0.45, 4, 0.3, 0.2}, Sizes{0.8, 3.3, 0.4, 0.5}}) {
      const GrooveEnd end = end_on(side);
      for (int variant = 0; variant < 3; ++variant) {
        const auto tool = run_out_tool(end, sizes_of(wanted), variant);
        ASSERT_TRUE(tool) << wanted.radius;
        EXPECT_FALSE(solid::find_crossing(*tool).facets) << wanted.radius;
        EXPECT_GT(degrees(flattest_ceiling(*tool, end)), 47.0)
            << wanted.radius << (side == transmission::Side::left ? " P1" : " P2");
      }
    }
  }
}

// The sections of the sharpest bends do not intersect one another for any steepness of the ceiling.
TEST(RunOut, ChannelsDoNotSelfIntersect) {
  for (const transmission::Side side : {transmission::Side::left, transmission::Side::right}) {
    for (const double peak : {57.5, 60.0, 65.0, 72.0, 80.0}) {
      for (const Sizes& wanted : {Sizes{0.6, 2.8, 0.6, 0, peak}, Sizes{1.0, 2.8, 0.3, 0.3, peak}}) {
        const auto tool = run_out_tool(end_on(side), sizes_of(wanted), 0);
        ASSERT_TRUE(tool) << peak;
        EXPECT_FALSE(solid::find_crossing(*tool).facets) << peak;
      }
    }
  }
}

// The end of a channel that rises into a wider pocket has no face as flat as the channel itself, 45°.
TEST(RunOut, RisingChannelEndsInAPoint) {
  const GrooveEnd end = end_on(transmission::Side::right);
  const ChannelRing last = channel_rings(end, sizes_of({1.0, 2.8, 0.6, 0}), 0).back();
  EXPECT_LT(last.radius, 0.06);
  EXPECT_LT(last.ridge.z(), end.face);
}

// The cone over a pocket ends in a tip. A flat disc as wide as the channel would be an overhang.
TEST(RunOut, PocketOpeningBelowHasNoCeiling) {
  const RunOutSizes sizes = sizes_of({0.6, 3, 0.5, 0.1});
  const std::vector<Vec2> below = pocket_profile(end_on(transmission::Side::left), sizes),
                          above = pocket_profile(end_on(transmission::Side::right), sizes);
  EXPECT_LT(below.back().x(), 0.25 * sizes.channel_radius);
  for (std::size_t k = 1; k < below.size(); ++k) {
    const Vec2 step = below[k] - below[k - 1];
    EXPECT_NEAR(degrees(std::atan2(step.y(), -step.x())), 47.5, 1e-6);
  }
  EXPECT_EQ(above.back().x(), sizes.channel_radius);
}

}  // namespace
}  // namespace fusee::helical_solid
