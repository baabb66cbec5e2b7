/// \file
/// Internal: closed convex curves, known at sampled normals, as B-splines over the normal's direction.
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "export/step/step_part.h"
#include "fusee/base.h"

namespace fusee::formats {

/// Powers of u, from 0 to 1, of the Hermite polynomial of degree 5 with h, h' and h''/2 (derivatives by u): `h0`, `d0`,
/// `e0` at 0 and `h1`, `d1`, `e1` at 1.
std::array<double, 6> hermite_powers(double h0, double d0, double e0, double h1, double d1, double e1);

/// A curve by its support function h(ψ): its point with the normal n is h n + h' t. Between samples h is a polynomial
/// with the values h, h' and h'' of both ends. A straight between two samples turns by 0.005° about its own direction.
class SupportCurve {
 public:
  /// Points of a curve with outward normals in the directions `psi`, increasing within a turn. `radii`: of curvature;
  /// if empty, computed from the points.
  SupportCurve(std::vector<double> psi, std::vector<Vec2> points, std::vector<double> radii);

  Vec2 at(double psi) const;
  /// d point / dψ = radius · tangent.
  double radius_at(double psi) const { return values_at(psi).radius; }
  /// Directions at which straights end.
  const std::vector<double>& kinks() const { return kinks_; }

 private:
  struct Sample {
    double psi;
    Vec2 point;
    double radius;
    double support() const { return point.dot(unit(psi)); }
    double slope() const { return point.dot(turned_left(unit(psi))); }
  };
  struct Values {
    double support, slope, radius;
  };

  static std::optional<std::pair<Sample, Sample>> straight_between(const Sample& from, const Sample& to);
  void add(const Sample& from, const Sample& to);
  std::size_t interval_of(double psi) const;
  Values values_in(std::size_t interval, double width, double u) const;
  Values values_at(double psi) const;

  std::vector<double> psi_;                     ///< the first direction is repeated, a turn on, at the end
  std::vector<std::array<double, 6>> support_;  ///< powers of h over u for each interval
  std::vector<double> kinks_;
};

/// Several curves on one knot vector. A row holds the coordinates of all curves.
struct SplineBundle {
  std::vector<double> knots;
  Eigen::MatrixXd poles;  ///< one row for each pole

  Eigen::RowVectorXd at(double psi) const;
};

/// The function over ψ that such a spline approximates.
struct SplineTarget {
  std::function<Eigen::RowVectorXd(double psi)> at;
  std::function<Eigen::RowVectorXd(double psi)> slope;  ///< evaluated at both ends, from inside
  /// Error of the fitted values at ψ per tolerance.
  std::function<double(const Eigen::RowVectorXd& fitted, double psi)> error;
};

/// Inserts knots until the tolerance is met. `kinks`: directions with tangent continuity only. Empty if too many knots
/// would be needed.
std::optional<SplineBundle> fit(const SplineTarget& target, double from, double to, const std::vector<double>& kinks);

/// The curve over one sector and its normals on the same knots. The poles of a parallel curve are position + distance ·
/// normal.
struct NormalSpline {
  std::vector<double> knots;
  std::vector<Vec2> position;
  std::vector<Vec2> normal;

  StepSpline parallel(double distance) const;
};

/// Inserts knots until the error is at most `tolerance`, and the error of a circle of radius `reach` drawn by the
/// normals at most 2e-6 mm. `kinks`: directions with tangent continuity only. Empty if too many knots would be needed.
std::optional<NormalSpline> fit(const SupportCurve& curve, double from, double to, const std::vector<double>& kinks,
                                double tolerance, double reach);

/// Point of a spline: the sum of its poles times their basis functions (recursion of Cox and de Boor).
Vec2 point_on(const StepSpline& spline, double psi);

}  // namespace fusee::formats
