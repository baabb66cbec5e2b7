#include "export/step/helical_curve.h"

#include <algorithm>
#include <cmath>

#include "export/step/normal_spline.h"
#include "fusee/base.h"

namespace fusee::formats {
namespace {

// Turn over which a groove edge grows to its bulge. In the mesh this takes one column of the grid.
constexpr double k_bulge_turn = radians(5);

double polynomial(const std::array<double, 6>& powers, double u) {
  double value = 0;
  for (auto c = powers.rbegin(); c != powers.rend(); ++c) value = value * u + *c;
  return value;
}

double derivative(const std::array<double, 6>& powers, double u) {
  double value = 0;
  for (std::size_t k = 5; k > 0; --k) value = value * u + static_cast<double>(k) * powers[k];
  return value;
}

/// A smooth step over the second half of the share.
double late_step(double share) { return smooth_step(2.0 * share - 1.0); }

/// Integral from 0.
double integral_of(const std::array<double, 6>& powers, double u) {
  double value = 0;
  for (std::size_t k = 6; k > 0; --k) value = value * u + powers[k - 1] / static_cast<double>(k);
  return value * u;
}

}  // namespace

// The Hermite polynomial of degree 5 with the values h, h' and h'' = ρ − h of both rows.
HelicalCurve::HelicalCurve(const helix::Spiral& spiral, const helical_solid::SpiralPlace& place)
    : slope_(place.direction * spiral.slope) {
  for (std::size_t i = 0; i + 1 < spiral.rows.size(); ++i) {
    const helix::SpiralRow &a = spiral.rows[i], &b = spiral.rows[i + 1];
    const double width = b.turn - a.turn;
    const Vec2 from(a.x, a.y), to(b.x, b.y);
    const double h0 = from.dot(unit(a.turn)), h1 = to.dot(unit(b.turn));
    const double d0 = width * from.dot(turned_left(unit(a.turn))), d1 = width * to.dot(turned_left(unit(b.turn)));
    const double e0 = 0.5 * width * width * (a.rho - h0), e1 = 0.5 * width * width * (b.rho - h1);
    pieces_.push_back({a.turn, width, hermite_powers(h0, d0, e0, h1, d1, e1), place.height(a.z)});
  }
}

Vec3 HelicalCurve::at(double turn) const {
  const auto above = std::upper_bound(pieces_.begin() + 1, pieces_.end(), turn,
                                      [](double value, const Piece& piece) { return value < piece.turn; });
  const Piece& piece = *(above - 1);
  const double u = (turn - piece.turn) / piece.width;
  const double slope = derivative(piece.support, u) / piece.width;
  const Vec2 point = polynomial(piece.support, u) * unit(turn) + slope * turned_left(unit(turn));
  const double length_in_plan = slope - piece.support[1] / piece.width + piece.width * integral_of(piece.support, u);
  return {point.x(), point.y(), piece.height + slope_ * length_in_plan};
}

double smooth_step(double share) {
  const double t = std::clamp(share, 0.0, 1.0);
  return t * t * t * (10.0 - t * (15.0 - 6.0 * t));
}

HelicalGroove::HelicalGroove(const helix::Spiral& spiral, const helical_solid::SpiralPlace& place,
                             const helical_solid::Winding& winding)
    : curve_(spiral, place),
      begin_(winding.groove_front().turn),
      end_(winding.groove_back().turn),
      filled_from_(winding.rows.front().turn),
      filled_to_(winding.rows.back().turn),
      bulge_low_(winding.bulge_low),
      bulge_high_(winding.bulge_high) {}

Vec3 HelicalGroove::at(double turn) const {
  if (turn > end_) return curve_.at(turn - k_two_pi) + curve_.at(end_) - curve_.at(end_ - k_two_pi);
  if (turn < begin_) return curve_.at(turn + k_two_pi) + curve_.at(begin_) - curve_.at(begin_ + k_two_pi);
  return curve_.at(turn);
}

double HelicalGroove::bulge(double turn, bool low) const {
  const double most = low ? bulge_low_ : bulge_high_;
  const double past = turn > end_ ? turn - end_ : begin_ - turn;
  const double whole = turn > end_ ? filled_to_ - end_ : begin_ - filled_from_;
  if (!(past > 0 && past < whole)) return 0;
  return most * smooth_step(past / std::min(k_bulge_turn, 0.25 * whole)) * (1.0 - late_step(past / whole));
}

// As in helical_solid/helical_blank.cpp: the ring leaves the turn in the half with the most clearance and returns to
// its start.
Vec2 HelicalGroove::ring(double direction, bool lowest, double outward) const {
  const double first = lowest ? filled_to_ : filled_from_;
  const double towards_groove = lowest ? -1.0 : 1.0;  // sign of the turn from the filled end
  const double past_first = towards_groove * (direction - first);
  const double within_turn = past_first - k_two_pi * std::floor(past_first / k_two_pi);
  const double turn = first + towards_groove * within_turn;
  const Vec2 gap = (at(first) - at(first + towards_groove * k_two_pi)).head<2>();
  return at(turn).head<2>() + outward * unit(turn) + late_step(within_turn / k_two_pi) * gap;
}

}  // namespace fusee::formats
