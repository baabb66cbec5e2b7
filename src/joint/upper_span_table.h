/// \file
/// A tendon's upper span over all joint angles, looked up: the geometry that an equilibrium asks for many times at
/// every step.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "fusee/mechanism/imperfections.h"
#include "fusee/transmission/tendon_path.h"

namespace fusee {

/// By quintics between places a degree or so apart that take over values, slopes and curvatures: upper_span() to 1e-10
/// of R where the span is not near its end.
class UpperSpanTable {
 public:
  /// From `least` to `most` of the right-hand image's joint angle, rad. What lies on a drum about the axis is not
  /// `longer`.
  UpperSpanTable(const PinPlace& place, double least, double most, const PathError& longer = {});

  struct Look {
    double length = 0;   ///< UpperSpan::length, mm
    double m = 0;        ///< moment arm about O, mm
    double dm = 0;       ///< dm/dθ
    double normal = 0;   ///< rad
    double dnormal = 0;  ///< d normal / dθ
    double on_drum = 0;  ///< UpperSpan::on_drum, rad
  };
  Look at(double theta) const;

 private:
  /// A quintic over a piece, from its least angle on in pieces.
  using Quintic = std::array<double, 6>;
  struct Piece {
    Quintic length, m, normal;
  };
  struct Pieces {
    double least = 0;
    double step = 1;
    std::vector<Piece> curves;
  };
  static Pieces pieces(const PinPlace& place, double least, double most, const PathError& longer);

  double on_drum_until_ = -std::numeric_limits<double>::infinity();  ///< rad; from there on it is looked up
  double on_drum_from_ = 0;
  UpperSpan on_drum_;    ///< at on_drum_from_
  double wound_up_ = 0;  ///< what lies on the drum, normal and θ add up to, rad
  Pieces over_drum_;     ///< of a drum off the axis; about it: none
  Pieces free_;
};

/// Of the left tendon's image and of the right one.
struct UpperSpans {
  UpperSpans(const std::array<PinPlace, 2>& pins, double theta_least, double theta_most,
             const std::array<PathError, 2>& longer)
      : left(pins[0], -theta_most, -theta_least, longer[0]), right(pins[1], theta_least, theta_most, longer[1]) {}
  UpperSpanTable left, right;
};

}  // namespace fusee
