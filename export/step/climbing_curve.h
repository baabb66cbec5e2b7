/// \file
/// The pitch curve of a groove that climbs, between the rows of its spiral and beyond its ends.
#pragma once

#include <array>
#include <vector>

#include "coil/winding.h"
#include "fusee/base/plane.h"
#include "fusee/coil/helical_pulley.h"
#include "fusee/helix/spiral.h"

namespace fusee {

/// By its support function h(ψ) as SupportCurve, over all turns: X = h n + h' t, and with s = h' + ∫ h dψ the height.
class ClimbingCurve {
 public:
  ClimbingCurve(const Spiral& spiral, const SpiralPlace& place);

  /// (x, y, height). Beyond the rows the last piece goes on.
  Vec3 at(double turn) const;

 private:
  struct Piece {
    double turn = 0, width = 0;
    std::array<double, 6> support = {};  ///< h over u from 0 to 1, by its powers
    double height = 0;                   ///< where u is 0
  };

  std::vector<Piece> pieces_;
  double climb_ = 0;  ///< height per planar length
};

/// From 0 at 0 to 1 at 1, two derivatives are 0 at both.
double smooth_step(double share);

/// A groove of the part with what its lips do beyond its ends: they go on as the turn before did.
class ClimbingGroove {
 public:
  ClimbingGroove(const Spiral& spiral, const SpiralPlace& place, const Winding& winding);

  double begin() const { return begin_; }
  double end() const { return end_; }
  /// As far as the groove is filled up to its lips.
  double filled_from() const { return filled_from_; }
  double filled_to() const { return filled_to_; }

  Vec3 at(double turn) const;
  /// By how much a lip stands out over what is filled.
  double bulge(double turn, bool low) const;
  /// A closed ring at the distance `outward`, about the lowest or the highest turn, in the direction of a normal.
  Vec2 ring(double direction, bool lowest, double outward) const;

 private:
  ClimbingCurve curve_;
  double begin_, end_, filled_from_, filled_to_;
  double bulge_low_, bulge_high_;
};

}  // namespace fusee
