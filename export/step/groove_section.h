/// \file
/// Internal: a groove's cross-section from edge to edge, with the arc of a round seat.
#pragma once

#include <optional>
#include <vector>

#include "fusee/mechanism.h"
#include "fusee/solid.h"

namespace fusee::formats {

/// The arc of a groove's seat in its section.
struct Seat {
  double radius = 0;            ///< mm
  double below = 0, above = 0;  ///< angles of the arc on both sides of the floor, rad

  /// Angles at which the arc is split, from −below to above. The middle weight of each span, the cosine of half its
  /// turn, is then well above 0.
  std::vector<double> angles() const;
};

/// Empty if the groove is drawn straight from corner to corner.
std::optional<Seat> seat_of(const solid::GrooveWalls& walls, const Mechanism& mechanism);

}  // namespace fusee::formats
