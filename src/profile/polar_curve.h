/// \file
/// method = "paper": r2 drawn against α in polar coordinates.
#pragma once

#include "profile/pitch_curve.h"

namespace fusee {

/// The closed polar drawing as a string and a groove see it: hollows bridged, corners rounded to the tendon's own
/// radius.
///
/// r is drawn from the direction that the tendon's normal has at home. Between the ends of the stroke it is closed by a
/// cubic in polar coordinates. The paper does not say where on the shaft its profile sits, nor how it is closed.
class PolarCurve : public PitchCurve {
 public:
  PolarCurve(const Mechanism& mechanism, const TakeOffs& take_offs);

  CurvePoint at(double psi) const override;
  double active_begin() const override { return active_begin_; }
  double active_end() const override { return active_end_; }
  std::vector<double> straight_directions() const override;
  /// How far the drawing lies inside its own convex hull, mm.
  double deepest_hollow() const { return deepest_hollow_; }

 private:
  Vec2 position(double psi) const;

  Polygon core_;                 ///< the hull, shrunk by rounding_
  std::vector<double> normals_;  ///< of the edge that leaves each corner of core_, increasing over one turn
  double rounding_ = 0;
  double active_begin_ = 0;
  double active_end_ = 0;
  double deepest_hollow_ = 0;
};

}  // namespace fusee
