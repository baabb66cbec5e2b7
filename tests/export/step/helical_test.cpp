// The curves and the skin of a multi-turn pulley's STEP file.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include "export/step/helical_curve.h"
#include "export/step/normal_spline.h"
#include "export/step/skin.h"
#include "fusee/base.h"
#include "helical_solid/helical_plan.h"
#include "helical_solid/spirals.h"
#include "support/mechanisms.h"
#include "support/shapes.h"

namespace fusee::formats {
namespace {

using testing::growing;
using testing::oval;
using testing::spiral_of;

/// Five turns of an oval that grows. `length`: of the curve in plan, by Simpson's rule.
struct ShapedOval {
  testing::SupportCurve shape = oval(8.0, 0.9, 0.35, 1.0);
  double begin = 1.0;
  double slope = 0.04;

  Vec2 place(double turn) const { return shape.p(turn) * unit(turn) + shape.dp(turn) * turned_left(unit(turn)); }
  double length(double turn) const {
    constexpr int k_steps = 2000;
    const auto rho = [this](double at) { return shape.p(at) + shape.d2p(at); };
    double sum = rho(begin) + rho(turn);
    for (int i = 1; i < k_steps; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * rho(begin + (turn - begin) * i / k_steps);
    return sum * (turn - begin) / (3.0 * k_steps);
  }
};

TEST(HelicalCurve, FollowsKnownCurve) {
  const ShapedOval known;
  // Rows further apart than those of any pulley.
  const helix::Spiral spiral = spiral_of(known.shape, known.begin, 5.0, known.slope, 0.1);
  const helical_solid::SpiralPlace place{60.0, -1.0};
  const HelicalCurve curve(spiral, place);
  for (int i = 0; i < 1000; ++i) {
    const double turn = known.begin + 5.0 * k_two_pi * (i + 0.37) / 1000;
    const Vec3 found = curve.at(turn);
    EXPECT_LT((found.head<2>() - known.place(turn)).norm(), 1e-6) << turn;
    EXPECT_NEAR(found.z(), 60.0 - known.slope * known.length(turn), 1e-6) << turn;
  }
}

/// A pulley of two ovals that grow, with its skin.
class Skin : public ::testing::Test {
 protected:
  static const Product& product() {
    static const Product made = [] {
      Product product;
      DeclaredMechanism declared = testing::forearm();
      declared.body = testing::plain_mechanism().body;
      declared.material = testing::plain_mechanism().material;
      declared.print = testing::plain_mechanism().print;
      product.joint.mechanism = declared;
      const Mechanism& mechanism = product.joint.mechanism;
      HelixProduct& helix = product.helix.emplace();
      const helical_solid::HelicalSection section = helical_solid::helical_section(mechanism);
      // Slopes 2 % above the least ones at which neighbouring turns clear each other.
      const auto p1 = oval(9.0, 0.6, 0.3, 0.4), p2 = growing(13.0, -0.8, 2.0);
      helix.synthesis.sides[0].spiral = spiral_of(p1, 0.4, 4.3, 1.02 * testing::slope_for(p1, 0.4, 4.3, section));
      helix.synthesis.sides[1].spiral = spiral_of(p2, 2.0, 3.6, 1.02 * testing::slope_for(p2, 2.0, 3.6, section));
      helix.pulley = helical_solid::make_helical_pulley(mechanism, helix.synthesis.sides[0].spiral,
                                                        helix.synthesis.sides[1].spiral);
      product.pulley.layout = helix.pulley.layout;
      return product;
    }();
    return made;
  }
  static const StepSkin& skin() {
    static const StepSkin made = helical_skin(product());
    return made;
  }

  void SetUp() override { ASSERT_TRUE(product().helix->pulley.made) << product().helix->pulley.brief(); }
};

TEST_F(Skin, EveryEdgeIsUsedOnceEachWay) {
  std::vector<int> forwards(skin().edges.size(), 0), backwards(skin().edges.size(), 0);
  for (const StepSkin::Face& face : skin().faces) {
    for (const auto& loop : face.loops) {
      for (const StepSkin::Use& use : loop) ++(use.backwards ? backwards : forwards)[use.edge];
    }
  }
  EXPECT_EQ(std::count(forwards.begin(), forwards.end(), 1), std::ssize(forwards));
  EXPECT_EQ(std::count(backwards.begin(), backwards.end(), 1), std::ssize(backwards));
}

TEST_F(Skin, LoopsCloseAndEdgesEndAtTheirCorners) {
  for (const StepSkin::Edge& edge : skin().edges) {
    const auto* curve = std::get_if<StepSkin::Curve>(&edge.along);
    if (curve == nullptr) continue;
    EXPECT_EQ(curve->poles.size() + k_step_degree + 1, curve->knots.size());
    EXPECT_EQ((curve->poles.front() - skin().corners[edge.first]).norm(), 0);
    EXPECT_EQ((curve->poles.back() - skin().corners[edge.last]).norm(), 0);
  }
  for (const StepSkin::Face& face : skin().faces) {
    for (const auto& loop : face.loops) {
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const StepSkin::Use &use = loop[k], &next = loop[(k + 1) % loop.size()];
        const StepSkin::Edge &here = skin().edges[use.edge], &there = skin().edges[next.edge];
        EXPECT_EQ(use.backwards ? here.first : here.last, next.backwards ? there.last : there.first);
      }
    }
  }
}

/// A solid without handles: corners − edges + faces, less one for each hole in a face, are two.
TEST_F(Skin, IsClosedWithoutHandles) {
  std::ptrdiff_t holes = 0;
  for (const StepSkin::Face& face : skin().faces) holes += std::ssize(face.loops) - 1;
  EXPECT_EQ(std::ssize(skin().corners) - std::ssize(skin().edges) + std::ssize(skin().faces) - holes, 2);
}

Vec3 point_of(const StepSkin::Patch& patch, const std::vector<Vec3>& row, double psi) {
  SplineBundle spline{patch.knots, Eigen::MatrixXd(static_cast<Eigen::Index>(row.size()), 3)};
  for (std::size_t i = 0; i < row.size(); ++i) spline.poles.row(static_cast<Eigen::Index>(i)) = row[i].transpose();
  return spline.at(psi).transpose();
}

/// Signed volume of the tetrahedron from the origin to a triangle. Over a closed surface the volumes add up to that of
/// the solid (divergence theorem).
double tetrahedron_volume(const Vec3& a, const Vec3& b, const Vec3& c) { return a.dot(b.cross(c)) / 6.0; }

constexpr int k_along = 160, k_across = 12;  // segments along and across a patch

/// A point of a rational quadratic arc from `first` to `last`, whose end tangents meet in `corner`.
Vec3 arc_point(const Vec3& first, const Vec3& corner, const Vec3& last, double weight, double v) {
  const double a = (1 - v) * (1 - v), b = 2 * v * (1 - v) * weight, c = v * v;
  return (a * first + b * corner + c * last) / (a + b + c);
}

double volume_below(const StepSkin::Patch& patch) {
  const auto at = [&](int i, int j) -> Vec3 {
    const double psi = patch.knots.front() + (patch.knots.back() - patch.knots.front()) * i / k_along;
    const double v = static_cast<double>(j) / k_across;
    const Vec3 low = point_of(patch, patch.rows.front(), psi), high = point_of(patch, patch.rows.back(), psi);
    if (patch.rows.size() == 2) return (1 - v) * low + v * high;
    return arc_point(low, point_of(patch, patch.rows[1], psi), high, patch.weight, v);
  };
  double volume = 0;
  for (int i = 0; i < k_along; ++i) {
    for (int j = 0; j < k_across; ++j) {
      volume += tetrahedron_volume(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      volume += tetrahedron_volume(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  return volume;
}

/// Points of an edge from its first corner to its last.
std::vector<Vec3> points_along(const StepSkin& skin, const StepSkin::Edge& edge) {
  const Vec3 &first = skin.corners[edge.first], &last = skin.corners[edge.last];
  std::vector<Vec3> points{first};
  for (int i = 1; i < k_along; ++i) {
    const double share = static_cast<double>(i) / k_along;
    if (const auto* curve = std::get_if<StepSkin::Curve>(&edge.along)) {
      const StepSkin::Patch alone{curve->knots, {curve->poles}, 1};
      points.push_back(point_of(alone, curve->poles,
                                curve->knots.front() + (curve->knots.back() - curve->knots.front()) * i / k_along));
    } else if (const auto* arc = std::get_if<StepSkin::Arc>(&edge.along)) {
      points.push_back(arc_point(first, arc->corner, last, arc->weight, share));
    } else if (const auto* round = std::get_if<StepSkin::Round>(&edge.along)) {
      const Vec2 place = round->radius * unit(round->from + (round->to - round->from) * i / k_along);
      points.emplace_back(place.x(), place.y(), first.z());
    }
  }
  points.push_back(last);
  return points;
}

double volume_below(const StepSkin& skin, const StepSkin::Plane& plane,
                    const std::vector<std::vector<StepSkin::Use>>& loops) {
  double volume = 0;
  for (const auto& loop : loops) {
    for (const StepSkin::Use& use : loop) {
      std::vector<Vec3> points = points_along(skin, skin.edges[use.edge]);
      if (use.backwards) std::reverse(points.begin(), points.end());
      for (std::size_t i = 0; i + 1 < points.size(); ++i)
        volume += tetrahedron_volume(plane.point, points[i], points[i + 1]);
    }
  }
  return volume;
}

TEST_F(Skin, VolumeMatchesBlank) {
  double volume = 0;
  for (const StepSkin::Face& face : skin().faces) {
    if (const auto* patch = std::get_if<StepSkin::Patch>(&face.surface)) {
      volume += volume_below(*patch);
    } else if (const auto* hub = std::get_if<StepSkin::Cylinder>(&face.surface)) {
      // The side of a cylinder contributes two thirds of its volume, so each of its two faces contributes one third. The
      // second edge of the loop runs up; a point of it is (angle, height).
      const StepSkin::Use& up = face.loops.front()[1];
      volume += k_pi * hub->radius * hub->radius * std::abs(up.to.y() - up.from.y()) / 3.0;
    } else {
      volume += volume_below(skin(), std::get<StepSkin::Plane>(face.surface), face.loops);
    }
  }
  const helical_solid::HelicalPlan& plan = *product().helix->pulley.plan;
  const solid::BodyLayout& layout = product().helix->pulley.layout;
  const solid::TriangleMesh blank = helical_solid::helical_blank(plan.fan, plan.section, layout, plan.heights);
  // The skin has no bore, the blank has.
  const double bore = std::abs(signed_area(layout.bore.outline)) * plan.heights.hub_top;
  const double expected = std::pow(layout.scale, 3) * (solid::enclosed_volume(blank) + bore);
  // Both surfaces are drawn with chords, whose error is below 0.2 %.
  EXPECT_NEAR(volume, expected, 0.002 * expected);
}

}  // namespace
}  // namespace fusee::formats
