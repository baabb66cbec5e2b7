#include "helix/draw_spiral.h"

#include <algorithm>
#include <cmath>

namespace fusee {
namespace {

/// Over a stretch between two directions, both among them.
void add_directions(std::vector<double>& directions, const PitchSpiral& curve, double begin, double end,
                    const SpiralDrawing& drawing) {
  double psi = begin;
  while (psi < end) {
    directions.push_back(psi);
    const double radius = curve.at(psi).curve.radius + drawing.reach;
    psi += std::min(drawing.largest_turn, std::sqrt(8.0 * drawing.tolerance / radius));
  }
  // The last two steps are shared evenly: none is next to nothing.
  if (directions.size() > 1 && directions.back() > begin) {
    const double before = directions[directions.size() - 2];
    directions.back() = 0.5 * (before + end);
  }
}

}  // namespace

Spiral draw_spiral(const PitchSpiral& curve, Side side, double slope, const SpiralDrawing& drawing) {
  std::vector<double> directions;
  add_directions(directions, curve, curve.begin(), curve.working_begin(), drawing);
  const std::size_t first = directions.size();
  add_directions(directions, curve, curve.working_begin(), curve.working_end(), drawing);
  const std::size_t last = directions.size();
  add_directions(directions, curve, curve.working_end(), curve.end(), drawing);
  directions.push_back(curve.end());

  std::vector<SpiralPoint> points;
  points.reserve(directions.size());
  for (const double psi : directions) points.push_back(curve.at(psi));
  Spiral spiral;
  spiral.slope = slope;
  const bool left = side == Side::left;
  const double sigma0 = left ? points.back().sigma : points.front().sigma;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SpiralPoint& point = points[left ? points.size() - 1 - i : i];
    const Vec2 place = point.curve.position();
    SpiralRow row;
    row.x = left ? -place.x() : place.x();
    row.y = place.y();
    row.turn = left ? k_pi - point.curve.psi : point.curve.psi;
    row.rho = point.curve.radius;
    row.s = left ? sigma0 - point.sigma : point.sigma - sigma0;
    row.z = slope * row.s;
    spiral.rows.push_back(row);
  }
  spiral.first_used = left ? points.size() - 1 - last : first;
  spiral.last_used = left ? points.size() - 1 - first : last;
  return spiral;
}

}  // namespace fusee
