#include "export/step/normal_spline.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "fusee/base.h"

namespace fusee::formats {
namespace {

constexpr int k_samples = 190;

/// Normals all round, unevenly spaced.
std::vector<double> directions() {
  std::vector<double> psi;
  for (int i = 0; i < k_samples; ++i) {
    const double share = (i + 0.3 * std::sin(0.7 * i)) / k_samples;
    psi.push_back(0.4 + k_two_pi * share);
  }
  return psi;
}

/// An ellipse by its support function h = √(a² cos² + b² sin²); its radius of curvature is a²b²/h³.
struct Ellipse {
  double a, b;
  double support(double psi) const { return std::hypot(a * std::cos(psi), b * std::sin(psi)); }
  Vec2 point(double psi) const { return Vec2(a * a * std::cos(psi), b * b * std::sin(psi)) / support(psi); }
  double radius(double psi) const { return a * a * b * b / std::pow(support(psi), 3); }
  /// The distance of a point from it, to first order, by its implicit equation.
  double distance(const Vec2& at) const {
    const double value = at.x() * at.x() / (a * a) + at.y() * at.y() / (b * b) - 1;
    return std::abs(value) / (2 * Vec2(at.x() / (a * a), at.y() / (b * b)).norm());
  }
};

SupportCurve sampled(const Ellipse& ellipse) {
  std::vector<Vec2> points;
  std::vector<double> radii;
  for (const double psi : directions()) {
    points.push_back(ellipse.point(psi));
    radii.push_back(ellipse.radius(psi));
  }
  return {directions(), points, radii};
}

/// The largest `error(point)` along the spline.
template <typename Error>
double worst_of(const StepSpline& spline, const Error& error) {
  double worst = 0;
  const double from = spline.knots.front(), to = spline.knots.back();
  for (int i = 0; i <= 2000; ++i) worst = std::max(worst, error(point_on(spline, from + (to - from) * i / 2000)));
  return worst;
}

TEST(NormalSpline, MatchesSampledEllipse) {
  const Ellipse ellipse{24, 15};
  const auto spline = fit(sampled(ellipse), 0.1, 0.1 + 4, {}, 5e-5, 30);
  ASSERT_TRUE(spline);
  EXPECT_LT(worst_of(spline->parallel(0), [&](const Vec2& at) { return ellipse.distance(at); }), 6e-5);
  EXPECT_LT(spline->position.size(), 60u);
}

TEST(NormalSpline, TighterToleranceRequiresMorePoles) {
  const Ellipse ellipse{24, 15};
  const auto coarse = fit(sampled(ellipse), 0, 4, {}, 1e-2, 1), fine = fit(sampled(ellipse), 0, 4, {}, 1e-6, 1);
  ASSERT_TRUE(coarse && fine);
  EXPECT_LT(coarse->position.size(), fine->position.size());
  EXPECT_LT(worst_of(fine->parallel(0), [&](const Vec2& at) { return ellipse.distance(at); }), 2e-6);
}

TEST(NormalSpline, ParallelsOfCircleAreCircles) {
  const Ellipse circle{18, 18};
  const auto spline = fit(sampled(circle), 0.2, 5, {}, 5e-5, 30);
  ASSERT_TRUE(spline);
  for (const double distance : {-3.0, 0.0, 7.0}) {
    EXPECT_LT(worst_of(spline->parallel(distance), [&](const Vec2& at) { return std::abs(at.norm() - 18 - distance); }),
              5e-6);
  }
}

TEST(NormalSpline, PiecesJoinTangentially) {
  const SupportCurve curve = sampled({24, 15});
  const auto first = fit(curve, 0.1, 3, {}, 5e-5, 1), second = fit(curve, 3, 0.1 + k_two_pi, {}, 5e-5, 1);
  ASSERT_TRUE(first && second);
  EXPECT_LT((first->position.back() - second->position.front()).norm(), 1e-12);
  EXPECT_LT((first->position.front() - second->position.back()).norm(), 1e-9);
  const Vec2 before = first->position.back() - first->position[first->position.size() - 2];
  const Vec2 after = second->position[1] - second->position[0];
  EXPECT_LT(std::abs(cross(before.normalized(), after.normalized())), 1e-9);
}

/// The radius is 10 up to ψ = π, and grows by 8 mm/rad from there on. Such a curve does not close: the fitted sector
/// excludes the gap.
TEST(NormalSpline, DeclaredKinkAddsNoPoles) {
  std::vector<double> psi = directions(), radii;
  *std::min_element(psi.begin(), psi.end(),
                    [](double a, double b) { return std::abs(a - k_pi) < std::abs(b - k_pi); }) = k_pi;
  const auto point = [](double at) -> Vec2 {
    // The integral of radius · tangent: the second part is that of 8 (ψ − π) from π on.
    const double past = std::max(0.0, at - k_pi);
    return 10 * unit(at) + 8 * Vec2(std::sin(past) - past * std::cos(past), 1 - std::cos(past) - past * std::sin(past));
  };
  std::vector<Vec2> points;
  for (const double at : psi) {
    radii.push_back(10 + 8 * std::max(0.0, at - k_pi));
    points.push_back(point(at));
  }
  const SupportCurve curve(psi, points, radii);
  const auto with_kink = fit(curve, 1, 5, {k_pi}, 1e-5, 1), without_kink = fit(curve, 1, 5, {}, 1e-5, 1);
  ASSERT_TRUE(with_kink && without_kink);
  EXPECT_LT(with_kink->position.size() + 4, without_kink->position.size());
  const StepSpline spline = with_kink->parallel(0);
  for (const double at : {1.5, 3.0, k_pi, 3.3, 4.5}) EXPECT_LT((point_on(spline, at) - point(at)).norm(), 2e-5) << at;
}

/// A straight section, as curves for idlers have, between samples that are a fifth of a degree apart. The radius is 12
/// before it and 14 after it.
TEST(NormalSpline, StraightBetweenSamplesIsStraight) {
  constexpr double k_length = 2.4;  // of the straight, mm
  constexpr double k_psi = 3.5;     // direction of its normal, rad
  // Samples lie this far beside it, and its own normals may turn by this angle.
  constexpr double k_beside = radians(0.1), k_turn = radians(0.005);
  const Vec2 normal = unit(k_psi), begin = 12 * normal, end = begin + k_length * turned_left(normal);
  const Vec2 centre = end - 14 * normal;
  std::vector<double> psi, radii;
  for (const double at : directions()) {
    if (std::abs(at - k_psi) > 2 * k_beside) psi.push_back(at);
  }
  psi.insert(psi.end(), {k_psi - k_beside, k_psi + 0.7 * k_beside});
  std::sort(psi.begin(), psi.end());
  std::vector<Vec2> points;
  for (const double at : psi) {
    radii.push_back(at < k_psi ? 12 : 14);
    points.push_back(at < k_psi ? Vec2(12 * unit(at)) : Vec2(centre + 14 * unit(at)));
  }
  const auto spline = fit(SupportCurve(psi, points, radii), 2, 5, {}, 5e-5, 1);
  ASSERT_TRUE(spline);
  const StepSpline drawn = spline->parallel(0);
  const auto error = [&](double at) {
    const Vec2 point = point_on(drawn, at);
    if (at < k_psi - k_turn) return std::abs(point.norm() - 12);
    if (at > k_psi + k_turn) return std::abs((point - centre).norm() - 14);
    return std::abs((point - begin).dot(normal));
  };
  double worst = 0;
  for (int i = 0; i <= 2000; ++i) {
    const double share = i / 1000.0 - 1;
    worst = std::max(
        {worst, error(k_psi + 1.2 * share), error(k_psi + 3 * k_beside * share), error(k_psi + k_turn * share)});
  }
  EXPECT_LT(worst, 9e-5);
  EXPECT_LT(spline->position.size(), 40u);
}

}  // namespace
}  // namespace fusee::formats
