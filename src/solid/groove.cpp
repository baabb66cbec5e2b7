#include "solid/groove.h"

#include <algorithm>
#include <cmath>

#include "fusee/base.h"

namespace fusee::solid {
namespace {

// Sagitta of a seat's facets, mm. Prints and mills are coarser, so finer facets would be wasted.
constexpr double k_seat_sagitta = 0.01;
// Floor width of a flat groove, in tendon diameters.
constexpr double k_flat_floor_ratio = 1.4;

// The seat's arc, of radius s = `seat`, as the polygon of its tangents at 0, δ, 2δ … up to the wall, which is the last
// tangent. The floor band is the first, exactly at offset 0. Corners are at the half steps, at radius s / cos(δ/2).
std::vector<GroovePoint> seat_corners(double seat, double lean) {
  const double turn = 0.5 * k_pi - lean;
  const double finest = 2.0 * elementary::acos(1.0 / (1.0 + k_seat_sagitta / seat));
  const int steps = std::max(1, static_cast<int>(std::ceil(turn / finest)));
  const double step = turn / steps;
  const double corner_radius = seat / elementary::cos(0.5 * step);
  std::vector<GroovePoint> corners;
  for (int k = 0; k < steps; ++k) {
    const double angle = (k + 0.5) * step;
    corners.push_back(
        {k == 0 ? 0.0 : seat - corner_radius * elementary::cos(angle), corner_radius * elementary::sin(angle)});
  }
  return corners;
}

// Completes the section: the wall from the last corner below the groove edge, cut off at the edge.
void finish_at_groove_edge(std::vector<GroovePoint>& points, double depth, double lean) {
  while (points.size() > 2 && points.back().offset >= depth) points.pop_back();
  // If corners were removed, the tangent at the last one left is flatter than the wall. The wall gets its full lean all
  // the same: the steepest wall holds the tendon best.
  const GroovePoint& last = points.back();
  points.push_back({depth, last.dz + (depth - last.offset) * elementary::tan(lean)});
}

}  // namespace

std::vector<GroovePoint> groove_half(const Body& body, double lean, double tendon_diameter, double depth) {
  demand(tendon_diameter > 0 && depth > 0,
         "groove of a tendon of " + std::to_string(tendon_diameter) + " mm, depth " + std::to_string(depth));
  std::vector<GroovePoint> points{{0.0, 0.0}};
  switch (body.groove) {
    case Groove::u: {
      const auto corners = seat_corners(std::max(0.5, body.seat_ratio) * tendon_diameter, lean);
      points.insert(points.end(), corners.begin(), corners.end());
      break;
    }
    case Groove::v:
      // Half-width at which a circle of diameter d touches the floor and both walls.
      points.push_back({0.0, 0.5 * tendon_diameter * elementary::tan(0.25 * k_pi - 0.5 * lean)});
      break;
    case Groove::flat:
      points.push_back({0.0, 0.5 * k_flat_floor_ratio * tendon_diameter});
      break;
  }
  finish_at_groove_edge(points, depth, lean);
  return points;
}

// The circle's centre lies d/2 above the groove edge. There the wall, of lean λ, is d/2 tan λ further out, and the
// centre is d/2 / cos λ inside the wall. The sum is d/2 (1 − sin λ)/cos λ closer than the groove edge.
double room_at_groove_edge(const std::vector<GroovePoint>& half, double tendon_diameter) {
  const GroovePoint &low = half[half.size() - 2], &groove_edge = half.back();
  const double lean = elementary::atan2(groove_edge.dz - low.dz, groove_edge.offset - low.offset);
  return std::max(0.0, groove_edge.dz - 0.5 * tendon_diameter * elementary::tan(0.25 * k_pi - 0.5 * lean));
}

}  // namespace fusee::solid
