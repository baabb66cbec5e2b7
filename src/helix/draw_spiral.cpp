#include "helix/draw_spiral.h"

#include <algorithm>
#include <cmath>

namespace fusee::helix {
namespace {

struct SpiralSample {
  double psi;  ///< direction of the normal, unrolled over all turns, in the image
  SpiralPoint point;
};

/// Adds points from `begin` up to, but without, `end`. A step has the turn √(8 · chord error / ρ), at which its sagitta
/// is the chord error.
void add_points(std::vector<SpiralSample>& points, const PitchSpiral& curve, double begin, double end,
                const SpiralDrawing& drawing) {
  const auto add = [&](double psi) { points.push_back({psi, curve.at(psi)}); };
  double psi = begin;
  while (psi < end) {
    add(psi);
    const double radius = points.back().point.curve.radius + drawing.reach;
    psi += std::min(drawing.largest_turn, std::sqrt(8.0 * drawing.chord_error_mm / radius));
  }
  // The last two steps are made equal, so that none is close to zero.
  if (points.size() > 1 && points.back().psi > begin) {
    points.pop_back();
    add(0.5 * (points.back().psi + end));
  }
}

}  // namespace

Spiral draw_spiral(const PitchSpiral& curve, transmission::Side side, double slope, const SpiralDrawing& drawing) {
  std::vector<SpiralSample> points;
  add_points(points, curve, curve.begin(), curve.working_begin(), drawing);
  const std::size_t working_first = points.size();
  add_points(points, curve, curve.working_begin(), curve.working_end(), drawing);
  const std::size_t working_last = points.size();  // the point at working_end(), with which the spare turns begin
  add_points(points, curve, curve.working_end(), curve.end(), drawing);
  points.push_back({curve.end(), curve.at(curve.end())});

  Spiral spiral;
  spiral.slope = slope;
  // The left side's curve is the mirror image of P1, so P1's rows run from its end to its beginning.
  const bool left = side == transmission::Side::left;
  const double sigma0 = left ? points.back().point.sigma : points.front().point.sigma;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SpiralPoint& point = points[left ? points.size() - 1 - i : i].point;
    const Vec2 position = point.curve.position();
    SpiralRow row;
    row.x = left ? -position.x() : position.x();
    row.y = position.y();
    row.turn = left ? k_pi - point.curve.psi : point.curve.psi;
    row.rho = point.curve.radius;
    row.s = left ? sigma0 - point.sigma : point.sigma - sigma0;
    row.z = slope * row.s;
    spiral.rows.push_back(row);
  }
  spiral.first_used = left ? points.size() - 1 - working_last : working_first;
  spiral.last_used = left ? points.size() - 1 - working_first : working_last;
  return spiral;
}

}  // namespace fusee::helix
