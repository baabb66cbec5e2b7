/// \file
/// The rest of a pitch curve: from the end of the active arc round to its beginning, convex and with continuous
/// curvature.
#pragma once

#include <optional>
#include <vector>

#include "profile/take_off.h"

namespace fusee {

/// Radius of curvature linear between equally spaced knots; position, support and tangent follow by exact integration.
class ClosingArc {
 public:
  /// From `begin` counter-clockwise to `end` (end.psi > begin.psi), nowhere bent more sharply than `least_radius` (or
  /// than the ends themselves are). Null when no convex arc joins the two: their tangents meet on the wrong side.
  static std::optional<ClosingArc> between(const CurvePoint& begin, const CurvePoint& end, double least_radius);

  CurvePoint at(double psi) const;
  double radius(double psi) const;  ///< at(psi).radius
  double length() const;
  /// The smallest distance of a tangent from the axis; below zero the axis lies outside.
  double least_support() const;

 private:
  /// Of the knot before, and the share of the way to the next one.
  struct Place {
    std::size_t knot;
    double share;
  };
  Place place(double psi) const;
  double radius(const Place& place) const;

  double begin_ = 0;
  double step_ = 0;
  std::vector<double> radii_;    ///< at the knots
  std::vector<Vec2> positions_;  ///< at the knots
};

}  // namespace fusee
