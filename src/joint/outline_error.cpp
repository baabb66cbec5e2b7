#include "joint/outline_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "base/text.h"
#include "fusee/base.h"
#include "fusee/joint.h"
#include "fusee/transmission.h"

namespace fusee::joint {
namespace {

/// Displaces a point against the wave of making. Making moves points by w along their normals, which changes the
/// support of a curve with the radius of curvature ρ by w + w'²/(2ρ) (support_wave).
void correct_wave(profile::OutlinePoint& point, const OutlineError& outline) {
  if (outline.wave_sin == 0 && outline.wave_cos == 0) return;
  const OutlineWave w = outline_wave(point.psi, outline);
  const double rho = point.curvature_radius;
  const double support = w.outward + 0.5 * w.slope * w.slope / rho;
  const double slope = w.slope + w.slope * w.bend / rho;
  point.position -= support * point.normal + slope * Vec2(-point.normal.y(), point.normal.x());
  point.curvature_radius -= w.outward + w.bend;
}

/// The made position of a point. Its normal is perpendicular to the line between the points `before` and `after` it.
Vec2 made_between(const Vec2& point, const Vec2& before, const Vec2& after, const OutlineError& outline) {
  const Vec2 along = (after - before).normalized(), normal(along.y(), -along.x());
  return point + Vec2(outline.runout_x, outline.runout_y) +
         outline_wave(elementary::atan2(normal.y(), normal.x()), outline).outward * normal;
}

/// Inward turn up to which a corner counts as rounding of its neighbours.
constexpr double k_most_inward = radians(0.5);

/// Turn of a polygon at one of its corners. rad
struct CornerTurn {
  double turn = std::numeric_limits<double>::infinity();  ///< to the left positive
  double normal = 0;                                      ///< direction of the normal there
};

/// The corner with the smallest turn to the left.
CornerTurn least_turn(const std::vector<profile::OutlinePoint>& points) {
  CornerTurn least;
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 before = points[i].position - points[(i + n - 1) % n].position,
               after = points[(i + 1) % n].position - points[i].position;
    const double turn = elementary::atan2(cross(before, after), before.dot(after));
    if (turn < least.turn) least = {turn, points[i].psi};
  }
  return least;
}

}  // namespace

OutlineWave outline_wave(double psi, const OutlineError& outline) {
  const double n = outline.wave_order;
  const double outward = outline.wave_sin * elementary::sin(n * psi) + outline.wave_cos * elementary::cos(n * psi);
  const double slope = n * (outline.wave_sin * elementary::cos(n * psi) - outline.wave_cos * elementary::sin(n * psi));
  return {outward, slope, -n * n * outward};
}

// Every outline point moves by w along its normal. The farthest point along ψ is then a neighbour: the support changes
// by w + w'²/(2ρ), with the radius of curvature ρ approximated by the support. The arc changes by the integral of that
// over ψ, for which `squares` is ∫ w'² dψ.
SupportWave support_wave(double psi, double support, const OutlineError& outline) {
  const double n = outline.wave_order;
  const double s = outline.wave_sin;
  const double c = outline.wave_cos;
  const double sine = elementary::sin(n * psi);
  const double cosine = elementary::cos(n * psi);
  const OutlineWave w = outline_wave(psi, outline);
  const double squares =
      0.5 * n * n *
      ((s * s + c * c) * psi + ((s * s - c * c) * sine * cosine + s * c * (cosine * cosine - sine * sine)) / n);
  return {w.outward + 0.5 * w.slope * w.slope / support, (c * sine - s * cosine) / n + 0.5 * squares / support};
}

profile::OutlinePoint drawn_for_making(profile::OutlinePoint point, const OutlineError& outline) {
  correct_wave(point, outline);
  point.position -= Vec2(outline.runout_x, outline.runout_y) + outline.offset * point.normal;
  point.curvature_radius -= outline.offset;
  return point;
}

void draw_for_making(profile::SynthesisResult& synthesis, const OutlineError& outline) {
  for (profile::Outline* curve : {&synthesis.p1, &synthesis.p2}) {
    for (profile::OutlinePoint& point : curve->points) point = drawn_for_making(point, outline);
  }
}

std::vector<profile::Condition> turns_inward_as_drawn(const profile::SynthesisResult& drawn,
                                                      const OutlineError& outline) {
  std::vector<profile::Condition> failed;
  if (outline.wave_sin == 0 && outline.wave_cos == 0) return failed;
  for (const profile::Outline* curve : {&drawn.p1, &drawn.p2}) {
    const auto [turn, normal] = least_turn(curve->points);
    if (turn >= -k_most_inward) continue;
    profile::Condition condition;
    condition.name = "drawn_convex_" + std::string(transmission::pulley_name(curve->side));
    condition.ok = false;
    condition.value = degrees(turn);
    condition.limit = -degrees(k_most_inward);
    condition.unit = "deg";
    condition.message = "drawn against the wave of its making (identified.profile_sin_mm, identified.profile_cos_mm) " +
                        std::string(transmission::pulley_name(curve->side)) + " turns inward by " +
                        rounded(-degrees(turn), 2) + "° at a normal of " + fixed(degrees(normal), 0) +
                        "°: it bends too sharply there for such a wave";
    failed.push_back(std::move(condition));
  }
  return failed;
}

Polygon as_made(Polygon drawn, const OutlineError& outline) {
  const Polygon original = drawn;
  const std::size_t n = drawn.size();
  for (std::size_t i = 0; i < n; ++i)
    drawn[i] = made_between(drawn[i], original[(i + n - 1) % n], original[(i + 1) % n], outline);
  return drawn;
}

Polygon line_as_made(Polygon drawn, const OutlineError& outline, std::size_t beside) {
  const Polygon original = drawn;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    // Near an end of the line, fewer points are used: equally many on both sides. At the end itself, one is used.
    const std::size_t available = std::min({beside, i, drawn.size() - 1 - i});
    const std::size_t count = std::max<std::size_t>(available, 1);
    const std::size_t before = i < count ? 0 : i - count, after = std::min(i + count, drawn.size() - 1);
    drawn[i] = made_between(drawn[i], original[before], original[after], outline);
  }
  return drawn;
}

Mechanism with_inset(const IdentifiedJoint& joint) {
  Mechanism mechanism = joint.mechanism;
  mechanism.tendon.diameter += 2 * joint.outline.offset;
  mechanism.guides.radius -= joint.outline.offset;
  if (mechanism.joint.drum_radius != 0) mechanism.joint.drum_radius -= joint.outline.offset;
  return mechanism;
}

}  // namespace fusee::joint
