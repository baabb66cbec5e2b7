#include "helix/spiral_string.h"

#include <cmath>

#include "fusee/base.h"

namespace fusee::helix {
namespace {

/// The tangent point of a string from `from` to a circle. The circle lies on the string's left (sense +1) or right
/// (−1), seen along the string.
Vec2 tangent_point(const Vec2& from, const Vec2& centre, double radius, double sense) {
  const Vec2 to = centre - from;
  const double distance = to.norm();
  const double half_angle = std::asin(radius / distance);
  const double reach = std::sqrt(distance * distance - radius * radius);
  const double direction = std::atan2(to.y(), to.x()) - sense * half_angle;
  return from + reach * unit(direction);
}

double angle_of(const Vec2& v) { return std::atan2(v.y(), v.x()); }

/// The angle in [0, 2π).
double wrapped(double angle) { return angle - k_two_pi * std::floor(angle / k_two_pi); }

}  // namespace

// The left tendon is mirrored to a right-hand one. Seen from C down, the string has the pin on its right and winds
// clockwise on the turned pulley. Seen from its take-off up, pulley and pin are on its left.
StringLength string_length(const Mechanism& mechanism, transmission::Side side, const Spiral& spiral,
                           double attachment_z, double alpha, double theta) {
  const double mirror = side == transmission::Side::right ? 1.0 : -1.0;
  const Guides& guides = mechanism.guides;
  const double e = side == transmission::Side::right ? guides.ED : guides.EB;
  const double rho = guides.radius + 0.5 * mechanism.tendon.diameter;
  const Vec2 pin(e, -guides.OE);
  const Vec2 axis(0.0, -guides.OE - mechanism.pulley.EF);
  const Vec2 lever = mechanism.joint.R * Vec2(std::sin(mirror * theta), std::cos(mirror * theta));
  // The pulley has turned clockwise by α, and the mirrored left one counter-clockwise.
  const auto position_of = [&](const SpiralRow& row) {
    return Vec2(axis + turned(Vec2(mirror * row.x, row.y), -mirror * alpha));
  };
  // The string passes the pin's outer side: the circle is on its right on the way down from C, and on its left on the
  // way up from the pulley.
  const Vec2 upper = tangent_point(lever, pin, rho, -1.0);
  // Take-off: the row whose normal is perpendicular to the line to the pin.
  const std::size_t n = spiral.rows.size();
  std::size_t best = 0;
  double least = 1e300;
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const Vec2 here = position_of(spiral.rows[i]);
    const Vec2 lower = tangent_point(here, pin, rho, 1.0);
    const Vec2 along = (lower - here).normalized();
    // The outward normal points to the right of the line from the pulley to the pin.
    const double normal = angle_of(-turned_left(along));
    const double row_normal = side == transmission::Side::right ? spiral.rows[i].turn : k_pi - spiral.rows[i].turn;
    const double miss = std::abs(row_normal - mirror * alpha - normal);
    if (miss < least) {
      least = miss;
      best = i;
    }
  }
  const SpiralRow& row = spiral.rows[best];
  const Vec2 here = position_of(row);
  const Vec2 lower = tangent_point(here, pin, rho, 1.0);
  const double on_pin = rho * wrapped(angle_of(upper - pin) - angle_of(lower - pin));
  const double below = (lower - here).norm();
  const double free = (upper - lever).norm() + on_pin + below;
  const double rise = row.z - attachment_z;
  StringLength length;
  length.total = guides.collar ? free - below + std::hypot(below, rise) : std::hypot(free, rise);
  length.slope = std::atan2(rise, guides.collar ? below : free);
  double wound = 0;
  for (std::size_t i = 1; i < n; ++i) {
    const SpiralRow &a = spiral.rows[i - 1], &b = spiral.rows[i];
    const bool is_wound = side == transmission::Side::right ? i <= best : i > best;
    if (is_wound) wound += std::hypot(std::hypot(b.x - a.x, b.y - a.y), b.z - a.z);
  }
  length.total += wound;
  const SpiralRow& next = spiral.rows[side == transmission::Side::right ? best - 1 : best + 1];
  length.fleet = length.slope - std::atan2(row.z - next.z, -std::hypot(row.x - next.x, row.y - next.y)) - k_pi;
  length.fleet = std::remainder(length.fleet, k_pi);
  return length;
}

}  // namespace fusee::helix
