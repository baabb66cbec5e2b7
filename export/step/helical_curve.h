/// \file
/// Internal: the pitch curve of a helical groove, between the rows of its spiral and beyond its ends.
#pragma once

#include <array>
#include <vector>

#include "fusee/base.h"
#include "fusee/helical_solid.h"
#include "fusee/helix.h"
#include "helical_solid/winding.h"

namespace fusee::formats {

/// Given by its support function h(ψ) over all turns, as in SupportCurve: X = h n + h' t. The height grows in proportion
/// to the length in plan, s = h' + ∫ h dψ.
class HelicalCurve {
 public:
  HelicalCurve(const helix::Spiral& spiral, const helical_solid::SpiralPlace& place);

  /// x, y and height, mm, where the normal has the direction `turn`, rad, counted over all turns. Beyond the rows, the
  /// first and the last piece are extrapolated.
  Vec3 at(double turn) const;

 private:
  struct Piece {
    double turn = 0, width = 0;          ///< its begin and its extent in ψ, rad
    std::array<double, 6> support = {};  ///< powers of h over u from 0 to 1
    double height = 0;                   ///< height at u = 0
  };

  std::vector<Piece> pieces_;
  double slope_ = 0;  ///< height per planar length
};

/// Rises from 0 at 0 to 1 at 1, with two zero derivatives at both ends.
double smooth_step(double share);

/// A groove of the part, with the continuation of its edges beyond its ends. There it repeats the course of the adjacent
/// turn, shifted to meet the end.
class HelicalGroove {
 public:
  HelicalGroove(const helix::Spiral& spiral, const helical_solid::SpiralPlace& place,
                const helical_solid::Winding& winding);

  double begin() const { return begin_; }
  double end() const { return end_; }
  /// Beyond its ends the groove is filled up to its edges, as far as these turns.
  double filled_from() const { return filled_from_; }
  double filled_to() const { return filled_to_; }

  Vec3 at(double turn) const;
  /// Distance by which the lower (`low`) or the upper groove edge projects outwards beyond its usual distance from the
  /// centre line, mm. It is 0 within the groove and beyond the filled turns.
  double bulge(double turn, bool low) const;
  /// The point of a closed ring where its normal has this direction. The ring lies `outward` (mm) of the centre line of
  /// the lowest or the highest turn.
  Vec2 ring(double direction, bool lowest, double outward) const;

 private:
  HelicalCurve curve_;
  double begin_, end_, filled_from_, filled_to_;
  double bulge_low_, bulge_high_;
};

}  // namespace fusee::formats
