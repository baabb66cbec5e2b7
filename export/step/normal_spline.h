/// \file
/// Closed convex curves known at sampled normals, as B-splines over the normal's direction.
#pragma once

#include <optional>
#include <vector>

#include "export/step/step_part.h"
#include "fusee/base/plane.h"

namespace fusee {

/// A curve by its support function h(ψ): its point with the normal n is h n + h' t. Between samples a polynomial that
/// has h, h' and, where they are known, the second derivatives of both ends.
class SupportCurve {
 public:
  /// Points of a curve with outward normals in the directions `psi`, increasing within a turn. `radii`: of curvature,
  /// or none.
  SupportCurve(std::vector<double> psi, const std::vector<Vec2>& points, const std::vector<double>& radii);

  Vec2 at(double psi) const;
  const std::vector<double>& directions() const { return psi_; }  ///< the first a turn on at the end
  bool is_drawn_with_radii() const { return with_radii_; }
  /// d point / dψ = radius · tangent; at a sample.
  double radius_near(double psi) const;

 private:
  std::size_t interval_of(double& psi) const;

  std::vector<double> psi_, h_, dh_, ddh_;
  bool with_radii_ = false;
};

/// The curve over one sector and its normals, on the same knots: a parallel curve's poles are position + distance ·
/// normal.
struct NormalSpline {
  std::vector<double> knots;
  std::vector<Vec2> position;
  std::vector<Vec2> normal;

  StepSpline parallel(double distance) const;
};

/// Knots are added until no point of the curve is off by more than `tolerance`, and none of a circle of radius `reach`
/// that its normals draw by more than 2e-6 mm.
/// `kinks`: directions at which no more than the tangent is continuous. Null where that takes too many.
std::optional<NormalSpline> fit(const SupportCurve& curve, double from, double to, const std::vector<double>& kinks,
                                double tolerance, double reach);

/// Point of a spline, by de Boor's algorithm.
Vec2 point_on(const StepSpline& spline, double psi);

}  // namespace fusee
