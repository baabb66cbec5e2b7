#include "export/step/groove_section.h"

#include <algorithm>
#include <cmath>

#include "fusee/base/units.h"

namespace fusee {
namespace {

// The straight was made to touch the arc, by other sums.
constexpr double k_touches = 1e-7;
// An arc of one span has a weight that is well away from 0 up to here.
constexpr double k_widest_seat = radians(150);

/// How far one wall's arc turns before it runs on straight; null where the lip cuts it off before.
std::optional<double> seat_turn(const std::vector<GroovePoint>& wall, double radius) {
  const GroovePoint &lip = wall.back(), &last = wall[wall.size() - 2];
  const double lean = std::atan2(lip.dz - last.dz, lip.offset - last.offset);
  // The straight touches the arc: it stands as far from its middle.
  const double apart = std::abs((radius - last.offset) * std::sin(lean) + last.dz * std::cos(lean));
  const double end = radius * (1 - std::sin(lean));
  if (std::abs(apart - radius) > k_touches || end > lip.offset - 1e-3) return std::nullopt;
  return 0.5 * k_pi - lean;
}

}  // namespace

std::vector<double> Seat::angles() const {
  if (below + above <= k_widest_seat) return {-below, above};
  return {-below, 0, above};
}

std::optional<Seat> seat_of(const GrooveWalls& walls, const Mechanism& mechanism) {
  if (mechanism.body.groove != Groove::u) return std::nullopt;
  const double radius = std::max(0.5, mechanism.body.seat_ratio) * mechanism.tendon.diameter;
  const auto below = seat_turn(walls.below, radius), above = seat_turn(walls.above, radius);
  if (!below || !above) return std::nullopt;
  return Seat{radius, *below, *above};
}

}  // namespace fusee
