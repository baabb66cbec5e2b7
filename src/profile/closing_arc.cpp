#include "profile/closing_arc.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace fusee::profile {
namespace {

constexpr int k_segments = 192;  ///< number of intervals between knots

/// ∫ ρ t dψ over a segment with ρ linear from r0 to r1: the displacement along the curve.
/// With t = n' and ∫ n = −t:  [ρ n] − slope ∫ n = r1 n1 − r0 n0 + slope (t1 − t0).
Vec2 displacement_between(double turn, const Vec2& n0, const Vec2& n1, double r0, double r1) {
  const double slope = (r1 - r0) / turn;
  return r1 * n1 - r0 * n0 + slope * (turned_left(n1) - turned_left(n0));
}
Vec2 displacement(double psi0, double psi1, double r0, double r1) {
  return displacement_between(psi1 - psi0, unit(psi0), unit(psi1), r0, r1);
}

/// Radius of curvature at each knot as a function of the two multipliers of the closure equations.
struct Knots {
  std::vector<double> psi;
  std::vector<Vec2> normal;            ///< unit(psi)
  std::vector<Vec2> hat_displacement;  ///< displacement due to a radius that is 1 at the knot and 0 at its neighbours
  std::vector<double> preferred;  ///< preferred radius: that of the ends, in between that of a curve about the axis
  std::vector<double> window;     ///< weight of deviations from the preferred radius: zero at the ends
  std::vector<double> least;      ///< lower bound of the radius

  double radius(std::size_t i, const Vec2& multipliers) const {
    return std::max(least[i], preferred[i] + window[i] * multipliers.dot(turned_left(normal[i])));
  }
};

/// Weight of an end's curvature at `turn` from it: 1 at the end, 0 after a sixth of a turn. For a flat end the interval
/// is shorter, as a sixth of a turn would lead too far away. The intervals of both ends do not overlap in the turn
/// `arc_turn` of the arc.
double end_weight(const CurvePoint& end, double turn, double arc_turn) {
  const double interval = std::min(0.4 * arc_turn, radians(60.0) * std::min(1.0, end.h / end.radius));
  const double x = std::min(1.0, turn / interval);
  return 1.0 - x * x * (3.0 - 2.0 * x);
}

Knots make_knots(const CurvePoint& begin, const CurvePoint& end, double least_radius) {
  Knots knots;
  const double arc_turn = end.psi - begin.psi;
  for (int i = 0; i <= k_segments; ++i) {
    const double u = static_cast<double>(i) / k_segments;
    const double of_begin = end_weight(begin, arc_turn * u, arc_turn);
    const double of_end = end_weight(end, arc_turn * (1.0 - u), arc_turn);
    const double about_axis = begin.h + (end.h - begin.h) * u;
    knots.psi.push_back(begin.psi + arc_turn * u);
    knots.normal.push_back(unit(knots.psi.back()));
    knots.preferred.push_back(of_begin * begin.radius + of_end * end.radius + (1.0 - of_begin - of_end) * about_axis);
    knots.window.push_back((1.0 - of_begin) * (1.0 - of_end));
    knots.least.push_back(std::min(least_radius, knots.preferred.back()));
  }
  const double step = knots.psi[1] - knots.psi[0];
  for (const double psi : knots.psi)
    knots.hat_displacement.push_back(displacement(psi - step, psi, 0, 1) + displacement(psi, psi + step, 1, 0));
  return knots;
}

/// Position error of the arc's end for these multipliers.
Vec2 closure_gap(const Knots& knots, const Vec2& multipliers, const Vec2& target) {
  Vec2 gap = -target;
  double radius = knots.radius(0, multipliers);
  for (std::size_t i = 0; i + 1 < knots.psi.size(); ++i) {
    const double next = knots.radius(i + 1, multipliers);
    gap += displacement_between(knots.psi[i + 1] - knots.psi[i], knots.normal[i], knots.normal[i + 1], radius, next);
    radius = next;
  }
  return gap;
}

/// d gap / d multipliers over the knots that are not at their bound.
Eigen::Matrix2d closure_slope(const Knots& knots, const Vec2& multipliers) {
  Eigen::Matrix2d slope = Eigen::Matrix2d::Zero();
  for (std::size_t i = 1; i + 1 < knots.psi.size(); ++i) {
    if (knots.radius(i, multipliers) <= knots.least[i]) continue;
    slope += knots.hat_displacement[i] * (knots.window[i] * turned_left(knots.normal[i])).transpose();
  }
  return slope;
}

}  // namespace

// The preferred radius ρ0(ψ) equals the curvature radius at the ends and that of a curve about the axis in between.
// Among all ρ(ψ) ≥ ρ_least that close the curve, ∫ρ t dψ = V, the one nearest to ρ0 with weight 1/window is ρ =
// max(ρ_least, ρ0 + window · λ·t(ψ)). Newton's method on the convex dual finds the multipliers λ of the two closure
// equations. They diverge when no convex arc closes the curve.
std::optional<ClosingArc> ClosingArc::between(const CurvePoint& begin, const CurvePoint& end, double least_radius) {
  if (!(end.psi > begin.psi) || !(begin.radius > 0) || !(end.radius > 0)) return std::nullopt;
  const Knots knots = make_knots(begin, end, least_radius);
  const Vec2 target = end.position() - begin.position();
  const double size = target.norm() + begin.radius + end.radius;
  constexpr int k_most_steps = 100;
  constexpr double k_closed = 1e-13, k_closed_enough = 1e-10;  // gap relative to the size
  constexpr double k_least_fraction = 1e-6;                    // of a Newton step

  Vec2 multipliers(0, 0);
  Vec2 gap = closure_gap(knots, multipliers, target);
  for (int i = 0; i < k_most_steps && gap.norm() > k_closed * size; ++i) {
    const Vec2 step = -closure_slope(knots, multipliers).fullPivLu().solve(gap);
    if (!step.allFinite()) return std::nullopt;
    double fraction = 1.0;
    Vec2 next_gap = closure_gap(knots, multipliers + step, target);
    while (next_gap.norm() >= gap.norm() && fraction > k_least_fraction) {
      fraction *= 0.5;
      next_gap = closure_gap(knots, multipliers + fraction * step, target);
    }
    if (next_gap.norm() >= gap.norm()) break;
    multipliers += fraction * step;
    gap = next_gap;
  }
  if (!(gap.norm() <= k_closed_enough * size)) return std::nullopt;

  ClosingArc arc;
  arc.begin_ = begin.psi;
  arc.step_ = (end.psi - begin.psi) / k_segments;
  arc.positions_.push_back(begin.position());
  for (std::size_t i = 0; i < knots.psi.size(); ++i) {
    arc.radii_.push_back(knots.radius(i, multipliers));
    if (i > 0) {
      arc.positions_.push_back(arc.positions_.back() +
                               displacement(knots.psi[i - 1], knots.psi[i], arc.radii_[i - 1], arc.radii_[i]));
    }
  }
  return arc;
}

ClosingArc::KnotFraction ClosingArc::knot_fraction(double psi) const {
  const double steps = std::clamp((psi - begin_) / step_, 0.0, static_cast<double>(k_segments));
  const auto knot = std::min(static_cast<std::size_t>(steps), static_cast<std::size_t>(k_segments - 1));
  return {knot, steps - static_cast<double>(knot)};
}

double ClosingArc::radius(const KnotFraction& here) const {
  return radii_[here.knot] + (radii_[here.knot + 1] - radii_[here.knot]) * here.fraction;
}
double ClosingArc::radius(double psi) const { return radius(knot_fraction(psi)); }

CurvePoint ClosingArc::at(double psi) const {
  const KnotFraction here = knot_fraction(psi);
  const std::size_t i = here.knot;
  const double psi0 = begin_ + static_cast<double>(i) * step_;
  const double radius = this->radius(here);
  Vec2 position = positions_[i];
  if (psi > psi0) position += displacement(psi0, psi, radii_[i], radius);
  return {psi, position.dot(unit(psi)), position.dot(turned_left(unit(psi))), radius};
}

double ClosingArc::least_support() const {
  double least = positions_.front().dot(unit(begin_));
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    least = std::min(least, positions_[i].dot(unit(begin_ + static_cast<double>(i) * step_)));
  }
  return least;
}

double ClosingArc::length() const {
  double length = 0;
  for (std::size_t i = 0; i + 1 < radii_.size(); ++i) length += 0.5 * (radii_[i] + radii_[i + 1]) * step_;
  return length;
}

}  // namespace fusee::profile
