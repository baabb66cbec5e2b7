/// \file
/// Internal: arcs, bulges and B-splines as points in the drawing. Chords deviate from the curve by at most `sagitta`,
/// unless an arc would require more than 20 000 chords or a spline's span more than 4096. The extreme points of arcs
/// along x and y are included, so that the box of the points is the box of the curve.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "fusee/base.h"

namespace fusee::formats {

struct SampledCurve {
  Polygon points;
  bool closed = false;                            ///< the last point joins the first and is not repeated
  std::optional<double> diameter = std::nullopt;  ///< for a whole circle
};

/// Plane affine map: coordinates of an entity → drawing, mm.
struct DrawingPlacement {
  Eigen::Matrix2d linear = Eigen::Matrix2d::Identity();
  Vec2 shift = Vec2::Zero();

  Vec2 operator()(const Vec2& p) const { return linear * p + shift; }
};

/// centre + cos t · u + sin t · v for t from `from` to `to` (rad), from < to: an arc of a circle or an ellipse.
struct EllipticArc {
  Vec2 centre = Vec2::Zero();
  Vec2 u = Vec2::UnitX();
  Vec2 v = Vec2::UnitY();
  double from = 0;
  double to = 0;

  EllipticArc placed(const DrawingPlacement& place) const {
    return {place(centre), place.linear * u, place.linear * v, from, to};
  }
};
SampledCurve sampled_arc(const EllipticArc& arc, double sagitta);
/// A vertex and the bulge of the edge that leaves it: tan of a quarter of the arc's angle, 0 if straight.
struct BulgeVertex {
  Vec2 place = Vec2::Zero();
  double bulge = 0;
};
SampledCurve sampled_bulges(const std::vector<BulgeVertex>& vertices, bool closed, double sagitta,
                            const DrawingPlacement& place = {});

/// A (rational) B-spline. Its knots do not decrease, and there are degree + 1 more knots than poles.
struct BSpline {
  int degree = 0;
  std::vector<double> knots;
  std::vector<Vec3> poles;  ///< (x w, y w, w), w > 0
};
/// Stops early with more than `most_points` points.
SampledCurve sampled_spline(const BSpline& spline, double sagitta, std::size_t most_points);

}  // namespace fusee::formats
