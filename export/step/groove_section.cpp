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
  const solid::GroovePoint &groove_edge = wall.back(), &before_edge = wall[wall.size() - 2];
  // The angle of the straight from the outward direction.
  const double lean = elementary::atan2(groove_edge.dz - before_edge.dz, groove_edge.offset - before_edge.offset);
  // The straight touches the arc if its distance from the arc's centre equals the radius.
  const double distance =
      std::abs((radius - before_edge.offset) * elementary::sin(lean) + before_edge.dz * elementary::cos(lean));
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
