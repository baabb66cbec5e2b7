/// \file
/// method = "paper": r2 drawn against α in polar coordinates.
#pragma once

#include "profile/pitch_curve.h"

namespace fusee::profile {

/// The closed polar drawing as a string and a groove follow it: hollows bridged, corners rounded to the tendon's
/// radius.
///
/// The polar angle is 0 in the direction of the tendon's normal at home. A cubic in polar coordinates closes the curve
/// between the ends of the stroke. The paper specifies neither the orientation on the shaft nor the closing.
class PolarCurve : public PitchCurve {
 public:
  PolarCurve(const Mechanism& mechanism, const TakeOffs& take_offs);

  CurvePoint at(double psi) const override;
  double active_begin() const override { return active_begin_; }
  double active_end() const override { return active_end_; }
  std::vector<double> straight_directions() const override;
  /// Maximum depth of the drawing inside its convex hull, mm.
  double deepest_hollow() const { return deepest_hollow_; }

 private:
  Vec2 position(double psi) const;

  Polygon core_;                 ///< the hull, shrunk by rounding_
  std::vector<double> normals_;  ///< normals of the edges that leave the corners of core_, increasing over one turn
  double rounding_ = 0;
  double active_begin_ = 0;
  double active_end_ = 0;
  double deepest_hollow_ = 0;
};

}  // namespace fusee::profile
