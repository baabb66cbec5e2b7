// Layers as a slicer processes them, on parts with known layers, and the reaction to places that do not print.
#include "solid/layers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "fusee/base.h"
#include "solid/broken.h"
#include "solid/plan.h"
#include "solid/plane_distance.h"
#include "solid/support_attribution.h"
#include "support/shapes.h"

namespace fusee::solid {
namespace {

using testing::circle;
using testing::plain_mechanism;
using testing::pulley_of;

// Distance by which a layer of 0.2 mm may project over the one below at 45° and the margin of 1.3° (layers.cpp): 0.191
// mm.
const double k_reach = 0.2 / std::tan(radians(46.3));

// Convex loops with equal numbers of points, with their heights, from the bottom up.
TriangleMesh tower(const std::vector<std::pair<Polygon, double>>& loops) {
  TriangleMesh mesh;
  for (const auto& [loop, z] : loops) {
    for (const Vec2& at : loop) mesh.vertices.emplace_back(at.x(), at.y(), z);
  }
  const auto n = static_cast<std::uint32_t>(loops.front().first.size());
  const auto last = static_cast<std::uint32_t>(loops.size() - 1) * n;
  for (std::uint32_t i = 1; i + 1 < n; ++i) {
    mesh.triangles.push_back({0, i + 1, i});
    mesh.triangles.push_back({last, last + i, last + i + 1});
  }
  for (std::uint32_t first = 0; first < last; first += n) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = first + i, b = first + (i + 1) % n;
      mesh.triangles.push_back({a, b, b + n});
      mesh.triangles.push_back({a, b + n, a + n});
    }
  }
  return mesh;
}

// Regular loops of {inradius, z}.
TriangleMesh tower(const std::vector<std::pair<double, double>>& profile, int n) {
  std::vector<std::pair<Polygon, double>> loops;
  for (const auto& [inner, z] : profile) {
    loops.push_back({{}, z});
    for (int i = 0; i < n; ++i) loops.back().first.push_back(inner / std::cos(k_pi / n) * unit(k_two_pi * i / n));
  }
  return tower(loops);
}

// One side moves outwards by `by` a layer, between vertical walls that meet it at `angle` and at 90°.
TriangleMesh leaning_tip(double by, double angle) {
  const auto loop_at = [&](double out) {
    return Polygon{{-10 / std::tan(angle), 10}, {-10, 10}, {-10, -out}, {out / std::tan(angle), -out}};
  };
  return tower({{loop_at(0), 0}, {loop_at(0), 2}, {loop_at(20 * by), 6}});
}

// Grows by `by` a layer of 0.2 mm.
std::vector<std::pair<double, double>> growing(double by) { return {{5, 0}, {5, 2}, {5 + 20 * by, 6}}; }

std::size_t ledges(const TriangleMesh& mesh, Corners corners = Corners::round) {
  return ledges_in_layers(mesh, radians(45), corners).size();
}

// The definition evaluated at every point, without skipping any.
std::vector<Vec3> ledges_point_by_point(const TriangleMesh& mesh) {
  const double reach = 0.2 / std::tan(radians(45 + 1.3));  // as k_reach
  const auto distance_to = [](const std::vector<Polygon>& loops, const Vec2& point) {
    double least = 1e300;
    for (const Polygon& loop : loops) least = std::min(least, distance_to_edges(loop, point));
    return least;
  };
  const Bounds box = bounds(mesh);
  std::vector<Vec3> ledges;
  std::vector<Polygon> below = section(mesh, box.low.z() + 0.3);
  for (double z = box.low.z() + 0.5; z < box.high.z(); z += 0.2) {
    const std::vector<Polygon> here = section(mesh, z);
    for (const Polygon& loop : here) {
      double most = 0;
      Vec3 furthest;
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec2 &from = loop[i], &to = loop[(i + 1) % loop.size()];
        const int steps = static_cast<int>(std::ceil((to - from).norm() / 0.02));
        for (int k = 0; k < steps; ++k) {
          const Vec2 point = from + (to - from) * k / steps;
          const double out = distance_to(below, point);
          const auto holds = [&point](const Polygon& outline) { return is_inside(outline, point); };
          if (out <= reach || std::count_if(below.begin(), below.end(), holds) % 2 == 1 || out <= most) continue;
          most = out;
          furthest = {point.x(), point.y(), z};
        }
      }
      if (most > 0) ledges.push_back(furthest);
    }
    below = here;
  }
  return ledges;
}

TEST(Layers, SkipsOnlySupportedPlaces) {
  std::mt19937 draw(11);
  std::uniform_real_distribution<double> share(0, 1);
  std::size_t found = 0;
  for (int part = 0; part < 40; ++part) {
    const auto corners = static_cast<int>(3 + 30 * share(draw));
    std::vector<std::pair<Polygon, double>> loops;
    Vec2 middle = Vec2::Zero();
    double radius = 3 + 3 * share(draw), turn = 0, z = 0;
    for (int ring = 0; ring < 6; ++ring) {
      loops.push_back({{}, z});
      for (int i = 0; i < corners; ++i)
        loops.back().first.push_back(middle + radius * unit(turn + k_two_pi * i / corners));
      const double rise = 0.05 + 0.8 * share(draw);
      if (share(draw) < 0.6) radius = std::max(1.0, radius + rise * 2.5 * (share(draw) - 0.5));
      if (share(draw) < 0.4) middle += rise * share(draw) * unit(k_two_pi * share(draw));
      if (share(draw) < 0.3) turn += 0.2 * share(draw);
      z += rise;
    }
    const TriangleMesh mesh = tower(loops);
    const std::vector<Vec3> expected = ledges_point_by_point(mesh),
                            ledges = ledges_in_layers(mesh, radians(45), Corners::round);
    ASSERT_EQ(ledges.size(), expected.size()) << "part " << part;
    for (std::size_t i = 0; i < ledges.size(); ++i)
      EXPECT_LT((ledges[i] - expected[i]).norm(), 1e-9) << "part " << part;
    found += ledges.size();
  }
  EXPECT_GT(found, 20u);
}

// A wedge in mid-air beside a pillar: two steep flanks that meet in a ridge from `left` to `right`, below a flat top.
TriangleMesh pillar_and_wedge(const Vec3& left, const Vec3& right, double width) {
  TriangleMesh mesh = tower({{6, 0}, {6, 9}}, 16);
  for (Vec3& vertex : mesh.vertices) vertex.x() -= 12;
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  constexpr double top = 8;
  mesh.vertices.insert(mesh.vertices.end(), {left,
                                             right,
                                             {left.x() - 0.1, left.y() - width, top},
                                             {right.x() + 0.1, right.y() - width, top},
                                             {right.x() + 0.1, right.y() + width, top},
                                             {left.x() - 0.1, left.y() + width, top}});
  const std::array<std::array<std::uint32_t, 3>, 8> facets{
      {{0, 1, 3}, {0, 3, 2}, {1, 0, 5}, {1, 5, 4}, {0, 2, 5}, {1, 4, 3}, {2, 3, 4}, {2, 4, 5}}};
  for (const auto& [a, b, c] : facets) mesh.triangles.push_back({first + a, first + b, first + c});
  return mesh;
}

// None of the wedge's faces is flat, so only ridges and lowest points show where a layer overhangs.
TEST(Layers, FindsRidgesAndPointsOfSteepFaces) {
  struct Wedge {
    Vec3 left, right;
    double width;
  };
  const std::vector<Wedge> wedges{{{0, 0, 3.03}, {8, 0, 3.03}, 2},     // level
                                  {{0, 0, 3.03}, {8, 0, 6.01}, 1},     // rising by 20°
                                  {{0, 0, 2.01}, {4, 0, 7.5}, 0.5},    // by 54°: its lower end alone
                                  {{0, 0, 3.1}, {0.001, 0, 3.1}, 2}};  // a spike
  for (const auto& [left, right, width] : wedges) {
    const TriangleMesh mesh = pillar_and_wedge(left, right, width);
    const std::vector<Vec3> expected = ledges_point_by_point(mesh),
                            ledges = ledges_in_layers(mesh, radians(45), Corners::round);
    EXPECT_FALSE(expected.empty()) << right.z();
    ASSERT_EQ(ledges.size(), expected.size()) << right.z();
    for (std::size_t i = 0; i < ledges.size(); ++i) EXPECT_LT((ledges[i] - expected[i]).norm(), 1e-9) << right.z();
  }
}

TEST(Layers, RoundConeIsSupportedUpToStep) {
  for (const double by : {0.0, 0.1, 0.185, 0.19}) EXPECT_EQ(ledges(tower(growing(by), 256)), 0u) << by;
  // Every layer of the cone overhangs.
  for (const double by : {0.193, 0.2, 0.5}) EXPECT_GE(ledges(tower(growing(by), 256)), 19u) << by;
}

// A corner moves by √2 times the step of its sides, and a corner of the layer below supports only as far as its sides
// do.
TEST(Layers, SquareCornerRequiresSteeperCone) {
  EXPECT_EQ(ledges(tower(growing(0.99 * k_reach / std::numbers::sqrt2), 4)), 0u);
  EXPECT_GE(ledges(tower(growing(1.01 * k_reach / std::numbers::sqrt2), 4)), 19u);
}

// A tip between two such sides moves by the step over the sine of its angle. A squared corner supports it further out,
// but a tip with an edge of a few µm has none.
TEST(Layers, AcuteTipIsSupportedUpToItsReach) {
  for (const double deg : {60.0, 70.0, 80.0}) {
    const double by = k_reach * std::sin(radians(deg));
    EXPECT_EQ(ledges(leaning_tip(0.995 * by, radians(deg))), 0u) << deg;
    EXPECT_GE(ledges(leaning_tip(1.005 * by, radians(deg))), 19u) << deg;
    EXPECT_EQ(ledges(leaning_tip(1.005 * by, radians(deg)), Corners::squared), 0u) << deg;
  }
}

TEST(Layers, MushroomOverhangsOnce) {
  EXPECT_EQ(ledges(tower({{4, 0}, {4, 5}, {9, 5}, {9, 7}}, 64)), 1u);
  EXPECT_EQ(ledges(tower({{4, 0}, {4, 5}, {4.15, 5}, {4.15, 7}}, 64)), 0u);
}

TEST(Layers, BedSupportsSecondLayer) {
  EXPECT_EQ(ledges(tower({{5, 0}, {5, 0.2}, {8, 0.2}, {8, 5}}, 64)), 0u);
  EXPECT_EQ(ledges(tower({{5, 0}, {5, 0.4}, {8, 0.4}, {8, 5}}, 64)), 1u);
}

TEST(SupportAttribution, AttributesNearestTieOffAndMovesIt) {
  Mechanism mechanism = plain_mechanism();
  mechanism.body.tail = Tail::none;
  const profile::SynthesisResult shape = pulley_of(circle(20), circle(18));
  const BodyPlan plan = plan_body(mechanism, shape);
  const Vec3 far(0, 0, plan.layout.z_p1);
  EXPECT_TRUE(attribute_supports({far}, plan).empty());
  for (const PlannedAnchor& anchor : plan.anchors) {
    const double z = anchor.side == transmission::Side::left ? plan.layout.z_p1 : plan.layout.z_p2;
    const Vec3 place(anchor.start().x(), anchor.start().y(), z);
    const std::vector<Rejection> rejections = attribute_supports({place, place}, plan);
    ASSERT_EQ(rejections.size(), 1u);
    EXPECT_EQ(rejections.front(), (Rejection{anchor.side, anchor.wound_end, anchor.wrap(), false}));
    for (const PlannedAnchor& other : plan_body(mechanism, shape, {WrapChoice::furthest, rejections}).anchors) {
      if (other.side != anchor.side || other.wound_end != anchor.wound_end) continue;
      EXPECT_TRUE(anchor.wound_end);
      EXPECT_GT(std::abs(other.wrap() - anchor.wrap()), radians(4));
    }
  }
}

}  // namespace
}  // namespace fusee::solid
