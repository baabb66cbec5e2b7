/// \file
/// Arcs, bulges and B-splines as points, so close that no chord leaves its curve by more than `sagitta`.
#pragma once

#include <vector>

#include "fusee/base/plane.h"

namespace fusee {

struct SampledCurve {
  Polygon points;
  bool closed = false;  ///< the last point joins the first and is not repeated
};

/// Counter-clockwise from `from` to `to` (rad), by a full turn at most.
SampledCurve sampled_arc(const Vec2& centre, double radius, double from, double to, double sagitta);
/// What came back to where it began.
SampledCurve closed_by_full_turn(SampledCurve curve);

/// A vertex and the bulge of the edge that leaves it: tan of a quarter of that arc's turning, 0 when straight.
struct BulgeVertex {
  Vec2 place = Vec2::Zero();
  double bulge = 0;
};
SampledCurve sampled_bulges(const std::vector<BulgeVertex>& vertices, bool closed, double sagitta);

/// A (rational) B-spline. Its knots never fall, and are degree + 1 more than its poles.
struct BSpline {
  int degree = 0;
  std::vector<double> knots;
  std::vector<Vec3> poles;  ///< (x w, y w, w), w > 0
};
/// Stops early where more than `most_points` came of it.
SampledCurve sampled_spline(const BSpline& spline, double sagitta, std::size_t most_points);

}  // namespace fusee
