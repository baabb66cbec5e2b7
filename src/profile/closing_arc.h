/// \file
/// The closing arc of a pitch curve, from the end of the active arc to its beginning: convex, with continuous
/// curvature.
#pragma once

#include <optional>
#include <vector>

#include "profile/take_off.h"

namespace fusee::profile {

/// The radius of curvature is linear between equally spaced knots. Position, support and tangent follow by exact
/// integration.
class ClosingArc {
 public:
  /// Joins `begin` counter-clockwise to `end` (end.psi > begin.psi) with a radius of at least `least_radius`, or that
  /// of the ends if smaller. Null when no convex arc exists.
  static std::optional<ClosingArc> between(const CurvePoint& begin, const CurvePoint& end, double least_radius);

  CurvePoint at(double psi) const;
  double radius(double psi) const;  ///< at(psi).radius
  double length() const;
  /// Minimum distance of a tangent from the axis; negative if the axis is outside.
  double least_support() const;

 private:
  /// A direction ψ by the preceding knot and the fraction of the way to the next one.
  struct KnotFraction {
    std::size_t knot;
    double fraction;
  };
  KnotFraction knot_fraction(double psi) const;
  double radius(const KnotFraction& here) const;

  double begin_ = 0;             ///< ψ at the first knot, rad
  double step_ = 0;              ///< angle from knot to knot, rad
  std::vector<double> radii_;    ///< at the knots
  std::vector<Vec2> positions_;  ///< at the knots
};

}  // namespace fusee::profile
