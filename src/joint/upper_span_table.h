/// \file
/// Lookup table of a tendon's upper span over the joint angle, which an equilibrium evaluates many times per step.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "fusee/mechanism.h"
#include "fusee/transmission.h"

namespace fusee::joint {

/// Quintics between nodes about a degree apart that match values, slopes and curvatures. Accurate to 1e-10 of R, except
/// near the end of a span.
class UpperSpanTable {
 public:
  /// Covers joint angles of the right-hand image from `least` to `most`, rad. The part on a drum about the axis is not
  /// lengthened by `longer`.
  UpperSpanTable(const transmission::PinPlace& place, double least, double most, const PathError& longer = {});

  struct Values {
    double length = 0;   ///< UpperSpan::length, mm
    double m = 0;        ///< moment arm about O, mm
    double dm = 0;       ///< dm/dθ
    double normal = 0;   ///< rad
    double dnormal = 0;  ///< d normal / dθ
    double on_drum = 0;  ///< UpperSpan::on_drum, rad
  };
  Values at(double theta) const;

 private:
  /// A quintic over one interval, in units of intervals from its lower end.
  using Quintic = std::array<double, 6>;
  struct Piece {
    Quintic length, m, normal;
  };
  /// Quintics over intervals of equal width.
  struct Pieces {
    double least = 0;  ///< lower end of the first interval, rad
    double step = 1;   ///< width of an interval, rad
    std::vector<Piece> curves;
  };
  static Pieces pieces(const transmission::PinPlace& place, double least, double most, const PathError& longer);

  double on_drum_until_ = -std::numeric_limits<double>::infinity();  ///< rad; from there on, `free_` holds
  double on_drum_from_ = 0;          ///< lower end of the table if the tendon lies on the drum there, rad
  transmission::UpperSpan on_drum_;  ///< at on_drum_from_
  double wound_up_ = 0;              ///< sum of wrap on the drum, normal and θ; constant while on the drum, rad
  Pieces over_drum_;                 ///< for an eccentric drum only
  Pieces free_;                      ///< clear of the drum
};

/// Tables of the left tendon's image and of the right tendon.
struct UpperSpans {
  UpperSpans(const std::array<transmission::PinPlace, 2>& pins, double theta_least, double theta_most,
             const std::array<PathError, 2>& longer)
      : left(pins[0], -theta_most, -theta_least, longer[0]), right(pins[1], theta_least, theta_most, longer[1]) {}
  UpperSpanTable left, right;
};

}  // namespace fusee::joint
