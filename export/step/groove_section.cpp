#include "export/step/groove_section.h"

#include <algorithm>
#include <cmath>

#include "fusee/base.h"

namespace fusee::formats {
namespace {

// Tolerance for recognising that straight and arc touch, mm. The section was computed in another order of operations.
constexpr double k_contact_tolerance = 1e-7;
// Shortest straight part of a wall, as a difference of offsets, mm.
constexpr double k_shortest_straight = 1e-3;
// Up to this turn, an arc of one span has a middle weight well above 0.
constexpr double k_widest_seat = radians(150);

/// Angle of one wall's arc before its straight part; empty if the groove edge cuts the arc off.
std::optional<double> seat_turn(const std::vector<solid::GroovePoint>& wall, double radius) {
  const solid::GroovePoint &groove_edge = wall.back(), &last = wall[wall.size() - 2];
  const double lean = elementary::atan2(groove_edge.dz - last.dz, groove_edge.offset - last.offset);
  // The straight touches the arc: its distance from the centre equals the radius.
  const double distance = std::abs((radius - last.offset) * elementary::sin(lean) + last.dz * elementary::cos(lean));
  const double arc_end_offset = radius * (1 - elementary::sin(lean));
  if (std::abs(distance - radius) > k_contact_tolerance || arc_end_offset > groove_edge.offset - k_shortest_straight)
    return std::nullopt;
  return 0.5 * k_pi - lean;
}

}  // namespace

std::vector<double> Seat::angles() const {
  if (below + above <= k_widest_seat) return {-below, above};
  return {-below, 0, above};
}

std::optional<Seat> seat_of(const solid::GrooveWalls& walls, const Mechanism& mechanism) {
  if (mechanism.body.groove != Groove::u) return std::nullopt;
  const double radius = std::max(0.5, mechanism.body.seat_ratio) * mechanism.tendon.diameter;
  const auto below = seat_turn(walls.below, radius), above = seat_turn(walls.above, radius);
  if (!below || !above) return std::nullopt;
  return Seat{radius, *below, *above};
}

}  // namespace fusee::formats
